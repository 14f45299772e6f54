#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <optional>

namespace swath {

// The median of the last samples. What a scheduler or a neighbour does to a few of them does not show, and
// what has changed for good shows after half a window.
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

// What an amount of work takes: something fixed and something for each unit, from measured (amount, time)
// pairs. Recent ones of about the same amount (within a factor of 1.4) have a common median of each. The
// newest one's median lies on the line; the others, as long as they are remembered, say how steep it is, by
// the median of their slopes. While all amounts are about the same there is nothing to tell the parts by, and
// all is for each unit.
//
// No part is less than nothing, and at most half of what the newest amount takes is fixed: where servers
// share cores, half of the work on twice the servers takes as long as before, which does not mean that work
// is free.
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
    static constexpr std::size_t kMemory = 2000;  // pairs, after which what has not been seen is forgotten
    static constexpr double kMostFixed = 0.5;
    static constexpr double kApart = 1.5;  // how much amounts differ to say something of the slope
    struct Class {
        RecentMedian amount;
        RecentMedian time_s;
        std::size_t seen = 0;  // the last pair of this class
    };
    std::map<long, Class> classes_;  // by twice the binary logarithm of the amount
    long newest_ = 0;
    std::size_t pairs_ = 0;
};

}  // namespace swath
