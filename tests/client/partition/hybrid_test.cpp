#include "client/partition/hybrid.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/client/partition/scenes.h"

namespace swath {
namespace {

using test::seen;
using test::unseen;
using Group = std::vector<ObjectId>;

FramePlan hybrid(const std::vector<ProjectedObject>& objects, int width, int height, std::size_t servers) {
    return test::partition<Hybrid>(objects, width, height, servers);
}

// Figure 3 of the paper: left takes 0 (a tie), right takes 3, left takes 1 (a tie), right takes 2. The lines
// end at 40 and 35, the cut is half-way.
TEST(Hybrid, DividesTheScreenBetweenTwoServersAsInThePaper) {
    const FramePlan plan = hybrid({seen({0, 5, 20, 45}, 10), seen({15, 0, 40, 50}, 10),
                                   seen({35, 0, 60, 50}, 10), seen({70, 9, 95, 11}, 10)},
                                  100, 50, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1}, {{0, 0, 38, 50}}, {0, 0, 40, 50}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{2, 3}, {{38, 0, 100, 50}}, {35, 0, 95, 50}}));
    EXPECT_EQ(transfers(plan), (std::vector<Transfer>{{server_id(0), server_id(1), {{38, 0, 40, 50}}},
                                                      {server_id(1), server_id(0), {{35, 0, 38, 50}}}}));
}

// One server left, two right. Left takes 0 (30 triangles for one server); right takes 2 (15 a server) and 1
// (30 a server). The cut is (30 + 25) / 2, rounded up. The rest right of it is 72 by 80, so it is cut across
// y, at (40 + 35) / 2.
TEST(Hybrid, DividesTheScreenAmongThreeServersAlongTheLongerSideOfEachRegion) {
    const FramePlan plan = hybrid(
        {seen({0, 0, 30, 80}, 30), seen({25, 0, 100, 40}, 30), seen({25, 35, 100, 80}, 30)}, 100, 80, 3);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0}, {{0, 0, 28, 80}}, {0, 0, 30, 80}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{1}, {{28, 0, 100, 38}}, {25, 0, 100, 40}}));
    EXPECT_EQ(plan.servers[2], (ServerShare{{2}, {{28, 38, 100, 80}}, {25, 35, 100, 80}}));
}

TEST(Hybrid, GivesASideWorkInProportionToItsServers) {
    std::vector<ProjectedObject> columns;
    for (int x = 0; x < 120; x += 20) columns.push_back(seen({x, 0, x + 20, 40}, 10));
    const FramePlan plan = hybrid(columns, 120, 40, 3);
    for (int s = 0; s < 3; ++s) {
        const auto first = static_cast<ObjectId>(2 * s);
        EXPECT_EQ(
            plan.servers[static_cast<std::size_t>(s)],
            (ServerShare{{first, first + 1}, {{40 * s, 0, 40 * s + 40, 40}}, {40 * s, 0, 40 * s + 40, 40}}));
    }
    EXPECT_TRUE(transfers(plan).empty());
}

TEST(Hybrid, DecidesCutsInTheObjectsRegionButTilesTheWholeScreen) {
    // The objects' region [40,60)x[0,100) is upright on a wide screen: the cut is across y.
    const FramePlan plan = hybrid({seen({40, 0, 60, 50}, 1), seen({40, 50, 60, 100}, 1)}, 400, 100, 2);
    EXPECT_EQ(plan.servers[0].tile, (Region{{0, 0, 400, 50}}));
    EXPECT_EQ(plan.servers[1].tile, (Region{{0, 50, 400, 100}}));
}

TEST(Hybrid, HandsOutObjectsThatNobodySeesWithoutContent) {
    const FramePlan plan =
        hybrid({unseen(0, 7), seen({10, 0, 50, 50}, 5), seen({50, 0, 90, 50}, 5), unseen(99, 7)}, 100, 50, 2);
    EXPECT_EQ(plan.servers[0], (ServerShare{{0, 1}, {{0, 0, 50, 50}}, {10, 0, 50, 50}}));
    EXPECT_EQ(plan.servers[1], (ServerShare{{2, 3}, {{50, 0, 100, 50}}, {50, 0, 90, 50}}));
}

TEST(Hybrid, GivesObjectsAtTheSamePlaceToEachServerAsARunOfIds) {
    const std::vector<ProjectedObject> stack(12, seen({10, 10, 20, 20}, 1));
    const FramePlan plan = hybrid(stack, 100, 100, 4);
    for (std::size_t s = 0; s < 4; ++s) {
        Group run(3);
        std::iota(run.begin(), run.end(), static_cast<ObjectId>(3 * s));
        EXPECT_EQ(plan.servers[s].group, run);
    }
}

