#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <optional>

namespace swath {

// The median of the last samples. A few outliers do not show; a lasting change shows after half a window.
class RecentMedian {
  public:
    static constexpr std::size_t kWindow = 31;

    void add(double sample);
    std::size_t samples() const { return size_; }  // at most kWindow
    std::optional<double> median() const;

  private:
    std::array<double, kWindow> ring_{};
    std::size_t size_ = 0;
    std::size_t next_ = 0;
};

// The time for an amount of work: a fixed part and a part for each unit, from measured (amount, time) pairs.
// Recent pairs of about the same amount (within a factor of 1.4) form a class, which has the median of each.
// The line goes through the newest pair's class; its slope is the median of the slopes from there to the
// other remembered classes. While all amounts are about the same the parts cannot be told apart, and all of
// the time counts as for each unit.
//
// No part is negative, and at most half of the newest class's time is fixed: where servers share cores, half
// the work on twice the servers takes as long as before, which does not make the work free.
class RecentLine {
  public:
    struct Line {
        double fixed_s = 0;
        double each_s = 0;
    };

    void add(double amount, double time_s);  // amount > 0
    std::size_t samples() const { return pairs_; }
    std::optional<Line> line() const;  // nothing before the first pair

  private:
    static constexpr std::size_t kMemory = 2000;  // pairs; a class without any among the last so many goes
    static constexpr double kMostFixed = 0.5;
    static constexpr double kApart = 1.5;  // least ratio of two amounts whose slope counts
    struct Class {
        RecentMedian amount;
        RecentMedian time_s;
        std::size_t seen = 0;  // number of the last pair of this class
    };
    std::map<long, Class> classes_;  // by twice the binary logarithm of the amount
    long newest_ = 0;
    std::size_t pairs_ = 0;
};

}  // namespace swath
