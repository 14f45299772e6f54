#pragma once
#include <array>
#include <cmath>
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

// The frustum of the pixels `rect` of a view, moved outwards by a pixel and by what single precision may lose
// anywhere in `within`: a box inside of `within` that is outside of this frustum covers no pixel centre of
// `rect` in any renderer of single precision.
Frustum make_frustum(const View& view, const Rect& rect, const Box& within);

// The ONE plane expression that every cull test uses, scalar or vector: the signed distance, times the
// normal's length. Each step is fused and rounded once, so it is monotone in every coordinate, which makes
// hierarchies exact: what a parent's box fails, no child's box passes, and what it passes, no child fails.
inline float plane_distance(const glm::vec4& plane, float x, float y, float z) {
    return std::fma(plane.x, x, std::fma(plane.y, y, std::fma(plane.z, z, plane.w)));
}

// Of the box's farthest corner along the plane's normal (its p-vertex): negative means that the whole box is
// outside this plane.
inline float p_vertex_distance(const glm::vec4& plane, const Box& box) {
    return plane_distance(plane, plane.x >= 0 ? box.max.x : box.min.x, plane.y >= 0 ? box.max.y : box.min.y,
                          plane.z >= 0 ? box.max.z : box.min.z);
}

// Of the nearest corner (its n-vertex): not negative means that the whole box is inside this plane.
inline float n_vertex_distance(const glm::vec4& plane, const Box& box) {
    return plane_distance(plane, plane.x >= 0 ? box.min.x : box.max.x, plane.y >= 0 ? box.min.y : box.max.y,
                          plane.z >= 0 ? box.min.z : box.max.z);
}

// True if the box certainly has nothing in the frustum (conservative: a few boxes near an edge stay). A plane
// that is not a number drops nothing.
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
