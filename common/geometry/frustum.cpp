#include "common/geometry/frustum.h"

#include <cmath>

namespace swath {
namespace {

// The part of a clip coordinate that single precision may lose, relative to the sum of its terms' magnitudes:
// the renderer's 4 products and 3 sums lose at most 2.4e-7, clipping as much again.
constexpr double kFloatLoss = 1e-6;
// A pixel is drawn if its centre is covered, so an error below half a pixel, less the rasteriser's snapping,
// cannot reach the next one.
constexpr double kHarmlessPixels = 0.25;

// One number for each of a box's eight corners. Arrays, and minima in halving steps, let the compiler make
// vectors.
using Eight = std::array<double, 8>;

struct Corners {
    Eight x, y, z, w;  // clip space
};

double lowest(const Eight& of) {
    std::array<double, 4> four;
    for (std::size_t k = 0; k < 4; ++k) four[k] = std::min(of[k], of[k + 4]);
    return std::min(std::min(four[0], four[2]), std::min(four[1], four[3]));
}

double highest(const Eight& of) {
    std::array<double, 4> four;
    for (std::size_t k = 0; k < 4; ++k) four[k] = std::max(of[k], of[k + 4]);
    return std::max(std::max(four[0], four[2]), std::max(four[1], four[3]));
}

Corners project_corners(const glm::dmat4& matrix, const glm::dvec3& low, const glm::dvec3& size) {
    const glm::dvec4 first = matrix * glm::dvec4(low, 1.0);
    const auto corners_of = [&](glm::length_t row) {
        const double dx = matrix[0][row] * size.x;
        const double dy = matrix[1][row] * size.y;
        const double dz = matrix[2][row] * size.z;
        const double at = first[row];
        const double up = at + dy;
        return Eight{at, at + dx, up, up + dx, at + dz, at + dx + dz, up + dz, up + dx + dz};
    };
    return {corners_of(0), corners_of(1), corners_of(2), corners_of(3)};
}

// The bounds of projected points.
struct Extent {
    double low_x = 1e30;
    double low_y = 1e30;
    double high_x = -1e30;
    double high_y = -1e30;
    double nearest_w = 1e30;

    void add(double x, double y, double w) {
        const double scale = 1.0 / w;
        low_x = std::min(low_x, x * scale);
        low_y = std::min(low_y, y * scale);
        high_x = std::max(high_x, x * scale);
        high_y = std::max(high_y, y * scale);
        nearest_w = std::min(nearest_w, w);
    }
};

// The extent of all corners. It has no branches, because nearly every box is in front of the eye.
Extent extent_of(const Corners& corners) {
    Eight x, y;
    for (std::size_t k = 0; k < 8; ++k) {
        const double scale = 1.0 / corners.w[k];
        x[k] = corners.x[k] * scale;
        y[k] = corners.y[k] * scale;
    }
    return {lowest(x), lowest(y), highest(x), highest(y), lowest(corners.w)};
}

// The pixel of a normalised coordinate, moved by `shift` pixels, within [-1, pixels].
int pixel_of(double ndc, int pixels, double shift) {
    // Clamp before the conversion: a box near the eye projects to numbers that no int holds.
    const double p = std::clamp((ndc * 0.5 + 0.5) * pixels + shift, -1.0, static_cast<double>(pixels));
    const int truncated = static_cast<int>(p);
    return truncated > p ? truncated - 1 : truncated;  // floor, which is a call on the baseline processor
}

}  // namespace

Frustum make_frustum(const View& view) {
    // Rows of the clip matrix (Gribb and Hartmann): -w <= x, y, z <= w.
    const glm::mat4 rows = glm::transpose(view.clip_from_model);
    return {{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] + rows[2],
             rows[3] - rows[2]}};
}

