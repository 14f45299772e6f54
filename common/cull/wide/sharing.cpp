#include "common/cull/wide/sharing.h"

#include <algorithm>

namespace swath {
namespace {

// Waking a member takes some 10 µs, more on a busy machine.
constexpr double kWorthAMemberNs = 25'000;
constexpr std::uint32_t kShortest = 16;  // frames
constexpr std::uint32_t kLongest = 1024;

}  // namespace

void Sharing::Rate::add(double sample) {
    constexpr double kWeight = 0.25;
    constexpr double kOutlier = 4;  // one frame that was interrupted says little of the next
    value = value == 0 ? sample : value + kWeight * (std::min(sample, kOutlier * value) - value);
}

std::size_t Sharing::members(double expected_ns) {
    if (mode_ == SharingMode::kAlways) return team_.size();
    const double most = std::clamp(expected_ns / kWorthAMemberNs, 1.0, static_cast<double>(team_.size()));
    counts_ = most >= 2;
    sharing_ = false;
    if (!counts_) return 1;
    if (alone_.value != 0) {
        sharing_ = shared_.value == 0 || shared_.value < alone_.value;
        if (shared_.value != 0 && ++since_ > interval_) {
            since_ = 0;
            interval_ = std::clamp(2 * interval_, kShortest, kLongest);
            sharing_ = !sharing_;
        }
    }
    begin_ = team_.clock().now();
    return sharing_ ? static_cast<std::size_t>(most) : 1;
}

void Sharing::done(double work_ns) {
    if (!counts_ || work_ns <= 0) return;
    const bool paid = shared_.value != 0 && shared_.value < alone_.value;
    const double took = static_cast<double>((team_.clock().now() - begin_).count());
    (sharing_ ? shared_ : alone_).add(took / work_ns);
    const bool pays = shared_.value != 0 && shared_.value < alone_.value;
    if (paid != pays) interval_ = kShortest;
}

}  // namespace swath
