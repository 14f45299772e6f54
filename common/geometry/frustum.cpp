#include "common/geometry/frustum.h"

#include <cmath>

namespace swath {
namespace {

// What single precision may lose of a clip coordinate, relative to the sum of its terms' magnitudes: the
// renderer's 4 products and 3 sums lose at most 2.4e-7, clipping as much again.
constexpr double kFloatLoss = 1e-6;
// A pixel is drawn when its centre is covered, so an error below half a pixel (less the rasteriser's
// snapping) cannot reach the next one.
constexpr double kHarmlessPixels = 0.25;

}  // namespace

Frustum make_frustum(const View& view) {
    // Rows of the clip matrix (Gribb and Hartmann): -w <= x, y, z <= w.
    const glm::mat4 rows = glm::transpose(view.clip_from_model);
    return {{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] + rows[2],
             rows[3] - rows[2]}};
}

Rect screen_bounds(const Box& box, const View& view) {
    if (box.empty()) return {};
    const glm::dmat4 matrix(view.clip_from_model);
    const glm::dvec3 low_corner(box.min);
    const glm::dvec3 high_corner(box.max);
    const glm::dvec3 reach = glm::max(glm::abs(low_corner), glm::abs(high_corner));
    const glm::dvec4 loss = kFloatLoss * (glm::abs(matrix[0]) * reach.x + glm::abs(matrix[1]) * reach.y +
                                          glm::abs(matrix[2]) * reach.z + glm::abs(matrix[3]));
    const double depth_loss = loss.z + loss.w;

    const glm::dvec3 size = high_corner - low_corner;
    std::array<glm::dvec4, 8> clip;
    clip[0] = matrix * glm::dvec4(low_corner, 1.0);
    clip[1] = clip[0] + matrix[0] * size.x;
    for (std::size_t k = 0; k < 2; ++k) clip[k + 2] = clip[k] + matrix[1] * size.y;
    for (std::size_t k = 0; k < 4; ++k) clip[k + 4] = clip[k] + matrix[2] * size.z;

    // How far inside the near plane, or as good as inside when computed in single precision.
    const auto inside_near = [&](const glm::dvec4& c) { return c.z + c.w + depth_loss; };
    int in_front = 0;
    int beyond = 0;
    for (const glm::dvec4& c : clip) {
        in_front += inside_near(c) >= 0 ? 1 : 0;
        beyond += c.z - c.w > depth_loss ? 1 : 0;
    }
    if (in_front == 0 || beyond == 8) return {};

    glm::dvec2 low(1e30);
    glm::dvec2 high(-1e30);
    double nearest_w = 1e30;
    const auto add = [&](const glm::dvec4& c) {
        const glm::dvec2 ndc = glm::dvec2(c) / c.w;
        low = glm::min(low, ndc);
        high = glm::max(high, ndc);
        nearest_w = std::min(nearest_w, c.w);
    };
    for (std::size_t k = 0; k < 8; ++k) {
        const double d = inside_near(clip[k]);
        if (d >= 0) add(clip[k]);
        if (in_front == 8) continue;
        for (const std::size_t axis : {1u, 2u, 4u}) {  // the edge from k along each axis, once
            const std::size_t m = k | axis;
            if (m == k) continue;
            const double e = inside_near(clip[m]);
            if ((d >= 0) != (e >= 0)) add(clip[k] + (clip[m] - clip[k]) * (d / (d - e)));
        }
    }
    // The near plane cannot be told from the eye: the box may show anywhere.
    if (!(nearest_w > loss.w)) return view.viewport();

    const auto margin = [&](double coordinate_loss, int pixels) {
        const double lost = (coordinate_loss + 2 * loss.w) / nearest_w * 0.5 * pixels;
        const double crossing = in_front < 8 ? 1.0 : 0.0;
        return lost > kHarmlessPixels ? std::ceil(lost) + crossing : crossing;
    };
    const double margin_x = margin(loss.x, view.width);
    const double margin_y = margin(loss.y, view.height);
    // Clamp before the conversion: a box near the eye projects to numbers that no int holds.
    const auto pixel = [](double ndc, int pixels, double shift) {
        const double p = std::floor((ndc * 0.5 + 0.5) * pixels + shift);
        return static_cast<int>(std::clamp(p, -1.0, static_cast<double>(pixels)));
    };
    const Rect rect{pixel(low.x, view.width, -margin_x), pixel(low.y, view.height, -margin_y),
                    pixel(high.x, view.width, margin_x) + 1, pixel(high.y, view.height, margin_y) + 1};
    return intersect(rect, view.viewport());
}

}  // namespace swath
