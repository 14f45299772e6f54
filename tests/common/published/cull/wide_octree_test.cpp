#include "common/published/cull/wide_octree.h"

#include <gtest/gtest.h>

#include "tests/common/cull/wide/random_scene.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using test::kClock;

// The canonical walk, ALGO5, over the implicit tree.
struct Canonical {
    const UniformOctree& shape;
    const Frustum& frustum;
    std::vector<std::uint32_t> leaves{};
    std::uint64_t tested = 0;

    void visit(int level, std::uint32_t code) {
        ++tested;
        if (outside(frustum, shape.box_of(level, code))) return;
        if (level == shape.height()) {
            leaves.push_back(code);
            return;
        }
        for (std::uint32_t child = 0; child < 8; ++child) visit(level + 1, 8 * code + child);
    }
};

// A camera's frustum in and around a cube with this edge.
Frustum frustum_in(RandomScene& scene, float edge) {
    Frustum frustum = scene.frustum();
    for (glm::vec4& plane : frustum.planes) plane.w *= edge;
    return frustum;
}

void expect_canonical(WideOctree& octree, const UniformOctree& shape, const Frustum& frustum) {
    Canonical canonical{shape, frustum};
    canonical.visit(0, 0);
    ASSERT_EQ(copy_of(octree.cull_same_nodes(frustum)), canonical.leaves);
    ASSERT_EQ(octree.tested_nodes(), canonical.tested);
    ASSERT_EQ(copy_of(octree.cull(frustum)), canonical.leaves);
}

TEST(WideOctree, FindsTheLeavesOfTheCanonicalWalkAndTestsTheSameNodes) {
    ThreadTeam alone(1, kClock);
    RandomScene scene(1);
    for (const InstructionSet set : instruction_sets())
        for (int height = 0; height <= 5; ++height) {
            const UniformOctree shape(height);
            WideOctree octree(shape, alone, set);
            for (int round = 0; round < 12; ++round) {
                SCOPED_TRACE(testing::Message() << name(set) << ", height " << height << ", round " << round);
                expect_canonical(octree, shape, frustum_in(scene, shape.edge()));
            }
        }
}

TEST(WideOctree, IsExactForFrustaThatNoCameraHas) {
    ThreadTeam alone(1, kClock);
    RandomScene scene(2);
    for (const InstructionSet set : instruction_sets())
        for (int height = 0; height <= 4; ++height) {
            const UniformOctree shape(height);
            WideOctree octree(shape, alone, set);
            for (int kind = 0; kind < 3 * RandomScene::kOddFrusta; ++kind) {
                SCOPED_TRACE(testing::Message() << name(set) << ", height " << height << ", kind " << kind);
                expect_canonical(octree, shape, scene.odd_frustum(kind % RandomScene::kOddFrusta));
            }
        }
}

TEST(WideOctree, FindsTheSameWithAnyNumberOfThreads) {
    RandomScene scene(3);
    for (const std::size_t members : {2u, 3u, 7u, 64u}) {
        ThreadTeam team(members, kClock);
        for (int height = 0; height <= 5; ++height) {
            const UniformOctree shape(height);
            WideOctree octree(shape, team, best_instruction_set(), SharingMode::kAlways);
            for (int round = 0; round < 6; ++round) {
                SCOPED_TRACE(testing::Message() << members << " members, height " << height);
                expect_canonical(octree, shape,
                                 round < 4 ? frustum_in(scene, shape.edge()) : scene.odd_frustum(round - 4));
            }
        }
    }
}

TEST(WideOctree, TestsEveryNodeOfATreeThatIsWhollyVisibleOrOnlyTheTop) {
    ThreadTeam alone(1, kClock);
    const UniformOctree shape(6);
    WideOctree octree(shape, alone);
    const Frustum everything = RandomScene(4).odd_frustum(0);
    EXPECT_EQ(octree.cull_same_nodes(everything).size(), 262'144u);
    EXPECT_EQ(octree.tested_nodes(), 299'593u);
    EXPECT_EQ(octree.cull(everything).size(), 262'144u);
    EXPECT_EQ(octree.tested_nodes(), 9u);
}

}  // namespace
}  // namespace swath
