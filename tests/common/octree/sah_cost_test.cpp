#include <gtest/gtest.h>

#include "common/octree/sah/sah_builder.h"
#include "common/published/octree/sah_cost.h"
#include "common/published/octree/sah_kd_tree.h"
#include "common/scene/model.h"
#include "tests/support/models.h"

namespace swath {
namespace {

constexpr double kTraversal = 3;
constexpr double kIntersection = 2;

double cost(const SahTree& tree) { return sah_cost(tree, kTraversal, kIntersection); }

// A tree in a box of edge 4. Areas below are halves; the box's is 48.
SahTree tree_of(std::vector<SahNode> nodes) { return {{glm::vec3(0), glm::vec3(4)}, std::move(nodes), {}}; }

TEST(SahCost, OfALeafIsThatOfItsTriangles) {
    EXPECT_DOUBLE_EQ(cost(tree_of({SahNode::leaf(0, 7)})), 14);
    EXPECT_DOUBLE_EQ(cost(tree_of({SahNode::leaf(0, 0)})), 0);
}

TEST(SahCost, OfABoxWithoutAreaIsZero) {
    EXPECT_EQ(cost({{glm::vec3(1), glm::vec3(1, 1, 5)}, {SahNode::leaf(0, 7)}, {}}), 0);
    EXPECT_EQ(cost({{glm::vec3(1), glm::vec3(1)}, {SahNode::leaf(0, 1)}, {}}), 0);
}

TEST(SahCost, OfAKdNodeIsEquationOne) {
    // 1 by 4 by 4 has 24, 3 by 4 by 4 has 40.
    const SahTree tree = tree_of({SahNode::inner({1, 0, 0}, 1, 1), SahNode::leaf(0, 5), SahNode::leaf(5, 2)});
    EXPECT_DOUBLE_EQ(cost(tree), 3 + 2 * (5 * 24 + 2 * 40) / 48.0);
}

TEST(SahCost, OfANodeInANodeCountsItsShareOfTheArea) {
    const SahTree tree = tree_of({SahNode::inner({1, 0, 0}, 1, 1), SahNode::leaf(0, 5),
                                  SahNode::inner({0, 0, 2}, 4, 3), SahNode::leaf(5, 2), SahNode::leaf(7, 1)});
    // 3 by 4 by 2 has 26.
    EXPECT_DOUBLE_EQ(cost(tree), 3 + (2 * 5 * 24 + 3 * 40 + 2 * (2 + 1) * 26) / 48.0);
}

TEST(SahCost, OfAnOctreeNodeIsThatOfTheKdNodesThatDoTheSame) {
    std::vector<SahNode> octree{SahNode::inner({1, 2, 3}, 7, 1)};
    for (std::uint32_t child = 0; child < 8; ++child) octree.push_back(SahNode::leaf(0, child + 1));
    std::vector<SahNode> kd{SahNode::inner({1, 0, 0}, 1, 1)};
    for (std::uint32_t x = 0; x < 2; ++x) kd.push_back(SahNode::inner({0, 2, 0}, 2, 3 + 2 * x));
    for (std::uint32_t xy = 0; xy < 4; ++xy) kd.push_back(SahNode::inner({0, 0, 3}, 4, 7 + 2 * xy));
    for (std::uint32_t xy = 0; xy < 4; ++xy)
        for (std::uint32_t z = 0; z < 2; ++z)
            kd.push_back(SahNode::leaf(0, (xy >> 1 | (xy & 1) << 1 | z << 2) + 1));
    EXPECT_DOUBLE_EQ(cost(tree_of(octree)), cost(tree_of(kd)));
    // By hand: x cuts 48 to 24 and 40, y these to 14 and 14, 26 and 26, z these to 1 2 3 (11) and 1 2 1 (5),
    // 3 2 3 (21) and 3 2 1 (11).
    const double tests = 11 * (1 + 3) + 5 * (5 + 7) + 21 * (2 + 4) + 11 * (6 + 8);
    EXPECT_DOUBLE_EQ(cost(tree_of(octree)), (3 * (48 + 24 + 40 + 14 + 14 + 26 + 26) + 2 * tests) / 48.0);
    // Two axes.
    std::vector<SahNode> two{SahNode::inner({0, 2, 3}, 6, 1)};
    for (std::uint32_t child = 0; child < 4; ++child) two.push_back(SahNode::leaf(0, child));
    // y cuts 48 to 32 and 32, z these to 4 2 3 (26) and 4 2 1 (14).
    EXPECT_DOUBLE_EQ(cost(tree_of(two)), (3 * (48 + 32 + 32) + 2 * (26 * (0 + 1) + 14 * (2 + 3))) / 48.0);
}

void expect_as_good_as_a_kd_tree(const std::string& model) {
    const auto mesh = load_model(model);
    ASSERT_TRUE(mesh.has_value());
    const SahTriangles triangles{reinterpret_cast<const std::byte*>(mesh->vertices.data()), sizeof(Vertex),
                                 mesh->vertices.size(), mesh->indices};
    SahBuilder builder(2);
    const auto octree = builder.build(triangles, kDefaultSah);
    const auto kd_tree = build_sah_kd_tree(triangles, kDefaultSah);
    ASSERT_TRUE(octree.has_value() && kd_tree.has_value());
    const auto of = [](const SahTree& tree) {
        return sah_cost(tree, static_cast<double>(kDefaultSah.traversal_cost),
                        static_cast<double>(kDefaultSah.intersection_cost));
    };
    EXPECT_LE(of(*octree), 1.15 * of(*kd_tree)) << of(*octree) << " and " << of(*kd_tree);
    testing::Test::RecordProperty("ratio", std::to_string(of(*octree) / of(*kd_tree)));
    const auto fast = builder.build(triangles, kFastSah);
    ASSERT_TRUE(fast.has_value());
    EXPECT_LE(of(*fast), 3 * of(*octree));
}

TEST(SahCost, OfTheOctreeIsAtMostFifteenPerCentAboveTheKdTrees) {
    for (const char* model : {"knot:60000", "spheres:60000", "town:60000", "hand:60000", "swarm:60000"}) {
        SCOPED_TRACE(model);
        expect_as_good_as_a_kd_tree("builtin:" + std::string(model));
    }
}

TEST(SahCost, OfTheOctreeIsAtMostFifteenPerCentAboveTheKdTreesOnTheBunny) {
    SWATH_SHARED_MODEL(path, "bunny.ply");
    expect_as_good_as_a_kd_tree(path);
}
TEST(SahCost, OfTheOctreeIsAtMostFifteenPerCentAboveTheKdTreesOnTheConference) {
    SWATH_SHARED_MODEL(path, "conference.ply");
    expect_as_good_as_a_kd_tree(path);
}
TEST(SahCost, OfTheOctreeIsAtMostFifteenPerCentAboveTheKdTreesOnTheDragon) {
    SWATH_SHARED_MODEL(path, "dragon.ply");
    expect_as_good_as_a_kd_tree(path);
}

}  // namespace
}  // namespace swath
