#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "common/octree/sah/sah_builder.h"
#include "common/published/octree/sah_kd_tree.h"
#include "common/scene/model.h"
#include "tests/support/triangles.h"

namespace swath {
namespace {

using test::NamedSettings;
using test::Triangles;
using test::TriangleSet;

constexpr int kMaxDepth = 64;  // for both builders

SahTree build(SahBuilder& builder, const Triangles& triangles, const SahSettings& settings) {
    auto tree = builder.build(triangles.view(), settings);
    EXPECT_TRUE(tree.has_value()) << tree.error().message;
    return tree ? std::move(*tree) : SahTree{};
}

Triangles builtin(const std::string& model) {
    const auto mesh = load_model("builtin:" + model);
    EXPECT_TRUE(mesh.has_value());
    Triangles triangles;
    for (const Vertex& vertex : mesh->vertices) triangles.positions.push_back(vertex.position);
    triangles.indices = mesh->indices;
    return triangles;
}

bool same_bytes(const SahTree& a, const SahTree& b) {
    return std::memcmp(&a.box, &b.box, sizeof a.box) == 0 && a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(SahNode)) == 0 &&
           a.triangles == b.triangles;
}

// Follows triangles' boxes down a tree. With `kBelow` a box in a plane is below, as in SahBuilder; else it
// may be on either side.
template <bool kBelow>
struct Follow {
    const SahTree& tree;
    const std::vector<std::vector<std::uint32_t>>& sorted;  // the triangles of each leaf
    std::uint32_t triangle;
    std::size_t leaves = 0;  // in which it must be

