#include "common/program/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace swath {
namespace {
constexpr std::size_t kBar = 30;  // characters
constexpr auto kRedraw = std::chrono::milliseconds(50);
}  // namespace

Progress::Progress(std::size_t total, std::string what, bool quiet, const Clock& clock, Nanoseconds patience)
    : total_(total),
      what_(std::move(what)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      clock_(clock),
      patience_(patience),
      begin_(clock.now()) {}

void Progress::step() {
    ++done_;
    if (quiet_) return;
    const Nanoseconds now = clock_.now();
    if (now - begin_ < patience_) return;
    const bool last = done_ == total_;
    if (terminal_ ? !last && now - drawn_ < kRedraw : 10 * done_ / total_ == 10 * (done_ - 1) / total_)
        return;
    drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
    const std::string pace = last || rate <= 0 ? fmt::format(" in {:.1f} s", seconds)
                                               : fmt::format(", {:.1f} a second, {:.0f} s left", rate,
                                                             static_cast<double>(total_ - done_) / rate);
    const std::size_t full = kBar * done_ / total_;
    const std::string line = fmt::format("[{}{}] {}/{} {}{}", std::string(full, '#'),
                                         std::string(kBar - full, '.'), done_, total_, what_, pace);
    fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", line, terminal_ && !last ? "" : "\n");
    std::fflush(stderr);
}

}  // namespace swath
