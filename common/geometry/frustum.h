#pragma once
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "common/geometry/box.h"
#include "common/geometry/camera.h"

namespace swath {

// A view's frustum in model space: its planes left, right, bottom, top, near and far, normals inwards.
struct Frustum {
    std::array<glm::vec4, 6> planes;
};

Frustum make_frustum(const View& view);

// The frustum of the pixels `rect` of a view, moved outwards by a pixel and by what single precision may lose
// anywhere in `within`. A box in `within` that is outside of this frustum covers no pixel centre of `rect` in
// any single-precision renderer.
Frustum make_frustum(const View& view, const Rect& rect, const Box& within);

// The signed distance to the plane, times the normal's length. Every cull test, scalar or vector, uses this
// ONE expression. Each step is fused and rounded once, so it is monotone in every coordinate. That makes
// hierarchies exact: what a parent's box fails, no child's box passes, and what it passes, no child fails.
inline float plane_distance(const glm::vec4& plane, float x, float y, float z) {
    return std::fma(plane.x, x, std::fma(plane.y, y, std::fma(plane.z, z, plane.w)));
}

// The plane_distance of the box's farthest corner along the normal (its p-vertex). If it is negative, the
// whole box is outside of this plane.
inline float p_vertex_distance(const glm::vec4& plane, const Box& box) {
    return plane_distance(plane, plane.x >= 0 ? box.max.x : box.min.x, plane.y >= 0 ? box.max.y : box.min.y,
                          plane.z >= 0 ? box.max.z : box.min.z);
}

// True only if no part of the box is in the frustum. The test is conservative: it is false for some boxes
// outside near an edge. A plane that is NaN drops nothing.
inline bool outside(const Frustum& frustum, const Box& box) {
    for (const glm::vec4& plane : frustum.planes)
        if (p_vertex_distance(plane, box) < 0) return true;
    return false;
}

// The pixels that a box can touch: the bounds of its eight projected corners, cut at the near plane, as
// [floor, floor + 1) and clipped to the viewport. It is empty if the box can touch none, also beyond the far
// plane. It contains every pixel centre that a single-precision renderer can cover: it has a margin where
// rounding is magnified (close to the eye, far from the origin), of at least a pixel for boxes that cross the
// near plane.
Rect screen_bounds(const Box& box, const View& view);

// screen_bounds() of many boxes in one view. Computes what depends on the view alone once.
class ScreenBounds {
  public:
    explicit ScreenBounds(const View& view);
    Rect of(const Box& box) const;

  private:
    Rect viewport_;
    glm::dmat4 matrix_;      // clip from model
    glm::dmat4 magnitudes_;  // absolute values of matrix_
};

}  // namespace swath
