#include "common/cull/wide/wide_culler.h"

#include <gtest/gtest.h>

#include "tests/common/cull/wide/random_scene.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using test::kClock;

TEST(WideCuller, GivesTheSameAnswerWhicheverWayItTakes) {
    ThreadTeam team(2, kClock);
    RandomScene scene(1);
    bool scanned = false;
    bool walked = false;
    for (const Layout layout : kLayouts)
        for (const std::size_t size : {0u, 1u, 100u, 1'500u, 30'000u}) {
            const std::vector<Box> boxes = scene.boxes(size, layout);
            WideCuller culler(boxes, team);
            for (int round = 0; round < 12; ++round) {
                const Frustum frustum = round % 4 != 0 ? scene.frustum() : scene.odd_frustum(round / 4);
                ASSERT_EQ(copy_of(culler.cull(frustum)), by_brute_force(boxes, frustum)) << size;
                const bool flat = culler.scanned();
                scanned |= flat;
                walked |= !flat;
            }
        }
    EXPECT_TRUE(scanned);
    EXPECT_TRUE(walked);
}

TEST(WideCuller, FindsBoxesWhereTheyHaveMovedTo) {
    ThreadTeam team(2, kClock);
    RandomScene scene(3);
    for (const std::size_t size : {0u, 1u, 100u, 30'000u}) {
        WideCuller culler(scene.boxes(size, Layout::kMorton), team);
        for (int round = 0; round < 12; ++round) {
            const std::vector<Box> boxes = scene.boxes(size, kLayouts[round % 5]);
            culler.refit(boxes);
            for (int again = 0; again < 3; ++again) {
                const Frustum frustum = scene.frustum();
                ASSERT_EQ(copy_of(culler.cull(frustum)), by_brute_force(boxes, frustum)) << size;
            }
        }
    }
}

class WideCullerChoice : public testing::Test {
  protected:
    // A part of the scene is in view.
    Frustum frustum_ = [] {
        Camera camera;
        camera.eye = {0.5f, 0.5f, 0.5f};
        camera.target = {1, 0.8f, 0.6f};
        camera.fov_y = 1;
        return make_frustum(make_view(camera, 400, 300));
    }();
    RandomScene scene_{2};
    ThreadTeam team_{1, kClock};
};

TEST_F(WideCullerChoice, IsTheScanForALargeSceneWithoutOrder) {
    WideCuller culler(scene_.boxes(50'000, Layout::kRandom), team_);
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_FALSE(culler.cull(frustum_).empty());
        EXPECT_TRUE(culler.scanned());
    }
    // No box crosses a plane.
    culler.cull(scene_.odd_frustum(1));
    EXPECT_FALSE(culler.scanned());
    // A frame like the last is a surprise at first, but not a second time.
    culler.cull(frustum_);
    culler.cull(frustum_);
    EXPECT_TRUE(culler.scanned());
}

TEST_F(WideCullerChoice, IsTheHierarchyForAWellOrderedScene) {
    WideCuller culler(scene_.boxes(50'000, Layout::kMorton), team_);
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_FALSE(culler.cull(frustum_).empty());
        EXPECT_FALSE(culler.scanned());
    }
}

TEST_F(WideCullerChoice, IsTheScanForAFewBoxes) {
    WideCuller culler(scene_.boxes(100, Layout::kMorton), team_);
    culler.cull(frustum_);
    EXPECT_TRUE(culler.scanned());
}

}  // namespace
}  // namespace swath
