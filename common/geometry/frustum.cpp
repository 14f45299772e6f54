#include "common/geometry/frustum.h"

#include <cmath>

namespace swath {

Frustum make_frustum(const View& view) {
    // Rows of the clip matrix (Gribb and Hartmann): -w <= x, y, z <= w.
    const glm::mat4 rows = glm::transpose(view.clip_from_model);
    return {{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] + rows[2],
             rows[3] - rows[2]}};
}

Rect screen_bounds(const Box& box, const View& view) {
    if (box.empty()) return {};
    const glm::dmat4 matrix(view.clip_from_model);
    std::array<glm::dvec4, 8> clip;
    int in_front = 0;
    for (int k = 0; k < 8; ++k) {
        clip[static_cast<std::size_t>(k)] = matrix * glm::dvec4(glm::dvec3(box.corner(k)), 1.0);
        const glm::dvec4& c = clip[static_cast<std::size_t>(k)];
        in_front += c.z + c.w >= 0 && c.w > 0 ? 1 : 0;
    }
    if (in_front == 0) return {};

    glm::dvec2 low(1e30), high(-1e30);
    const auto add = [&](const glm::dvec4& c) {
        const glm::dvec2 ndc = glm::dvec2(c) / c.w;
        low = glm::min(low, ndc);
        high = glm::max(high, ndc);
    };
    for (std::size_t k = 0; k < 8; ++k) {
        const double d = clip[k].z + clip[k].w;
        if (d >= 0 && clip[k].w > 0) add(clip[k]);
        for (const std::size_t axis : {1u, 2u, 4u}) {  // the edge from k along each axis, once
            const std::size_t m = k | axis;
            if (m == k) continue;
            const double e = clip[m].z + clip[m].w;
            if ((d >= 0) == (e >= 0)) continue;
            const glm::dvec4 cut = clip[k] + (clip[m] - clip[k]) * (d / (d - e));
            if (cut.w > 0) add(cut);
        }
    }
    const double margin = in_front < 8 ? 1.0 : 0.0;
    // Clamp before the conversion: a box near the eye projects to numbers that no int holds.
    const auto pixel = [](double ndc, int size, double shift) {
        const double p = std::floor((ndc * 0.5 + 0.5) * size + shift);
        return static_cast<int>(std::clamp(p, -1.0, static_cast<double>(size)));
    };
    const Rect rect{pixel(low.x, view.width, -margin), pixel(low.y, view.height, -margin),
                    pixel(high.x, view.width, margin) + 1, pixel(high.y, view.height, margin) + 1};
    return intersect(rect, view.viewport());
}

}  // namespace swath