Frustum make_frustum(const View& view, const Rect& rect, const Box& within) {
    const glm::dmat4 rows = glm::transpose(glm::dmat4(view.clip_from_model));
    const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(within.min)), glm::abs(glm::dvec3(within.max)));
    // sign * (row - limit * w) >= 0, moved outwards by kFloatLoss.
    const auto plane = [&](glm::length_t row, double limit, double sign) {
        glm::dvec4 p = sign * (rows[row] - limit * rows[3]);
        const glm::dvec4 terms = glm::abs(rows[row]) + std::abs(limit) * glm::abs(rows[3]);
        p.w += kFloatLoss * glm::dot(terms, glm::dvec4(reach, 1.0));
        return glm::vec4(p);
    };
    const auto ndc = [](int pixel, int pixels) { return 2.0 * pixel / pixels - 1.0; };
    return {{plane(0, ndc(rect.x0 - 1, view.width), 1), plane(0, ndc(rect.x1 + 1, view.width), -1),
             plane(1, ndc(rect.y0 - 1, view.height), 1), plane(1, ndc(rect.y1 + 1, view.height), -1),
             plane(2, -1.0, 1), plane(2, 1.0, -1)}};
}

Rect screen_bounds(const Box& box, const View& view) { return ScreenBounds(view).of(box); }

ScreenBounds::ScreenBounds(const View& view)
    : viewport_(view.viewport()),
      matrix_(view.clip_from_model),
      magnitudes_(glm::abs(matrix_[0]), glm::abs(matrix_[1]), glm::abs(matrix_[2]), glm::abs(matrix_[3])) {}

Rect ScreenBounds::of(const Box& box) const {
    if (box.empty()) return {};
    const glm::dvec3 low_corner(box.min);
    const glm::dvec3 high_corner(box.max);
    const glm::dvec3 reach = glm::max(glm::abs(low_corner), glm::abs(high_corner));
    const glm::dvec4 loss = kFloatLoss * (magnitudes_[0] * reach.x + magnitudes_[1] * reach.y +
                                          magnitudes_[2] * reach.z + magnitudes_[3]);
    const double depth_loss = loss.z + loss.w;
    const Corners corners = project_corners(matrix_, low_corner, high_corner - low_corner);

    // inside[k] >= 0: corner k is inside of the near plane, or can be when computed in single precision.
    // beyond[k] > depth_loss: it is beyond the far plane in any case.
    Eight inside;
    Eight beyond;
    for (std::size_t k = 0; k < 8; ++k) {
        inside[k] = corners.z[k] + corners.w[k] + depth_loss;
        beyond[k] = corners.z[k] - corners.w[k];
    }
    if (highest(inside) < 0 || lowest(beyond) > depth_loss) return {};

    const bool crosses = lowest(inside) < 0;
    Extent extent;
    if (!crosses) extent = extent_of(corners);
    for (std::size_t k = 0; k < 8 && crosses; ++k) {
        if (inside[k] >= 0) extent.add(corners.x[k], corners.y[k], corners.w[k]);
        for (const std::size_t axis : {1u, 2u, 4u}) {  // the edge from k along each axis, once
            const std::size_t m = k | axis;
            if (m == k || (inside[k] >= 0) == (inside[m] >= 0)) continue;
            const double t = inside[k] / (inside[k] - inside[m]);
            extent.add(std::lerp(corners.x[k], corners.x[m], t), std::lerp(corners.y[k], corners.y[m], t),
                       std::lerp(corners.w[k], corners.w[m], t));
        }
    }
    // The near plane cannot be told from the eye, so the box may show anywhere.
    if (!(extent.nearest_w > loss.w)) return viewport_;

    const double crossing = crosses ? 1.0 : 0.0;
    const auto margin = [&](double coordinate_loss, int pixels) {
        const double lost = (coordinate_loss + 2 * loss.w) / extent.nearest_w * 0.5 * pixels;
        return lost > kHarmlessPixels ? std::ceil(lost) + crossing : crossing;
    };
    const double margin_x = margin(loss.x, viewport_.x1);
    const double margin_y = margin(loss.y, viewport_.y1);
    const Rect rect{pixel_of(extent.low_x, viewport_.x1, -margin_x),
                    pixel_of(extent.low_y, viewport_.y1, -margin_y),
                    pixel_of(extent.high_x, viewport_.x1, margin_x) + 1,
                    pixel_of(extent.high_y, viewport_.y1, margin_y) + 1};
    return intersect(rect, viewport_);
}

}  // namespace swath
