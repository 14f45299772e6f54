#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/geometry/box.h"
#include "common/geometry/frustum.h"

namespace swath::bench {

// A view of the papers' uniform octree: 8^height leaves of edge 1 in the cube from 0 to 2^height.
struct TreeScene {
    std::string name;
    int height;
    Frustum frustum;
};

// "W": an orthographic view, half a leaf smaller than the cube on all sides. Every leaf may be seen, but the
// outermost ones are not inside, so a test of the root does not settle it.
TreeScene whole_tree(int height);
// "C30", "C60": from the cube's centre along +y to the end of the cube; `fov_y` in degrees, 16:10.
TreeScene tree_from_centre(int height, int fov_y);
// "K30", "K60": from a corner of the cube along its diagonal.
TreeScene tree_from_corner(int height, int fov_y);
// The cameras of the ADSB paper's tables 2 and 3 (9 levels, so height 8), derived from its node counts: 30
// degrees, 4:3, 25 leaves far, along +y. The frustum lies across the cube's centre, or across that of a
// corner's eighth of an eighth.
TreeScene table_2_camera();
TreeScene table_3_camera();
// Frame number `frame` of `frames` of a walk along the cube's diagonal, which turns by three quarters of a
// circle within a tenth of its length, half-way.
TreeScene walk(int height, int frame, int frames);

// Boxes in Morton order of their centres, so that neighbours in space are near in memory, unless a function
// says otherwise.
struct BoxSet {
    std::string name;
    std::vector<Box> boxes;
    Box view_bounds;  // cameras are placed by these
};

// Edges of 1 to 5, at random in a cube of 1000.
BoxSet random_boxes(std::size_t count, unsigned seed);
// The same boxes in the order in which they were generated.
BoxSet random_boxes_in_random_order(std::size_t count, unsigned seed);
// Boxes in 200 Gaussian clouds of 10 to 60 units.
BoxSet clustered_boxes(std::size_t count, unsigned seed);
// The boxes of a model's triangles. The model is repeated side by side along its longer axes; the last copy
// is cut short. Errors: the model cannot be loaded.
Result<BoxSet> triangle_boxes(const std::string& model, std::size_t count);

struct ObjectScene {
    std::string name;
    Frustum frustum;
};
// "c60": from the centre along the longest edge (of a cube +y). "k30": from the lowest corner along the
// diagonal. "far small": from the centre, 30 degrees, 0.15 of the longest edge far. "all": every box is
// inside, which tests no algorithm, only the filling in of ids.
std::vector<ObjectScene> object_scenes(const Box& bounds);

}  // namespace swath::bench
