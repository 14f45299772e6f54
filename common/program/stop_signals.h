#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

namespace swath {

// Ends the program on SIGTERM and SIGINT, whatever its threads are doing: the signals have a thread of their
// own. Also where the program is process 1 of a container, which otherwise no signal would end. Made in main,
// once; other objects of it are not notified of each other.
class StopSignals {
  public:
    // `exit_code` is the program's if it does not end by itself. Without `interrupts` SIGINT is ignored.
    StopSignals(int exit_code, bool interrupts);
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    // From now on the first signal calls `ask`, on the signals' thread, and the program has kGrace to end;
    // then, or with a second signal, it is ended. Without one (null) a signal ends it at once. When this
    // returns the one before is not being called any more.
    void on_stop(std::function<void()> ask);

    static constexpr std::chrono::milliseconds kGrace{1700};

  private:
    void wait();
    void end() const;

    const int exit_code_;
    boost::asio::io_context io_{1};
    boost::asio::signal_set signals_{io_, SIGTERM};
    boost::asio::steady_timer grace_{io_};
    std::mutex mutex_;  // of ask_ and asked_
    std::function<void()> ask_;
    bool asked_ = false;
    std::thread thread_;  // last: it uses the others
};

}  // namespace swath
