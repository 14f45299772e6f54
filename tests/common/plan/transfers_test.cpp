#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

#include "common/plan/frame_plan.h"

namespace swath {
namespace {

using PixelSet = std::set<std::pair<int, int>>;

// The pixels of a region; fails if two of its rectangles overlap.
PixelSet pixels_of(const Region& region) {
    PixelSet pixels;
    for (const Rect& r : region) {
        EXPECT_FALSE(r.empty());
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) EXPECT_TRUE(pixels.emplace(x, y).second);
    }
    return pixels;
}

FramePlan two_halves() {
    FramePlan plan;
    plan.view.width = 10;
    plan.view.height = 4;
    plan.servers.resize(2);
    plan.servers[0].tile = {{0, 0, 6, 4}};
    plan.servers[1].tile = {{6, 0, 10, 2}, {6, 2, 10, 4}};
    return plan;
}

TEST(Transfers, AreTheSwathWhereAContentLiesOnAnothersTile) {
    FramePlan plan = two_halves();
    plan.servers[0].content = {0, 1, 8, 4};
    plan.servers[1].content = {5, 0, 10, 1};
    EXPECT_EQ(transfers(plan),
              (std::vector<Transfer>{{server_id(0), server_id(1), {{6, 1, 8, 2}, {6, 2, 8, 4}}},
                                     {server_id(1), server_id(0), {{5, 0, 6, 1}}}}));
}

TEST(Transfers, LeaveOutPairsWithoutPixels) {
    FramePlan plan = two_halves();
    EXPECT_TRUE(transfers(plan).empty());
    plan.servers[0].content = {0, 0, 6, 4};  // its own tile, to the last pixel
    EXPECT_TRUE(transfers(plan).empty());
}

TEST(FinalRegion, IsOfEachTileRectangleWhatContentsTouch) {
    FramePlan plan = two_halves();
    plan.servers[0].content = {2, 1, 8, 2};
    plan.servers[1].content = {5, 0, 9, 1};
    EXPECT_EQ(final_region(plan, server_id(0)), (Region{{2, 0, 6, 2}}));
    EXPECT_EQ(final_region(plan, server_id(1)), (Region{{6, 0, 9, 2}}));
}

TEST(FinalRegion, OfAnEmptyPictureIsNothing) {
    EXPECT_TRUE(final_region(two_halves(), server_id(1)).empty());
}

// Small screens dealt out in stripes and blocks, random contents; every pixel is counted.
TEST(TransfersAndFinalRegions, AgreeWithEveryPixelOfRandomPlans) {
    std::mt19937 random(5);
    const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
    for (int round = 0; round < 400; ++round) {
        FramePlan plan;
        plan.view.width = 1 + below(23);
        plan.view.height = 1 + below(70);  // also more rows than bands of the index
        const std::size_t servers = 1 + random() % 6;
        plan.servers.resize(servers);
        const int edge_x = 1 + below(8);
        const int edge_y = 1 + below(8);
        for (int y = 0; y < plan.view.height; y += edge_y)
            for (int x = 0; x < plan.view.width; x += edge_x)
                plan.servers[random() % servers].tile.push_back(
                    intersect({x, y, x + edge_x, y + edge_y}, plan.view.viewport()));
        for (ServerShare& share : plan.servers)
            if (random() % 5 != 0) {
                const int x = below(plan.view.width);
                const int y = below(plan.view.height);
                share.content = {x, y, x + below(plan.view.width - x + 1),
                                 y + below(plan.view.height - y + 1)};
            }
        ASSERT_EQ(problem(plan, 0, Grouping::kExactlyOnce), std::nullopt);

        const std::vector<Transfer> all = transfers(plan);
        std::size_t next = 0;
        for (std::size_t from = 0; from < servers; ++from)
            for (std::size_t to = 0; to < servers; ++to) {
                PixelSet expected;
                const PixelSet tile = pixels_of(plan.servers[to].tile);
                const Rect& content = plan.servers[from].content;
                for (const auto& [x, y] : tile)
                    if (from != to && !intersect({x, y, x + 1, y + 1}, content).empty())
                        expected.emplace(x, y);
                PixelSet actual;
                if (next < all.size() && all[next].from == server_id(from) && all[next].to == server_id(to)) {
                    actual = pixels_of(all[next++].region);
                    ASSERT_FALSE(actual.empty());
                }
                ASSERT_EQ(actual, expected);
            }
        ASSERT_EQ(next, all.size());  // nothing else, and in order

        for (std::size_t s = 0; s < servers; ++s) {
            Region expected;
            for (const Rect& rect : plan.servers[s].tile) {
                Rect touched;
                for (int y = rect.y0; y < rect.y1; ++y)
                    for (int x = rect.x0; x < rect.x1; ++x)
                        for (const ServerShare& share : plan.servers)
                            if (!intersect({x, y, x + 1, y + 1}, share.content).empty())
                                touched = bounding(touched, {x, y, x + 1, y + 1});
                if (!touched.empty()) expected.push_back(touched);
            }
            ASSERT_EQ(final_region(plan, server_id(s)), expected);
        }
    }
}

}  // namespace
}  // namespace swath
