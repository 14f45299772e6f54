#include "client/partition/kd_split.h"

#include <gtest/gtest.h>

#include "tests/client/partition/scenes.h"

namespace swath {
namespace {

using test::seen;
using test::unseen;

FramePlan kd_split(const std::vector<ProjectedObject>& objects, int width, int height, std::size_t servers) {
    return test::partition<KdSplit>(objects, width, height, servers);
}

// 0, 1 and 2 lie left of a cut in 36..39, and 1, 2 and 3 right of it. Of the four cuts, 39 is nearest to the
// middle of the region, [0,95).
TEST(KdSplit, CountsObjectsThatCrossTheCutOnBothSides) {
    const FramePlan plan = kd_split({seen({0, 5, 20, 45}, 10), seen({15, 0, 40, 50}, 10),
                                     seen({35, 0, 60, 50}, 10), seen({70, 9, 95, 11}, 10)},
                                    100, 50, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1, 2}, {{0, 0, 39, 50}}, {0, 0, 39, 50}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{1, 2, 3}, {{39, 0, 100, 50}}, {39, 0, 95, 50}}));
    EXPECT_TRUE(transfers(plan).empty());
}

TEST(KdSplit, GivesASideWorkInProportionToItsServers) {
    std::vector<ProjectedObject> columns;
    for (int x = 0; x < 120; x += 20) columns.push_back(seen({x, 0, x + 20, 40}, 10));
    const FramePlan plan = kd_split(columns, 120, 40, 3);
    for (int s = 0; s < 3; ++s) {
        const auto first = static_cast<ObjectId>(2 * s);
        EXPECT_EQ(
            plan.servers[static_cast<std::size_t>(s)],
            (ServerShare{{first, first + 1}, {{40 * s, 0, 40 * s + 40, 40}}, {40 * s, 0, 40 * s + 40, 40}}));
    }
}

// 30 are left of every cut but those up to 10, and 10 right of every cut but those below 20: 10 | 40 or 30 |
// 10.
TEST(KdSplit, TakesTheClosestWhenNoCutIsEqual) {
    const FramePlan plan =
        kd_split({seen({0, 0, 20, 9}, 10), seen({10, 0, 20, 9}, 20), seen({20, 0, 40, 9}, 10)}, 40, 9, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1}, {{0, 0, 19, 9}}, {0, 0, 19, 9}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{0, 1, 2}, {{19, 0, 40, 9}}, {19, 0, 40, 9}}));
}

TEST(KdSplit, TakesOfEqualCutsTheOneNearestToTheServersProportion) {
    // Any cut between the two is as close: takes the middle, or a third if one server of three is on the
    // left.
    const std::vector<ProjectedObject> far_apart{seen({0, 0, 9, 9}, 5), seen({81, 0, 90, 9}, 5)};
    EXPECT_EQ(kd_split(far_apart, 90, 9, 2).servers[0].tile, (Region{{0, 0, 45, 9}}));
    const FramePlan plan = kd_split({seen({0, 0, 90, 40}, 7)}, 90, 40, 3);
    for (int s = 0; s < 3; ++s)
        EXPECT_EQ(plan.servers[static_cast<std::size_t>(s)],
                  (ServerShare{{0}, {{30 * s, 0, 30 * s + 30, 40}}, {30 * s, 0, 30 * s + 30, 40}}));
    // Of the cuts from 10 to 20, 20 is nearest to 50.
    const std::vector<ProjectedObject> uneven{seen({0, 0, 10, 9}, 5), seen({20, 0, 100, 9}, 5)};
    EXPECT_EQ(kd_split(uneven, 100, 9, 2).servers[0].tile, (Region{{0, 0, 20, 9}}));
}

TEST(KdSplit, DecidesCutsInTheObjectsRegionButTilesTheWholeScreen) {
    const FramePlan plan = kd_split({seen({40, 0, 60, 50}, 1), seen({40, 50, 60, 100}, 1)}, 400, 100, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0}, {{0, 0, 400, 50}}, {40, 0, 60, 50}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{1}, {{0, 50, 400, 100}}, {40, 50, 60, 100}}));
}

TEST(KdSplit, HandsOutObjectsThatNobodySeesWithoutContent) {
    const FramePlan plan = kd_split(
        {unseen(0, 7), seen({10, 0, 50, 50}, 5), seen({50, 0, 90, 50}, 5), unseen(99, 7)}, 100, 50, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1}, {{0, 0, 50, 50}}, {10, 0, 50, 50}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{2, 3}, {{50, 0, 100, 50}}, {50, 0, 90, 50}}));
}

TEST(KdSplit, GivesARegionOfOnePixelToTheLeft) {
    const FramePlan plan = kd_split({seen({18, 18, 19, 19}, 9)}, 64, 64, 3);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0}, {{0, 0, 19, 64}}, {18, 18, 19, 19}}));
    EXPECT_TRUE(plan.servers[1].group.empty());
    EXPECT_TRUE(plan.servers[2].group.empty());
}

}  // namespace
}  // namespace swath
