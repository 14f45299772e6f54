#pragma once
#include <algorithm>
#include <cstddef>

#include "common/base/thread_team.h"

namespace swath {

// How work on `size` things is divided: contiguous parts, equal to within one thing, whatever the number of
// parts (A2SSB's size / p loses the remainder, see its Algorithm 5).
struct Part {
    std::size_t begin;
    std::size_t end;
};

inline Part part_of(std::size_t size, std::size_t parts, std::size_t index) {
    return {size * index / parts, size * (index + 1) / parts};
}

// An index of the part some way after `i`, for __builtin_prefetch: what is known of visible objects lies in
// memory as objects do, with gaps that the processor cannot guess. At ten million objects, a tenth of them
// visible, this made radix sort twice as fast.
inline std::size_t read_ahead(std::size_t i, Part part) { return std::min(i + 64, part.end - 1); }

// As many parts as the team has members, but none smaller than `least`: for less, waking somebody costs more
// than it saves.
inline std::size_t parts_for(std::size_t size, std::size_t least, const ThreadTeam& team) {
    return std::clamp<std::size_t>(size / least, 1, team.size());
}

// task(part) for each part, one a member. A single part stays with the caller.
template <class Task>
void run_parts(ThreadTeam& team, std::size_t parts, const Task& task) {
    if (parts == 1) return task(std::size_t{0});
    team.run(parts, task);
}

}  // namespace swath
