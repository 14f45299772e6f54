#include "common/published/cull/cell_order.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace swath {
namespace {

constexpr int kDeepest = UniformOctree::kMaxHeight;

bool is_finite(const Box& box) {
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) return false;
    return true;
}

// Adds in double precision, because the sum of two floats may be too large for a float.
glm::dvec3 centre_of(const Box& box) { return 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max)); }

double longest(const glm::dvec3& size) { return std::max({size.x, size.y, size.z}); }

}  // namespace

CellOrder cell_order(std::span<const Box> boxes) {
    CellOrder order;
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    double largest = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!is_finite(boxes[i])) {
            order.unplaced.push_back(static_cast<std::uint32_t>(i));
            continue;
        }
        order.placed.push_back({0, static_cast<std::uint32_t>(i)});
        low = glm::min(low, centre_of(boxes[i]));
        high = glm::max(high, centre_of(boxes[i]));
        largest = std::max(largest, longest(glm::dvec3(boxes[i].max) - glm::dvec3(boxes[i].min)));
    }
    if (order.placed.empty()) return order;

    order.origin = low;
    order.side = longest(high - low);
    if (order.side == 0) {  // all are at one place, which gets a cube around it
        order.side = largest > 0 ? largest : 1;
        order.origin -= glm::dvec3(0.5 * order.side);
    }
    const double cells = 1 << kDeepest;
    for (MortonKey& entry : order.placed) {
        const glm::dvec3 at = (centre_of(boxes[entry.index]) - order.origin) * (cells / order.side);
        const glm::uvec3 cell(glm::clamp(at, glm::dvec3(0), glm::dvec3(cells - 1)));
        entry.code = octree_code({cell.x, cell.y, cell.z});
    }
    sort_by_code(order.placed);

    // From the level on which two neighbours' codes first differ, they take one cell more.
    order.occupied.fill(1);
    for (std::size_t i = 1; i < order.placed.size(); ++i) {
        const std::uint32_t differing = order.placed[i - 1].code ^ order.placed[i].code;
        if (differing == 0) continue;
        for (int level = kDeepest - (std::bit_width(differing) - 1) / 3; level <= kDeepest; ++level)
            ++order.occupied[static_cast<std::size_t>(level)];
    }
    return order;
}

int CellOrder::height_for(double boxes_per_leaf, int highest) const {
    const auto leaves = static_cast<double>(placed.size()) / boxes_per_leaf;
    int height = 0;
    while (height < highest && static_cast<double>(occupied[static_cast<std::size_t>(height)]) < leaves)
        ++height;
    return height;
}

}  // namespace swath
