#pragma once
#include <boost/asio/io_context.hpp>
#include <cstddef>
#include <string>

#include "common/base/log.h"
#include "common/program/cli.h"
#include "common/program/stop_signals.h"
#include "common/wire/address.h"
#include "common/wire/connection.h"
#include "common/wire/session_host.h"

namespace swath {

// What the mains of the networked programs have in common, besides cli.h.

// A line of --version: the protocol spoken, which differs between programs that cannot work together.
std::string protocol_here();

struct ProgramOptions {
    LogLevel least_logged() const { return quiet ? LogLevel::kError : LogLevel::kInfo; }

    bool quiet = false;
    bool lifeline = false;
    bool health = false;
};
void add_program_options(CLI::App& app, ProgramOptions& options, WireTiming& timing);
// For programs that wait for others: --lifeline and --health.
void add_waiting_options(CLI::App& app, ProgramOptions& options);

// --threads, also from the environment's LP_NUM_THREADS; -1: not given. Then set_raster_threads, before the
// first context: the threads that llvmpipe adds to the one that draws (-1: its own choice, one a core).
void add_threads_option(CLI::App& app, int& threads);
void set_raster_threads(int threads);
// How many threads may cull together, the drawing one among them: `threads` and 1, or one a core. At least 1.
std::size_t drawing_threads(int threads);

// --trees-on threads|cuda: whether ray casters' trees are to be built on a CUDA device.
CLI::Option* add_trees_option(CLI::App& app, bool& cuda);

// Prints "listening HOST:PORT" to stdout, for whoever started the program with port 0.
void announce(const Address& address);

// Runs `io` until a signal comes; with a lifeline also until stdin closes: the program that started us has
// gone. A signal lets `host` take leave first, for StopSignals::kGrace at most.
int run_until_stopped(boost::asio::io_context& io, SessionHost& host, StopSignals& signals,
                      const ProgramOptions& options);

// $XDG_CACHE_HOME/swath, else ~/.cache/swath.
std::string default_cache_folder();

}  // namespace swath
