#include "client/predict/estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace swath {
namespace {

// The lower of the two middle ones if their number is even. Reorders; not for an empty range.
template <class Values>
double lower_median(Values first, Values last) {
    const auto middle = first + (last - first - 1) / 2;
    std::nth_element(first, middle, last);
    return *middle;
}

}  // namespace

void RecentMedian::add(double sample) {
    ring_[next_] = sample;
    next_ = (next_ + 1) % kWindow;
    size_ = std::min(size_ + 1, kWindow);
}

std::optional<double> RecentMedian::median() const {
    if (size_ == 0) return std::nullopt;
    auto copy = ring_;
    return lower_median(copy.begin(), copy.begin() + static_cast<std::ptrdiff_t>(size_));
}

void RecentLine::add(double amount, double time_s) {
    ++pairs_;
    newest_ = std::lround(2 * std::log2(amount));
    Class& of = classes_[newest_];
    of.amount.add(amount);
    of.time_s.add(time_s);
    of.seen = pairs_;
    std::erase_if(classes_, [&](const auto& each) { return pairs_ - each.second.seen > kMemory; });
}

std::optional<RecentLine::Line> RecentLine::line() const {
    if (pairs_ == 0) return std::nullopt;
    const Class& newest = classes_.at(newest_);
    const double amount = *newest.amount.median();
    const double time_s = *newest.time_s.median();
    std::vector<double> slopes;
    for (const auto& [key, other] : classes_) {
        const double x = *other.amount.median();
        if (std::max(x, amount) < kApart * std::min(x, amount)) continue;
        slopes.push_back((*other.time_s.median() - time_s) / (x - amount));
    }
    const double steepest_s = time_s / amount;
    if (slopes.empty()) return Line{0, steepest_s};
    const double each_s =
        std::clamp(lower_median(slopes.begin(), slopes.end()), (1 - kMostFixed) * steepest_s, steepest_s);
    return Line{time_s - each_s * amount, each_s};
}

}  // namespace swath
