#include "client/cost/frame_work.h"

#include <gtest/gtest.h>

#include "client/cost/pricer.h"

namespace swath {
namespace {

Hardware some_hardware() {
    Hardware hardware;
    hardware.server.compositing = Compositing::kHost;
    hardware.server.polygon_s = 1;
    hardware.server.fill_pixels_per_s = 1e9;
    hardware.server.colour = {1, 10, 10};
    hardware.server.depth = {1, 10, 10};
    hardware.server.pack_pixels_per_s = 10;
    hardware.server.merge_pixels_per_s = 5;
    hardware.display.colour = {1, 10, 10};
    hardware.network.active_share = 0.5;
    hardware.network.swath_bytes_per_pixel = 8;
    hardware.network.tile_bytes_per_pixel = 4;
    return hardware;
}

FramePlan plan_of(std::vector<ServerShare> servers) {
    FramePlan plan;
    plan.view.width = 40;
    plan.view.height = 10;
    plan.servers = std::move(servers);
    return plan;
}

// Two servers whose groups overlap by [18,22) x [2,8); the tiles meet at 20.
TEST(FrameWork, IsWhatThePlanMakesEachServerDrawSendAndMerge) {
    const std::vector<ProjectedObject> objects{{{4, 2, 22, 8}, 7, true}, {{18, 2, 36, 8}, 5, true}};
    const FramePlan plan =
        plan_of({{{0}, {{0, 0, 20, 10}}, objects[0].box}, {{1}, {{20, 0, 40, 10}}, objects[1].box}});
    const Hardware hardware = some_hardware();
    const Pricer price(hardware);
    const auto work = frame_work(plan, objects, hardware);
    ASSERT_EQ(work.size(), 2u);
    EXPECT_EQ(work[0].render_s, 7);
    EXPECT_EQ(work[1].render_s, 5);
    EXPECT_EQ(work[0].read_s, price.readback_s(objects[0].box));
    ASSERT_EQ(work[0].outgoing.size(), 1u);
    EXPECT_EQ(work[0].outgoing[0].peer, server_id(1));
    const Region swath{{20, 2, 22, 8}};
    EXPECT_EQ(work[0].outgoing[0].send_s, price.send_swath_s(swath));
    EXPECT_EQ(work[0].outgoing[0].merge_s, price.merge_swath_s(swath));
    EXPECT_EQ(work[0].outgoing[0].pixels, 6);
    EXPECT_EQ(work[0].outgoing[0].bytes, 8 * 6);
    EXPECT_EQ(work[0].incoming, std::vector{server_id(1)});
    const Region tile{{4, 2, 20, 8}};
    EXPECT_TRUE(work[0].has_tile);
    EXPECT_EQ(work[0].final_s, price.read_tile_s(tile));
    EXPECT_EQ(work[0].display_s, price.display_tile_s(tile));
    EXPECT_EQ(work[0].tile_bytes, price.tile_bytes(tile));
    EXPECT_TRUE(work[0].takes_part);
}

TEST(FrameWork, LeavesAServerOutForWhichThereIsNothing) {
    const std::vector<ProjectedObject> objects{{{4, 2, 16, 8}, 7, true}};
    const FramePlan plan = plan_of({{{0}, {{0, 0, 20, 10}}, objects[0].box}, {{}, {{20, 0, 40, 10}}, {}}});
    const auto work = frame_work(plan, objects, some_hardware());
    EXPECT_TRUE(work[0].takes_part);
    EXPECT_FALSE(work[1].takes_part);
    EXPECT_FALSE(work[1].has_tile);
}

TEST(OverlapFactor, IsHowManyServersDrawATriangle) {
    std::vector<Object> model(2);
    model[0].triangle_count = 30;
    model[1].triangle_count = 10;
    EXPECT_EQ(overlap_factor(plan_of({{{0}, {}, {}}, {{1}, {}, {}}}), model), 1);
    EXPECT_EQ(overlap_factor(plan_of({{{0, 1}, {}, {}}, {{0}, {}, {}}}), model), 1.75);
    EXPECT_EQ(overlap_factor(plan_of({{{}, {}, {}}}), {}), 1);
}

}  // namespace
}  // namespace swath