    bool is_in(std::uint32_t at, const Box& part) {
        const SahNode& node = tree.nodes[at];
        if (node.is_leaf()) {
            ++leaves;
            return std::ranges::binary_search(sorted[at], triangle);
        }
        return is_in_parts(node, 0, 0, 0, part);
    }
    bool is_in_parts(const SahNode& node, int axis, std::uint32_t child, int bit, const Box& part) {
        if (axis == 3) return is_in(node.first_child() + child, part);
        if (!node.cuts(axis)) return is_in_parts(node, axis + 1, child, bit, part);
        const float plane = node.plane[static_cast<std::size_t>(axis)];
        Box below = part;
        Box above = part;
        below.max[axis] = std::min(plane, part.max[axis]);
        above.min[axis] = std::max(plane, part.min[axis]);
        const auto in_below = [&] { return is_in_parts(node, axis + 1, child, bit + 1, below); };
        const auto in_above = [&] { return is_in_parts(node, axis + 1, child | 1u << bit, bit + 1, above); };
        if (part.min[axis] == plane && part.max[axis] == plane) return in_below() || (!kBelow && in_above());
        return (part.min[axis] >= plane || in_below()) && (part.max[axis] <= plane || in_above());
    }
};

struct Shape {
    std::size_t leaves = 0;
    std::size_t empty = 0;
    int depth = 0;
};

// Expects that each node is reached once, behind its parent, with planes inside of its box; that each leaf
// has its own part of `triangles`, no triangle twice, and only triangles that exist.
void check_nodes(const SahTree& tree, std::size_t triangles, Shape& shape,
                 std::vector<std::vector<std::uint32_t>>& sorted) {
    struct Visit {
        std::uint32_t node;
        int depth;
        Box box;
    };
    ASSERT_FALSE(tree.nodes.empty());
    std::vector<bool> reached(tree.nodes.size());
    std::vector<bool> taken(tree.triangles.size());
    sorted.assign(tree.nodes.size(), {});
    std::vector<Visit> stack{{0, 0, tree.box}};
    while (!stack.empty()) {
        const Visit at = stack.back();
        stack.pop_back();
        ASSERT_FALSE(reached[at.node]);
        reached[at.node] = true;
        shape.depth = std::max(shape.depth, at.depth);
        const SahNode& node = tree.nodes[at.node];
        if (node.is_leaf()) {
            ASSERT_LE(node.first() + std::size_t{node.count()}, tree.triangles.size());
            ++shape.leaves;
            shape.empty += node.count() == 0 ? 1 : 0;
            std::vector<std::uint32_t>& of_leaf = sorted[at.node];
            for (std::uint32_t i = node.first(); i < node.first() + node.count(); ++i) {
                ASSERT_FALSE(taken[i]);
                taken[i] = true;
                ASSERT_LT(tree.triangles[i], triangles);
                of_leaf.push_back(tree.triangles[i]);
            }
            std::ranges::sort(of_leaf);
            ASSERT_TRUE(std::ranges::adjacent_find(of_leaf) == of_leaf.end());
            continue;
        }
        ASSERT_GT(node.first_child(), at.node);
        ASSERT_LE(node.first_child() + std::size_t{node.child_count()}, tree.nodes.size());
        for (std::uint32_t child = 0; child < node.child_count(); ++child) {
            Box box = at.box;
            std::uint32_t bit = 1;
            for (int axis = 0; axis < 3; ++axis) {
                if (!node.cuts(axis)) continue;
                const float plane = node.plane[static_cast<std::size_t>(axis)];
                ASSERT_LT(at.box.min[axis], plane);
                ASSERT_LT(plane, at.box.max[axis]);
                ((child & bit) != 0 ? box.min : box.max)[axis] = plane;
                bit <<= 1;
            }
            stack.push_back({node.first_child() + child, at.depth + 1, box});
        }
    }
    EXPECT_EQ(std::ranges::count(reached, false), 0);
    EXPECT_EQ(std::ranges::count(taken, false), 0);
    EXPECT_LE(shape.depth, kMaxDepth);
}

template <bool kBelow>
Shape check(const SahTree& tree, const Triangles& triangles) {
    Shape shape;
    std::vector<std::vector<std::uint32_t>> sorted;
    check_nodes(tree, triangles.count(), shape, sorted);
    if (testing::Test::HasFatalFailure()) return shape;
    EXPECT_TRUE(tree.box == triangles.box());
    std::size_t entries = 0;
    std::size_t missing = 0;
    for (std::uint32_t t = 0; t < triangles.count(); ++t) {
        Follow<kBelow> follow{tree, sorted, t};
        missing += follow.is_in(0, triangles.box_of(t)) ? 0 : 1;
        entries += follow.leaves;
    }
    EXPECT_EQ(missing, 0u);
    // No other leaf has it.
    if (kBelow) {
        EXPECT_EQ(entries, tree.triangles.size());
    }
    return shape;
}

TEST(SahBuilder, MakesAValidTreeOfAnythingWithAnySettings) {
    SahBuilder builder(2);
    for (const TriangleSet& set : test::triangle_sets())
        for (const NamedSettings& named : test::sah_settings()) {
            SCOPED_TRACE(set.name + ", " + named.name);
            const SahTree tree = build(builder, set.triangles, named.settings);
            const Shape shape = check<true>(tree, set.triangles);
            EXPECT_LE(tree.triangles.size() + shape.empty,
                      std::size_t{named.settings.max_duplication} * set.triangles.count());
            if (HasFatalFailure()) return;
        }
}

TEST(SahKdTree, IsValidForAnything) {
    for (const TriangleSet& set : test::triangle_sets())
        for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
            SCOPED_TRACE(set.name);
            const auto tree = build_sah_kd_tree(set.triangles.view(), settings);
            ASSERT_TRUE(tree.has_value());
            check<false>(*tree, set.triangles);
            EXPECT_TRUE(std::ranges::all_of(tree->nodes,
                                            [](const SahNode& node) { return node.child_count() <= 2; }));
        }
}

// Nodes with so many triangles are counted and moved in several pieces, on several levels.
TEST(SahBuilder, MakesAValidTreeOfALargeModel) {
    SahBuilder builder(2);
    for (const char* model : {"knot:120000", "town:80000", "spheres:60000"})
        for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
            SCOPED_TRACE(model);
            const Triangles triangles = builtin(model);
            const SahTree tree = build(builder, triangles, settings);
            const Shape shape = check<true>(tree, triangles);
            EXPECT_GT(shape.leaves, triangles.count() / 50);
            EXPECT_LE(tree.triangles.size() + shape.empty, settings.max_duplication * triangles.count());
        }
}

