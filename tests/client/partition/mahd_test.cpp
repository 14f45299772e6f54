#include "client/partition/mahd.h"

#include <gtest/gtest.h>

#include "tests/client/partition/scenes.h"

namespace swath {
namespace {

using test::seen;
using test::unseen;

FramePlan mahd(const std::vector<ProjectedObject>& objects, int width, int height, std::size_t servers) {
    return test::partition<Mahd>(objects, width, height, servers);
}

// Four cells in a row. 0 puts 10 in each of the first two, 1 gives 5 to each of the middle two, 2 gives 20 to
// the last: 10, 15, 5, 20. The cut at 32 leaves 25 on each side; 1 crosses it and is drawn twice.
TEST(Mahd, CutsWhereTheLoadsOfTheCellsAreEqual) {
    const FramePlan plan =
        mahd({seen({0, 0, 32, 16}, 20), seen({20, 2, 45, 9}, 10), seen({50, 3, 60, 12}, 20)}, 64, 16, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1}, {{0, 0, 32, 16}}, {0, 0, 32, 16}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{1, 2}, {{32, 0, 64, 16}}, {32, 2, 60, 12}}));
    EXPECT_TRUE(transfers(plan).empty());
}

TEST(Mahd, MakesTheLargerLoadPerServerSmallest) {
    const std::vector<ProjectedObject> cells{seen({0, 0, 16, 16}, 6), seen({16, 0, 32, 16}, 1),
                                             seen({32, 0, 48, 16}, 1), seen({48, 0, 64, 16}, 1)};
    EXPECT_EQ(mahd(cells, 64, 16, 2).servers[0].tile, (Region{{0, 0, 16, 16}}));
    const std::vector<ProjectedObject> mirrored{seen({0, 0, 16, 16}, 1), seen({16, 0, 32, 16}, 1),
                                                seen({32, 0, 48, 16}, 1), seen({48, 0, 64, 16}, 6)};
    // The larger is 3 with all three light cells left, 7 / 2 with two of them, 4 with one.
    const FramePlan plan = mahd(mirrored, 64, 16, 3);
    EXPECT_EQ(plan.servers[0].tile, (Region{{0, 0, 48, 16}}));
}

// There is no load between the two: all lines from 16 to 96 are equally good.
TEST(Mahd, TakesTheLowestOfLinesThatAreEquallyGood) {
    const FramePlan plan = mahd({seen({0, 0, 9, 9}, 5), seen({97, 0, 99, 9}, 5)}, 128, 32, 2);
    EXPECT_EQ(plan.servers[0].tile, (Region{{0, 0, 16, 32}}));
}

// The touched cells are [32,64)x[0,96): upright, on a wide screen.
TEST(Mahd, CutsTheBoundsOfItsTouchedCellsButTilesTheWholeScreen) {
    const FramePlan plan = mahd({seen({40, 1, 50, 40}, 3), seen({40, 50, 50, 95}, 3)}, 400, 100, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0}, {{0, 0, 400, 48}}, {40, 1, 50, 40}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{1}, {{0, 48, 400, 100}}, {40, 50, 50, 95}}));
}

// Three cells by two, 100 in each; the right ones are 8 pixels wide. After the first cut [16,40)x[0,32) is
// square in cells, but upright in pixels.
TEST(Mahd, MeasuresCellsAtTheScreensEdgeInPixels) {
    const FramePlan plan = mahd({seen({0, 0, 40, 32}, 600)}, 40, 32, 4);
    EXPECT_EQ(plan.servers[0].tile, (Region{{0, 0, 16, 16}}));
    EXPECT_EQ(plan.servers[1].tile, (Region{{0, 16, 16, 32}}));
    EXPECT_EQ(plan.servers[2].tile, (Region{{16, 0, 40, 16}}));
    EXPECT_EQ(plan.servers[3], (ServerShare{{0}, {{16, 16, 40, 32}}, {16, 16, 40, 32}}));
}

TEST(Mahd, GivesARegionOfOneCellToTheLeft) {
    const FramePlan plan = mahd({seen({18, 18, 30, 30}, 9)}, 64, 64, 3);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0}, {{0, 0, 32, 64}}, {18, 18, 30, 30}}));
    EXPECT_TRUE(plan.servers[1].group.empty());
    EXPECT_TRUE(plan.servers[2].group.empty());
}

TEST(Mahd, LetsObjectsWithoutWorkDecideNothing) {
    const FramePlan plan =
        mahd({unseen(0, 7), seen({64, 0, 96, 16}, 5), seen({96, 0, 128, 16}, 5), unseen(255, 7)}, 256, 32, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1}, {{0, 0, 96, 32}}, {64, 0, 96, 16}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{2, 3}, {{96, 0, 256, 32}}, {96, 0, 128, 16}}));
}

// 2^31 triangles over 1,200 cells next to single ones: rounding loses no shares.
TEST(Mahd, WeighsTheLargestAndTheSmallestObjectsExactly) {
    std::vector<ProjectedObject> objects{seen({0, 0, 640, 480}, 1u << 31), seen({0, 0, 640, 480}, 1u << 31)};
    for (int x = 0; x < 640; x += 16) objects.push_back(seen({x, 0, x + 16, 480}, 1));
    EXPECT_EQ(mahd(objects, 640, 480, 2).servers[0].tile, (Region{{0, 0, 320, 480}}));
    objects.push_back(seen({320, 0, 640, 480}, 1u << 31));
    // In units of 2^31 triangles, c >= 20 of the 40 columns hold 2 c / 40 + (c - 20) / 20: half of 3 when c =
    // 25.
    EXPECT_EQ(mahd(objects, 640, 480, 2).servers[0].tile, (Region{{0, 0, 400, 480}}));
}

}  // namespace
}  // namespace swath
