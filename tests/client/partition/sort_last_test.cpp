#include "client/partition/sort_last.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/client/partition/scenes.h"

namespace swath {
namespace {

using test::cube;
using test::front_view;
using test::input_of;

TEST(SortLast, KeepsItsGroupsWhateverTheView) {
    const std::vector<test::Scene> scenes = test::awkward_scenes();
    const std::vector<Object>& objects = scenes[2].objects;
    SortLast partitioner(objects);
    const auto plan_from = [&](const glm::vec3& eye) {
        Camera camera;
        camera.eye = eye;
        const View view = make_view(camera, 640, 480);
        return partitioner.partition(input_of(project(objects, view), view, 12));
    };
    const FramePlan front = plan_from({0, 0, 5});
    const FramePlan side = plan_from({5, 1, 0});
    for (std::size_t s = 0; s < 12; ++s) {
        EXPECT_EQ(front.servers[s].group, side.servers[s].group);
        EXPECT_EQ(front.servers[s].tile, side.servers[s].tile);
    }
    EXPECT_NE(front.servers[0].content, side.servers[0].content);
}

// Divides along z, the longest side, which the screen does not show: 0 and 1 lie in front of 2 and 3.
TEST(SortLast, DividesInModelSpaceAlongTheLongestSide) {
    const std::vector<Object> objects{cube({0, 0, 3}, 0.1f, 10), cube({0.2f, 0, -9}, 0.1f, 10),
                                      cube({0, 0.2f, -3}, 0.1f, 10), cube({0, 0, 1}, 0.1f, 10)};
    const View view = front_view();
    const FramePlan plan = SortLast(objects).partition(input_of(project(objects, view), view, 2));
    EXPECT_EQ(plan.servers[0].group, (std::vector<ObjectId>{1, 2}));
    EXPECT_EQ(plan.servers[1].group, (std::vector<ObjectId>{0, 3}));
}

TEST(SortLast, DealsTilesOf80PixelsSoThatNeighboursDiffer) {
    const View view = front_view(1280, 960);
    for (const std::size_t servers : {4u, 8u, 16u, 64u, 1024u}) {
        const FramePlan plan = SortLast({}).partition(input_of({}, view, servers));
        std::vector<std::vector<std::size_t>> owner(12, std::vector<std::size_t>(16, servers));
        for (std::size_t s = 0; s < servers; ++s)
            for (const Rect& tile : plan.servers[s].tile) {
                EXPECT_EQ(tile.width(), 80);
                EXPECT_EQ(tile.height(), 80);
                owner[static_cast<std::size_t>(tile.y0 / 80)][static_cast<std::size_t>(tile.x0 / 80)] = s;
            }
        for (std::size_t y = 0; y < 12; ++y)
            for (std::size_t x = 0; x < 16; ++x) {
                ASSERT_LT(owner[y][x], servers);
                EXPECT_TRUE(x == 0 || owner[y][x] != owner[y][x - 1]);
                EXPECT_TRUE(y == 0 || owner[y][x] != owner[y - 1][x]);
            }
    }
    // (tx + ty * (8 | 1)) mod 64: the square at column 2, row 3 belongs to 29.
    const FramePlan plan = SortLast({}).partition(input_of({}, view, 64));
    EXPECT_EQ(plan.servers[29].tile[1], (Rect{160, 240, 240, 320}));
}

TEST(SortLast, CutsTheLastTilesOffAtTheEdge) {
    const FramePlan plan = SortLast({}).partition(input_of({}, front_view(100, 81), 4));
    std::set<std::pair<int, int>> sizes;
    for (const ServerShare& share : plan.servers)
        for (const Rect& tile : share.tile) sizes.emplace(tile.width(), tile.height());
    EXPECT_EQ(sizes, (std::set<std::pair<int, int>>{{80, 80}, {20, 80}, {80, 1}, {20, 1}}));
}

}  // namespace
}  // namespace swath
