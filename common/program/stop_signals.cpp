#include "common/program/stop_signals.h"

#include <csignal>
#include <cstdlib>
#include <utility>

namespace swath {

StopSignals::StopSignals(int exit_code, bool interrupts) : exit_code_(exit_code) {
    if (interrupts)
        signals_.add(SIGINT);
    else
        ::signal(SIGINT, SIG_IGN);
    wait();
    thread_ = std::thread([this] { io_.run(); });
}

StopSignals::~StopSignals() {
    io_.stop();
    thread_.join();
}

void StopSignals::on_stop(std::function<void()> ask) {
    const std::lock_guard lock(mutex_);
    ask_ = std::move(ask);
}

void StopSignals::wait() {
    signals_.async_wait([this](const boost::system::error_code& error, int) {
        if (error) return;
        const std::lock_guard lock(mutex_);
        if (!ask_ || std::exchange(asked_, true)) end();
        ask_();
        grace_.expires_after(kGrace);
        grace_.async_wait([this](const boost::system::error_code& stopped) {
            if (!stopped) end();
        });
        wait();
    });
}

// Work in progress (a frame, a model being read) is dropped rather than waited for.
void StopSignals::end() const { std::_Exit(exit_code_); }

}  // namespace swath
