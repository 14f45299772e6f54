#pragma once
#include <cstddef>
#include <span>

#include "common/base/clock.h"

namespace swath {

// The time in which one member of a team worked.
struct WorkSpan {
    Nanoseconds start{0};
    Nanoseconds end{0};
};

// The time that members wait, summed, between the first start and the last end (ADSB, figure 5; A2SSB,
// algorithm 4). 0 for no members.
Nanoseconds total_idle_time(std::span<const WorkSpan> members);

// The smallest r with 8^r >= processors (A2SSB, equation 1). At least 1 processor.
int start_level(std::size_t processors);

// ADSB's controller, as figure 4 prints it: it moves the split level every frame and turns round when the
// total idle time has grown, so it never settles.
class AdsbSplitLevel {
  public:
    explicit AdsbSplitLevel(int last_level) : last_level_(last_level) {}
    int level() const { return level_; }
    void update(Nanoseconds total_idle_time);

  private:
    int last_level_;
    int level_ = 0;
    bool deeper_ = false;  // `trend`
    Nanoseconds last_idle_time_{0};
};

// A2SSB's controller, algorithm 3, which never goes above the start level. It is mended in two places:
// - LastIdleTime, whose start is not given, starts at infinity: with 0 the first frame would turn it round
//   for good, against the text.
// - Turning round moves the level, as the text says and the listing does not: a level that stays would only
//   be compared with itself.
class A2ssbSplitLevel {
  public:
    A2ssbSplitLevel(int first_level, int last_level)
        : first_level_(first_level), last_level_(last_level), level_(first_level) {}
    int level() const { return level_; }
    void update(Nanoseconds total_idle_time);

  private:
    int first_level_;
    int last_level_;
    int level_;
    bool deeper_ = true;  // `trend`
    Nanoseconds last_idle_time_ = Nanoseconds::max();
};

}  // namespace swath