TEST(SahBuilder, MakesTheSameBytesWithAnyNumberOfThreads) {
    const std::vector<std::pair<std::string, Triangles>> models{{"town", builtin("town:30000")},
                                                                {"knot", builtin("knot:30000")},
                                                                {"soup", test::soup(20'000, 0.1f, 21)}};
    for (const auto& [name, triangles] : models)
        for (const NamedSettings& named : test::sah_settings()) {
            if (named.settings.grain == 1) continue;  // slow; they are below
            SCOPED_TRACE(name + ", " + named.name);
            SahBuilder one(1);
            const SahTree tree = build(one, triangles, named.settings);
            for (const std::size_t threads : {2u, 3u, 8u}) {
                SahBuilder builder(threads);
                EXPECT_TRUE(same_bytes(build(builder, triangles, named.settings), tree)) << threads;
            }
        }
    for (const TriangleSet& set : test::triangle_sets())
        for (const NamedSettings& named : test::sah_settings()) {
            SCOPED_TRACE(set.name + ", " + named.name);
            SahBuilder one(1);
            SahBuilder several(5);
            const SahTree tree = build(one, set.triangles, named.settings);
            EXPECT_TRUE(same_bytes(build(several, set.triangles, named.settings), tree));
        }
}

// Boxes begin at 0 and at -0, in any order and number: which of them the whole box has must not depend on the
// order.
TEST(SahBuilder, MakesTheSameBytesOfSignedZeros) {
    Triangles triangles;
    test::Numbers numbers(22);
    for (int i = 0; i < 50'000; ++i) {
        glm::vec3 corners[3] = {numbers.point(0, 1), numbers.point(0, 1), numbers.point(0, 1)};
        const int axis = i % 3;
        corners[i % 2][axis] = numbers.below(2) == 0 ? 0.0f : -0.0f;
        triangles.add(corners[0], corners[1], corners[2]);
    }
    SahBuilder one(1);
    const SahTree tree = build(one, triangles, kDefaultSah);
    for (int repeat = 0; repeat < 10; ++repeat)
        for (const std::size_t threads : {2u, 7u}) {
            SahBuilder builder(threads);
            EXPECT_TRUE(same_bytes(build(builder, triangles, kDefaultSah), tree)) << threads;
        }
}

TEST(SahBuilder, MakesTheSameBytesWhateverItBuiltBefore) {
    SahBuilder used(3);
    const Triangles large = test::soup(40'000, 0.05f, 23);
    const Triangles small = test::soup(700, 0.3f, 24);
    const auto by_new = [](const Triangles& triangles, const SahSettings& settings) {
        SahBuilder builder(3);
        return build(builder, triangles, settings);
    };
    for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
        const SahTree of_large = by_new(large, settings);
        const SahTree of_small = by_new(small, settings);
        for (int repeat = 0; repeat < 2; ++repeat) {
            EXPECT_TRUE(same_bytes(build(used, small, settings), of_small));
            EXPECT_TRUE(same_bytes(build(used, large, settings), of_large));
            EXPECT_TRUE(same_bytes(build(used, large, settings), of_large));
            EXPECT_FALSE(used.build({}, settings).has_value());
        }
    }
}

// Positions lie in a mesh's vertices, with other values between them.
TEST(SahBuilder, ReadsPositionsAtAnyStride) {
    const Triangles triangles = test::soup(3000, 0.1f, 25);
    std::vector<std::array<float, 7>> apart;
    for (const glm::vec3& p : triangles.positions) apart.push_back({NAN, p.x, p.y, p.z, NAN, 0, 3e38f});
    SahBuilder builder(2);
    const auto tree = builder.build(
        {reinterpret_cast<const std::byte*>(&apart[0][1]), sizeof apart[0], apart.size(), triangles.indices},
        kDefaultSah);
    ASSERT_TRUE(tree.has_value());
    EXPECT_TRUE(same_bytes(*tree, build(builder, triangles, kDefaultSah)));
}

}  // namespace
}  // namespace swath
