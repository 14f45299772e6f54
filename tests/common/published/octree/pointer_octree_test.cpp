#include "common/published/octree/pointer_octree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::array kOrders{AllocationOrder::kDepthFirst, AllocationOrder::kBreadthFirst,
                             AllocationOrder::kRandom};

// Collects nodes in depth-first order.
void collect(const OctreeNode& node, std::vector<const OctreeNode*>& nodes) {
    nodes.push_back(&node);
    for (const OctreeNode* child : node.children)
        if (child != nullptr) collect(*child, nodes);
}

std::vector<const OctreeNode*> collect(const PointerOctree& tree) {
    std::vector<const OctreeNode*> nodes;
    collect(tree.root(), nodes);
    return nodes;
}

TEST(PointerOctree, StoresEveryNodeOfTheUniformTreeInAnyOrder) {
    for (int height = 0; height <= 4; ++height)
        for (const AllocationOrder order : kOrders) {
            const UniformOctree shape(height);
            const PointerOctree tree(shape, order);
            std::vector<const OctreeNode*> nodes = collect(tree);
            ASSERT_EQ(nodes.size(), shape.node_count());
            for (const OctreeNode* node : nodes) {
                const Box box = shape.box_of(static_cast<int>(node->level), node->code);
                EXPECT_EQ((Box{{node->box[0], node->box[1], node->box[2]},
                               {node->box[3], node->box[4], node->box[5]}}),
                          box);
                for (std::uint32_t child = 0; child < 8; ++child) {
                    if (static_cast<int>(node->level) == height) {
                        EXPECT_EQ(node->children[child], nullptr);
                    } else {
                        EXPECT_EQ(node->children[child]->code, 8 * node->code + child);
                        EXPECT_EQ(node->children[child]->level, node->level + 1);
                    }
                }
            }
            std::ranges::sort(nodes);
            EXPECT_EQ(std::unique(nodes.begin(), nodes.end()), nodes.end());
        }
}

TEST(PointerOctree, LaysItsNodesInTheOrderAskedFor) {
    const UniformOctree shape(3);
    const auto place = [](const PointerOctree& tree, const OctreeNode* node) { return node - &tree.root(); };
    const PointerOctree depth_first(shape, AllocationOrder::kDepthFirst);
    std::ptrdiff_t next = 0;
    for (const OctreeNode* node : collect(depth_first)) EXPECT_EQ(place(depth_first, node), next++);

    const PointerOctree breadth_first(shape, AllocationOrder::kBreadthFirst);
    for (const OctreeNode* node : collect(breadth_first)) {
        const std::int64_t above = ((std::int64_t{1} << 3 * node->level) - 1) / 7;
        EXPECT_EQ(place(breadth_first, node), above + node->code);
    }

    const PointerOctree random(shape, AllocationOrder::kRandom, 1);
    const PointerOctree other(shape, AllocationOrder::kRandom, 2);
    int neighbours = 0;
    int same = 0;
    const auto nodes = collect(random);
    const auto others = collect(other);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        neighbours += nodes[i] - nodes[i - 1] == 1;
        same += nodes[i] - nodes[i - 1] == others[i] - others[i - 1];
    }
    EXPECT_LT(neighbours, 30);  // of 584
    EXPECT_LT(same, 30);
}

TEST(PointerOctree, RefusesAHeightThatTakesTooMuchMemory) {
    EXPECT_THROW(PointerOctree(UniformOctree(9), AllocationOrder::kDepthFirst), CheckFailed);
}

}  // namespace
}  // namespace swath
