#include "common/published/cull/split_level.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath {

Nanoseconds total_idle_time(std::span<const WorkSpan> members) {
    if (members.empty()) return Nanoseconds(0);
    const Nanoseconds first = std::ranges::min(members, {}, &WorkSpan::start).start;
    const Nanoseconds last = std::ranges::max(members, {}, &WorkSpan::end).end;
    Nanoseconds idle{0};
    for (const WorkSpan& member : members) idle += (member.start - first) + (last - member.end);
    return idle;
}

int start_level(std::size_t processors) {
    CHECK(processors >= std::size_t{1});
    int level = 0;
    for (std::size_t nodes = 1; nodes < processors; nodes *= 8) ++level;
    return level;
}

void AdsbSplitLevel::update(Nanoseconds total_idle_time) {
    if (total_idle_time > last_idle_time_) deeper_ = !deeper_;
    if (deeper_)
        level_ = std::min(level_ + 1, last_level_);
    else
        level_ = std::max(level_ - 1, 0);
    last_idle_time_ = total_idle_time;
}

void A2ssbSplitLevel::update(Nanoseconds total_idle_time) {
    if (total_idle_time > last_idle_time_) deeper_ = !deeper_;
    if (deeper_)
        level_ = std::min(level_ + 1, last_level_);
    else
        level_ = std::max(level_ - 1, first_level_);
    last_idle_time_ = total_idle_time;
}

}  // namespace swath
