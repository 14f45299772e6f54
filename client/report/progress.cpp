#include "client/report/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace swath {
namespace {
constexpr std::size_t kBar = 30;  // characters
constexpr auto kRedraw = std::chrono::milliseconds(50);
}  // namespace

Progress::Progress(std::size_t frames, bool quiet, const Clock& clock)
    : frames_(frames),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      clock_(clock),
      begin_(clock.now()) {}

void Progress::step() {
    ++done_;
    if (quiet_) return;
    const Nanoseconds now = clock_.now();
    const bool last = done_ == frames_;
    if (terminal_ ? !last && now - drawn_ < kRedraw : 10 * done_ / frames_ == 10 * (done_ - 1) / frames_)
        return;
    drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
    const std::size_t full = kBar * done_ / frames_;
    const std::string line = fmt::format("[{}{}] {}/{} frames, {:.1f} a second", std::string(full, '#'),
                                         std::string(kBar - full, '.'), done_, frames_, rate);
    fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", line, terminal_ && !last ? "" : "\n");
    std::fflush(stderr);
}

}  // namespace swath
