#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/camera.h"
#include "common/geometry/rect.h"
#include "common/scene/objects.h"

namespace swath {

// An object as a partitioner sees it.
struct ProjectedObject {
    Rect box;                // pixels, never empty, within the viewport
    std::uint64_t work = 0;  // triangles to draw, as far as is known
    bool visible = false;    // else `box` is only the pixel where the sweep meets it, and it draws nothing
    bool operator==(const ProjectedObject&) const = default;
};

// What an object that cannot be seen costs: nothing, since our servers cull it, or all of its triangles as in
// Samanta 2000, which does not cull (the simulator's `paper` mode).
enum class Accounting { kCluster, kPaper };

// Where each object shows on the screen: the screen_bounds of its box at the view's pose, or for one that
// cannot be seen a single pixel of the border, nearest to its centre. `costs` are the triangles that each is
// expected to cost if it can be seen (see ObjectCosts); where there are none, all that it has. The view must
// have at least one pixel. O(objects).
std::vector<ProjectedObject> project(std::span<const Object> objects, const View& view,
                                     Accounting accounting = Accounting::kCluster,
                                     std::span<const std::uint32_t> costs = {});

}  // namespace swath
