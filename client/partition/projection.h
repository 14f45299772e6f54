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
    bool visible = false;    // if false, `box` is one pixel of the border and the object draws nothing
    bool operator==(const ProjectedObject&) const = default;
};

// The work of an object that cannot be seen: none, since our servers cull it, or all of its triangles as in
// Samanta 2000, which does not cull (the simulator's `paper` mode).
enum class Accounting { kCluster, kPaper };

// Projects each object: to the screen_bounds of its box at the view's pose, or, if it cannot be seen, to the
// single pixel of the border that is nearest to its centre. `costs` are the triangles that each object is
// expected to cost if it can be seen (see ObjectCosts); empty, each costs all that it has. The view must have
// at least one pixel. O(objects).
std::vector<ProjectedObject> project(std::span<const Object> objects, const View& view,
                                     Accounting accounting = Accounting::kCluster,
                                     std::span<const std::uint32_t> costs = {});

}  // namespace swath
