#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/geometry/camera.h"
#include "common/geometry/rect.h"

namespace swath {

// One server's part of a frame.
struct ServerShare {
    std::vector<ObjectId> group;  // the objects that it draws, ascending
    Region tile;                  // the pixels that it owns and sends to the display
    Rect content;                 // contains all pixels that its group can touch
    bool operator==(const ServerShare&) const = default;
};

// A frame, decided: who draws which objects and who owns which pixels. Partitioners make it, the cluster
// executes it, the simulator prices it, the page draws it; none of these knows which partitioner made it. A
// value.
struct FramePlan {
    FrameNumber frame = 0;
    View view;
    std::vector<ServerShare> servers;  // by ServerId
    bool operator==(const FramePlan&) const = default;
};

// Every object is in exactly one group (hybrid, sort-last) or in at least one (sort-first).
enum class Grouping { kExactlyOnce, kAtLeastOnce };

// Says in one line what is wrong with a plan, or nothing. Tiles must cover the viewport exactly once,
// contents must lie in it, groups must be ascending, below `object_count` and as `grouping` says. Trusts
// nothing.
std::optional<std::string> problem(const FramePlan& plan, std::size_t object_count, Grouping grouping);

// A swath: pixels that `from` draws and `to` owns, so that their colour, depth and id are sent (Samanta 2000,
// section 4, phase 2).
struct Transfer {
    ServerId from{};
    ServerId to{};
    Region region;
    bool operator==(const Transfer&) const = default;
};

// All transfers that have pixels, ordered by (from, to).
std::vector<Transfer> transfers(const FramePlan& plan);

// The region that server `id` sends to the display: for each rectangle of its tile, the bounding box of all
// contents in it. The rest of the tile is background.
Region final_region(const FramePlan& plan, ServerId id);

}  // namespace swath
