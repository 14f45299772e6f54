#include "common/cull/wide/wide_hierarchy.h"

#include <gtest/gtest.h>

#include "common/cull/wide/flat_scan.h"
#include "tests/common/cull/wide/random_scene.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using test::kClock;
constexpr std::size_t kSizes[] = {0, 1, 2, 15, 16, 17, 31, 255, 256, 257, 300, 4095, 4096, 4097, 5001};

TEST(WideHierarchy, AndTheFlatScanKeepExactlyWhatIsNotOutside) {
    ThreadTeam alone(1, kClock);
    RandomScene scene(1);
    std::size_t some = 0;
    for (const InstructionSet set : instruction_sets())
        for (const Layout layout : kLayouts)
            for (const std::size_t size : kSizes) {
                const std::vector<Box> boxes = scene.boxes(size, layout);
                WideHierarchy hierarchy(boxes, alone, set);
                FlatScan scan(hierarchy.blocks(), alone, set);
                for (int round = 0; round < 8; ++round) {
                    const Frustum frustum = scene.frustum();
                    const std::vector<std::uint32_t> expected = by_brute_force(boxes, frustum);
                    ASSERT_EQ(copy_of(hierarchy.cull(frustum)), expected) << name(set) << " " << size;
                    ASSERT_EQ(copy_of(scan.cull(frustum)), expected) << name(set) << " " << size;
                    some += !expected.empty() && expected.size() < size ? 1 : 0;
                }
            }
    EXPECT_GT(some, 200u);
}

TEST(WideHierarchy, IsExactForFrustaThatNoCameraHas) {
    ThreadTeam alone(1, kClock);
    RandomScene scene(2);
    for (const InstructionSet set : instruction_sets())
        for (const Layout layout : kLayouts)
            for (const std::size_t size : {17u, 257u, 4097u}) {
                const std::vector<Box> boxes = scene.boxes(size, layout);
                WideHierarchy hierarchy(boxes, alone, set);
                FlatScan scan(hierarchy.blocks(), alone, set);
                for (int kind = 0; kind < 3 * RandomScene::kOddFrusta; ++kind) {
                    const Frustum frustum = scene.odd_frustum(kind % RandomScene::kOddFrusta);
                    const std::vector<std::uint32_t> expected = by_brute_force(boxes, frustum);
                    ASSERT_EQ(copy_of(hierarchy.cull(frustum)), expected) << name(set) << " " << kind;
                    ASSERT_EQ(copy_of(scan.cull(frustum)), expected) << name(set) << " " << kind;
                }
            }
}

TEST(WideHierarchy, FindsTheSameWithAnyNumberOfThreads) {
    RandomScene scene(3);
    for (const std::size_t members : {1u, 2u, 3u, 5u, 7u, 16u, 33u, 64u}) {
        ThreadTeam team(members, kClock);
        for (const std::size_t size : {0u, 1u, 17u, 257u, 4097u, 20'001u})
            for (const Layout layout : {Layout::kMorton, Layout::kDegenerate}) {
                const std::vector<Box> boxes = scene.boxes(size, layout);
                WideHierarchy hierarchy(boxes, team, best_instruction_set(), SharingMode::kAlways);
                FlatScan scan(hierarchy.blocks(), team, best_instruction_set(), SharingMode::kAlways);
                for (int round = 0; round < 6; ++round) {
                    const Frustum frustum = round < 4 ? scene.frustum() : scene.odd_frustum(round - 4);
                    const std::vector<std::uint32_t> expected = by_brute_force(boxes, frustum);
                    ASSERT_EQ(copy_of(hierarchy.cull(frustum)), expected) << members << " " << size;
                    ASSERT_EQ(copy_of(scan.cull(frustum)), expected) << members << " " << size;
                }
            }
    }
}

TEST(WideHierarchy, FollowsBoxesThatMoved) {
    ThreadTeam alone(1, kClock);
    RandomScene scene(4);
    for (const InstructionSet set : instruction_sets()) {
        WideHierarchy hierarchy(scene.boxes(4'500, Layout::kMorton), alone, set);
        for (const Layout layout : kLayouts) {
            const std::vector<Box> moved = scene.boxes(4'500, layout);
            hierarchy.refit(moved);
            for (int round = 0; round < 5; ++round) {
                const Frustum frustum = scene.frustum();
                ASSERT_EQ(copy_of(hierarchy.cull(frustum)), by_brute_force(moved, frustum)) << name(set);
            }
        }
    }
}

TEST(WideHierarchy, TestsOneBlockWhenAllIsInsideOrAllIsOutside) {
    ThreadTeam alone(1, kClock);
    RandomScene scene(5);
    const std::vector<Box> boxes = scene.boxes(10'000, Layout::kRandom);
    WideHierarchy hierarchy(boxes, alone);
    EXPECT_EQ(hierarchy.cull(scene.odd_frustum(0)).size(), boxes.size());
    EXPECT_EQ(hierarchy.work().inner_blocks, 1u);
    EXPECT_EQ(hierarchy.work().leaf_blocks, 0u);
    EXPECT_TRUE(hierarchy.cull(scene.odd_frustum(1)).empty());
    EXPECT_EQ(hierarchy.work().inner_blocks, 1u);
    EXPECT_EQ(hierarchy.work().leaf_blocks, 0u);
}

TEST(WideHierarchy, LeavesMostOfAWellOrderedSceneAlone) {
    RandomScene scene(6);
    const std::vector<Box> boxes = scene.boxes(20'000, Layout::kMorton);
    ThreadTeam team(3, kClock);
    Camera camera;
    camera.eye = {-0.2f, 0.4f, 0.5f};
    camera.target = {1, 0.6f, 0.4f};
    camera.fov_y = 0.5f;
    const Frustum frustum = make_frustum(make_view(camera, 400, 300));
    for (const SharingMode mode : {SharingMode::kWhenItPays, SharingMode::kAlways}) {
        WideHierarchy hierarchy(boxes, team, best_instruction_set(), mode);
        EXPECT_GT(hierarchy.cull(frustum).size(), 1'000u);
        EXPECT_GT(hierarchy.work().leaf_blocks, 0u);
        EXPECT_LT(hierarchy.work().leaf_blocks, boxes.size() / 16 / 2);
        EXPECT_LE(hierarchy.crossing_nodes(frustum), hierarchy.work().inner_blocks);
        EXPECT_GT(hierarchy.crossing_nodes(frustum), 0u);
    }
}

}  // namespace
}  // namespace swath
