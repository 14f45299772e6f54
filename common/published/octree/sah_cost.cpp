#include "common/published/octree/sah_cost.h"

namespace swath {
namespace {

double area(const Box& box) {
    const glm::dvec3 s = glm::dvec3(box.max) - glm::dvec3(box.min);
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

struct Visit {
    std::uint32_t node;
    Box box;
};

}  // namespace

double sah_cost(const SahTree& tree, double traversal, double intersection) {
    if (!(area(tree.box) > 0)) return 0;
    std::vector<Visit> stack{{0, tree.box}};
    double sum = 0;
    while (!stack.empty()) {
        const Visit at = stack.back();
        stack.pop_back();
        const SahNode& node = tree.nodes[at.node];
        if (node.is_leaf()) {
            sum += intersection * node.count() * area(at.box);
            continue;
        }
        std::vector<Visit> parts{{0, at.box}};
        std::uint32_t bit = 1;
        for (int axis = 0; axis < 3; ++axis) {
            if (!node.cuts(axis)) continue;
            const std::size_t count = parts.size();
            for (std::size_t i = 0; i < count; ++i) {
                sum += traversal * area(parts[i].box);
                Visit above = parts[i];
                above.node |= bit;
                above.box.min[axis] = node.plane[static_cast<std::size_t>(axis)];
                parts[i].box.max[axis] = node.plane[static_cast<std::size_t>(axis)];
                parts.push_back(above);
            }
            bit <<= 1;
        }
        for (const Visit& part : parts) stack.push_back({node.first_child() + part.node, part.box});
    }
    return sum / area(tree.box);
}

}  // namespace swath
