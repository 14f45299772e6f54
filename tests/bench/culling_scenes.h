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

// "W": every leaf may be seen, and the outermost ones are not inside, so no test of the root settles it: an
// orthographic view, half a leaf smaller than the cube on all sides.
TreeScene whole_tree(int height);
// "C30", "C60": from the cube's centre along +y; `fov_y` in degrees, 16:10, as far as the cube goes.
TreeScene tree_from_centre(int height, int fov_y);
// "K30", "K60": from a corner of the cube along its diagonal.
TreeScene tree_from_corner(int height, int fov_y);
// The cameras of the ADSB paper's tables 2 and 3 (9 levels, so height 8), as its node counts give them away:
// 30 degrees, 4:3, 25 leaves far, along +y; the frustum lies across the cube's centre, or that of a corner's
// eighth of an eighth.
TreeScene table_2_camera();
TreeScene table_3_camera();
// `frame` of `frames` of a walk along the cube's diagonal that turns round by three quarters of a circle
// within a tenth of its length, half-way.
TreeScene walk(int height, int frame, int frames);

// Boxes in Morton order of their centres, so that neighbours in space are near in memory, unless said
// otherwise.
struct BoxSet {
    std::string name;
    std::vector<Box> boxes;
    Box view_bounds;  // what the cameras are placed by
};

// Edges of 1 to 5, at random in a cube of 1000.
BoxSet random_boxes(std::size_t count, unsigned seed);
// The same boxes in the order in which they were made up, which is none.
BoxSet random_boxes_in_random_order(std::size_t count, unsigned seed);
// In 200 Gaussian clouds of 10 to 60 units.
BoxSet clustered_boxes(std::size_t count, unsigned seed);
// The boxes of a model's triangles. As many copies of the model as it takes, side by side along its longer
// axes; the last one is cut short. Errors: the model cannot be loaded.
Result<BoxSet> triangle_boxes(const std::string& model, std::size_t count);

struct ObjectScene {
    std::string name;
    Frustum frustum;
};
// "c60": from the centre along the longest edge (of a cube +y); "k30": from the lowest corner along the
// diagonal; "far small": from the centre, 30 degrees, 0.15 of the longest edge far; "all": every box whole,
// which is no test of an algorithm: to fill in ids is all there is to do.
std::vector<ObjectScene> object_scenes(const Box& bounds);

}  // namespace swath::bench