// Counting (many objects on few pixels) and comparing (few on many) must give the same order: tries a scene
// of 4 objects, and the same with each object 100 times and a hundredth as heavy.
TEST(Hybrid, CutsTheSameWhetherObjectsAreFewOrMany) {
    const std::vector<ProjectedObject> few{seen({0, 0, 300, 90}, 100), seen({250, 0, 500, 90}, 100),
                                           seen({480, 0, 700, 90}, 100), seen({650, 0, 990, 90}, 100)};
    std::vector<ProjectedObject> many;
    for (const ProjectedObject& object : few) many.insert(many.end(), 100, seen(object.box, 1));
    const FramePlan of_few = hybrid(few, 1000, 100, 4);
    const FramePlan of_many = hybrid(many, 1000, 100, 4);
    for (std::size_t s = 0; s < 4; ++s) {
        EXPECT_EQ(of_few.servers[s].tile, of_many.servers[s].tile);
        EXPECT_EQ(of_few.servers[s].content, of_many.servers[s].content);
    }
}

// Section 6 of the paper: servers exchange less if objects are smaller.
TEST(Hybrid, ExchangesNarrowSwaths) {
    const auto grid_of = [](int step) {
        std::vector<ProjectedObject> grid;
        for (int y = 0; y < 960; y += step)
            for (int x = 0; x < 1280; x += step)
                grid.push_back(
                    seen(intersect({x - step / 4, y - step / 4, x + step, y + step}, {0, 0, 1280, 960}), 1));
        return grid;
    };
    const auto exchanged = [](const FramePlan& plan) {
        std::int64_t pixels = 0;
        for (const Transfer& transfer : transfers(plan)) pixels += area(transfer.region);
        return static_cast<double>(pixels) / static_cast<double>(plan.view.viewport().area());
    };
    const double coarse = exchanged(hybrid(grid_of(40), 1280, 960, 16));
    const double fine = exchanged(hybrid(grid_of(10), 1280, 960, 16));
    EXPECT_LT(coarse, 0.25);
    EXPECT_LT(fine, 0.5 * coarse);
}

// Section 6 of the paper in numbers. Its equations are lost in our copy of the text; this derives them again.
// M equal squares of edge B lie evenly on P pixels, N servers have square tiles of edge s = sqrt(P/N). A
// swath is as wide as a box, B, and we cut in its middle, so a server's group reaches B/2 beyond its tile:
// four rectangles of B/2 by s along the sides and four corner squares of edge B/2, that is
//     4 s B/2 + 4 (B/2)^2 = 2 B sqrt(P/N) + B^2 pixels
// that one server sends in a frame. This leaves out that nothing is sent at the border of the screen, so only
// servers whose tiles do not touch it count.
TEST(Hybrid, SendsAsManyPixelsAsThePaperSaysOnAverage) {
    constexpr int kEdge = 1024;
    std::mt19937 random(6);
    for (const int box : {8, 16, 24})
        for (const int root : {4, 8, 16}) {
            std::vector<ProjectedObject> squares;
            for (int i = 0; i < 60'000; ++i) {
                const auto places = static_cast<unsigned>(kEdge - box + 1);
                const auto at = [&] { return static_cast<int>(random() % places); };
                const int x = at();
                const int y = at();
                squares.push_back(seen({x, y, x + box, y + box}, 1));
            }
            const FramePlan plan = hybrid(squares, kEdge, kEdge,
                                          static_cast<std::size_t>(root) * static_cast<std::size_t>(root));
            const auto within = [&](std::size_t server) {
                const Rect& tile = plan.servers[server].tile.front();
                return tile.x0 > 0 && tile.y0 > 0 && tile.x1 < kEdge && tile.y1 < kEdge;
            };
            int servers = 0;
            std::int64_t pixels = 0;
            for (std::size_t s = 0; s < plan.servers.size(); ++s) servers += within(s) ? 1 : 0;
            for (const Transfer& transfer : transfers(plan))
                if (within(index(transfer.from))) pixels += area(transfer.region);
            ASSERT_EQ(servers, (root - 2) * (root - 2));
            const double expected = 2.0 * box * kEdge / root + box * box;
            EXPECT_NEAR(static_cast<double>(pixels) / servers, expected, 0.1 * expected)
                << box << " pixels, " << root * root << " servers";
        }
}

}  // namespace
}  // namespace swath
