#include "common/base/sharing.h"

#include <algorithm>

namespace swath {
namespace {

// Waking a member takes some 10 µs, more on a busy machine.
constexpr double kWorthAMemberNs = 25'000;
constexpr std::uint32_t kShortest = 32;  // interval between trials, in frames
constexpr std::uint32_t kLongest = 1024;

}  // namespace

double Sharing::Rate::value() const {
    std::array<double, 5> sorted = samples_;
    const std::size_t count = std::min(count_, sorted.size());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
}

std::size_t Sharing::members(double expected_ns) {
    if (mode_ == SharingMode::kAlways) return team_.size();
    const double most = std::clamp(expected_ns / kWorthAMemberNs, 1.0, static_cast<double>(team_.size()));
    counts_ = most >= 2;
    sharing_ = false;
    if (!counts_) return 1;
    if (alone_.known()) {
        sharing_ = !shared_.known() || shared_pays();
        if (shared_.known() && ++since_ > interval_) {
            // Try the other way for this frame. If it does not win, the next trial is twice as far away.
            since_ = 0;
            interval_ = std::clamp(2 * interval_, kShortest, kLongest);
            sharing_ = !sharing_;
            (sharing_ ? shared_ : alone_).forget();
        }
    }
    begin_ = team_.clock().now();
    return sharing_ ? static_cast<std::size_t>(most) : 1;
}

void Sharing::done(double work_ns) {
    if (!counts_ || work_ns <= 0) return;
    const double took = static_cast<double>((team_.clock().now() - begin_).count());
    (sharing_ ? shared_ : alone_).add(took / work_ns);
    const bool pays = shared_pays();
    if (pays != paid_) interval_ = kShortest;
    paid_ = pays;
}

}  // namespace swath
