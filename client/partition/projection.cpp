#include "client/partition/projection.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/geometry/frustum.h"

namespace swath {
namespace {

// The pixel of the viewport's border in the direction of a box that cannot be seen.
Rect border_pixel(const Box& box, const View& view) {
    const glm::dvec4 clip =
        glm::dmat4(view.clip_from_model) * glm::dvec4(0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max)), 1.0);
    // Behind the eye there is no projection, but the sign still tells the side on which the box lies.
    glm::dvec2 ndc = glm::dvec2(clip) / std::max(std::abs(clip.w), 1e-30);
    const double reach = std::max(std::abs(ndc.x), std::abs(ndc.y));
    if (!(reach > 1e-9 && reach < 1e60)) {
        ndc = {-1, -1};  // straight behind, or nowhere (an empty box): any corner will do
    } else if (reach < 1) {
        ndc /= reach;  // behind the eye or beyond the far plane: push it out to the border
    }
    const auto pixel = [](double at, int pixels) {
        const double p = std::floor((std::clamp(at, -1.0, 1.0) * 0.5 + 0.5) * pixels);
        return std::min(static_cast<int>(p), pixels - 1);
    };
    const int x = pixel(ndc.x, view.width);
    const int y = pixel(ndc.y, view.height);
    return {x, y, x + 1, y + 1};
}

}  // namespace

std::vector<ProjectedObject> project(std::span<const Object> objects, const View& view, Accounting accounting,
                                     std::span<const std::uint32_t> costs) {
    if (!costs.empty()) CHECK(costs.size() == objects.size());
    CHECK(view.width > 0);
    CHECK(view.height > 0);
    const ScreenBounds bounds(view);
    std::vector<ProjectedObject> projected(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ProjectedObject& object = projected[i];
        const Box box = objects[i].box_at(view.pose);
        object.box = bounds.of(box);
        object.visible = !object.box.empty();
        if (object.visible || accounting == Accounting::kPaper)
            object.work = costs.empty() ? objects[i].triangle_count : costs[i];
        if (!object.visible) object.box = border_pixel(box, view);
    }
    return projected;
}

}  // namespace swath
