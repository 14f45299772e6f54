#pragma once
#include <array>
#include <glm/glm.hpp>

#include "common/geometry/box.h"
#include "common/geometry/camera.h"

namespace swath {

// The six planes of a view's frustum in model space, normals pointing inwards: left, right, bottom, top,
// near, far.
struct Frustum {
    std::array<glm::vec4, 6> planes;
};

Frustum make_frustum(const View& view);

// The ONE plane expression that every cull test uses: how far the box's farthest corner along the plane's
// normal (its p-vertex) lies inside; negative means that the whole box is outside this plane.
inline float p_vertex_distance(const glm::vec4& plane, const Box& box) {
    const float x = plane.x >= 0 ? box.max.x : box.min.x;
    const float y = plane.y >= 0 ? box.max.y : box.min.y;
    const float z = plane.z >= 0 ? box.max.z : box.min.z;
    return plane.x * x + plane.y * y + plane.z * z + plane.w;
}

// True if the box certainly has nothing in the frustum (conservative: a few boxes near an edge stay).
inline bool outside(const Frustum& frustum, const Box& box) {
    for (const glm::vec4& plane : frustum.planes)
        if (p_vertex_distance(plane, box) < 0) return true;
    return false;
}

// The pixels that a box can touch: the screen bounds of its eight projected corners, cut at the near plane,
// as [floor, floor + 1) and clipped to the viewport. Empty when it cannot touch any, also beyond the far
// plane. Contains every pixel centre that a single-precision renderer can cover: where rounding is magnified
// (close to the eye, far from the origin) the bounds get a margin, and boxes across the near plane at least
// a pixel.
Rect screen_bounds(const Box& box, const View& view);

// screen_bounds() of many boxes in one view: what depends on the view alone is made once.
class ScreenBounds {
  public:
    explicit ScreenBounds(const View& view);
    Rect of(const Box& box) const;

  private:
    Rect viewport_;
    glm::dmat4 matrix_;      // clip from model
    glm::dmat4 magnitudes_;  // of its elements
};

}  // namespace swath
