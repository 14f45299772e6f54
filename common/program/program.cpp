#include "common/program/program.h"

#include <fmt/core.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "common/base/log.h"
#include "common/wire/codec.h"

namespace swath {
namespace asio = boost::asio;

std::string protocol_here() { return fmt::format("protocol   {}\n", kWireVersion); }

void add_program_options(CLI::App& app, ProgramOptions& options, WireTiming& timing) {
    app.add_flag("--quiet", options.quiet, "log errors only, and show no progress");

    app.add_option_function<int>(
           "--silence-ms",
           [&timing](int ms) {
               timing.silence_limit = std::chrono::milliseconds(ms);
               timing.heartbeat = timing.silence_limit / 6;
           },
           "a peer that is silent this long is taken for dead [1600]")
        ->transform(whole_number(100, 600'000));
}

void add_waiting_options(CLI::App& app, ProgramOptions& options) {
    app.add_flag("--lifeline", options.lifeline, "end when stdin closes (for programs that start this one)");
    app.add_flag("--health", options.health,
                 "ask whether such a program answers at --listen, and end: exit code 0 or 1");
}

void add_threads_option(CLI::App& app, int& threads) {
    app.add_option("--threads", threads,
                   "threads that draw, cast rays and cull beside the first, per process [as cores allow]")
        ->envname("LP_NUM_THREADS")
        ->transform(whole_number(0, 256));
}

void set_raster_threads(int threads) {
    if (threads >= 0) ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
}

std::size_t drawing_threads(int threads) {
    if (threads < 0) return std::max(1u, std::thread::hardware_concurrency());
    return static_cast<std::size_t>(threads) + 1;
}

CLI::Option* add_trees_option(CLI::App& app, bool& cuda) {
    return app
        .add_option_function<std::string>(
            "--trees-on", [&cuda](const std::string& device) { cuda = device == "cuda"; },
            "what builds the trees of ray casters: threads, or cuda where there is a device [threads]")
        ->check(CLI::IsMember({"threads", "cuda"}));
}

void announce(const Address& address) {
    std::cout << "listening " << to_string(address) << std::endl;
    log_info("listening on {}", to_string(address));
}

int run_until_stopped(asio::io_context& io, SessionHost& host, StopSignals& signals,
                      const ProgramOptions& options) {
    asio::steady_timer last_words(io);
    signals.on_stop([&] {
        asio::post(io, [&] {
            host.leave([&] {
                last_words.expires_after(std::chrono::milliseconds(200));
                last_words.async_wait([&](const boost::system::error_code&) { io.stop(); });
            });
        });
    });
    asio::posix::stream_descriptor lifeline(io);
    std::array<char, 64> ignored{};
    std::function<void()> watch = [&] {
        lifeline.async_read_some(asio::buffer(ignored),
                                 [&](const boost::system::error_code& error, std::size_t) {
                                     if (error == asio::error::operation_aborted) return;
                                     if (error) io.stop();
                                     watch();
                                 });
    };
    if (options.lifeline) {
        lifeline.assign(::dup(STDIN_FILENO));
        watch();
    }
    io.run();
    // Work in progress (a frame, a model being read) is dropped rather than waited for.
    std::_Exit(kExitDone);
}

std::string default_cache_folder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
        return std::string(cache) + "/swath";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::string(home) + "/.cache/swath";
    return "/tmp/swath-cache";
}

}  // namespace swath
