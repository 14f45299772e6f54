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
    std::vector<ObjectId> group;  // objects it draws, ascending
    Region tile;                  // pixels it owns and sends to the display
    Rect content;                 // pixels its group can touch; contains all that it draws
    bool operator==(const ServerShare&) const = default;
};

// A frame, decided: who draws which objects and who owns which pixels. Every partitioner makes one and
// nothing downstream knows which made it: the cluster executes it, the simulator prices it, the viewer draws
// it. A value.
struct FramePlan {
    FrameNumber frame = 0;
    View view;
    std::vector<ServerShare> servers;  // by ServerId
    bool operator==(const FramePlan&) const = default;
};

// Whether every object is in exactly one group (hybrid, sort-last) or in at least one (sort-first).
enum class Grouping { kExactlyOnce, kAtLeastOnce };

// What is wrong with the plan, as one line, or nothing: tiles cover the viewport exactly once, contents lie
// in it, groups are ascending, in range and obey `grouping`.
std::optional<std::string> problem(const FramePlan& plan, std::size_t object_count, Grouping grouping);

// Pixels that one server draws and another owns: colour, depth and id of `region` go from `from` to `to`
// (Samanta 2000, section 4, phase 2).
struct Transfer {
    ServerId from{};
    ServerId to{};
    Region region;
    bool operator==(const Transfer&) const = default;
};

// All transfers with pixels, ordered by (from, to). A pair whose region is empty takes no part in the frame.
std::vector<Transfer> transfers(const FramePlan& plan);

// What server `id` sends to the display: of each of its tile's rectangles the bounding box of all contents in
// it. Outside of this the picture is background.
Region final_region(const FramePlan& plan, ServerId id);

}  // namespace swath
