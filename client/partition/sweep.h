#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace swath {

// The side of a split to which an item went.
enum class Side : std::uint8_t { kNone, kLeft, kRight };

// The positions of the two sweep lines along the split axis.
template <class Coordinate>
struct SweepLines {
    Coordinate left;
    Coordinate right;
};

// The number of servers on each side of a split: half on the left, rounded down.
struct SplitServers {
    std::size_t left;
    std::size_t right;
    explicit SplitServers(std::size_t servers) : left(servers / 2), right(servers - servers / 2) {}
};

// The two-line sweep of hybrid (on the screen) and sort-last (in the model). The side with less work per
// server, the left one when equal, moves its line across the next item that nobody has, and gets it (Samanta
// 2000, section 5). `from_left` and `from_right` list the same n items, by upper end ascending and by lower
// end descending. `sides[item]` is kNone for each of them before, and the outcome after. `lines` start at the
// region's ends. Items answer upper(i), lower(i) and work(i); their work must sum to less than 2^53, so that
// times kMaxServers it fits in 64 bits. O(n).
template <class Coordinate, class Items>
SweepLines<Coordinate> sweep(std::span<const std::uint32_t> from_left,
                             std::span<const std::uint32_t> from_right, const Items& items,
                             const SplitServers& servers, SweepLines<Coordinate> lines,
                             std::span<Side> sides) {
    std::uint64_t left_work = 0;
    std::uint64_t right_work = 0;
    std::size_t next_left = 0;
    std::size_t next_right = 0;
    for (std::size_t assigned = 0; assigned < from_left.size(); ++assigned) {
        // left_work / servers.left <= right_work / servers.right, without rounding
        if (left_work * servers.right <= right_work * servers.left) {
            while (sides[from_left[next_left]] != Side::kNone) ++next_left;
            const std::uint32_t item = from_left[next_left++];
            sides[item] = Side::kLeft;
            left_work += items.work(item);
            lines.left = items.upper(item);
        } else {
            while (sides[from_right[next_right]] != Side::kNone) ++next_right;
            const std::uint32_t item = from_right[next_right++];
            sides[item] = Side::kRight;
            right_work += items.work(item);
            lines.right = items.lower(item);
        }
    }
    return lines;
}

}  // namespace swath
