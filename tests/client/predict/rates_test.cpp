#include "client/predict/rates.h"

#include <gtest/gtest.h>

#include "client/cost/pricer.h"
#include "tests/common/timeline/sample.h"

namespace swath {
namespace {

// Two servers whose groups overlap by [18,22) x [2,8); the tiles meet at 20.
FramePlan plan() {
    FramePlan plan;
    plan.view.width = 40;
    plan.view.height = 10;
    plan.servers = {{{0}, {{0, 0, 20, 10}}, {4, 2, 22, 8}}, {{1}, {{20, 0, 40, 10}}, {18, 2, 36, 8}}};
    return plan;
}

// A frame of that plan on machines that draw 2 triangles a ms.
FrameTimeline timeline() {
    FrameTimeline timeline =
        frame(0, {machine("client", {span(Phase::kPartition, 0, 3)}),
                  machine("server 0", {span(Phase::kWait, 3, 4), span(Phase::kCull, 4, 5),
                                       span(Phase::kRender, 5, 104), span(Phase::kPixelRead, 104, 158),
                                       span(Phase::kSwap, 158, 164), span(Phase::kPixelWrite, 164, 173),
                                       span(Phase::kFinalRead, 173, 200), span(Phase::kSend, 200, 221)}),
                  machine("server 1", {span(Phase::kRender, 5, 105), span(Phase::kPixelRead, 105, 159),
                                       span(Phase::kSwap, 159, 165), span(Phase::kPixelWrite, 165, 174),
                                       span(Phase::kFinalRead, 174, 201), span(Phase::kSend, 201, 222)}),
                  machine("display", {span(Phase::kAssemble, 3, 4), span(Phase::kAssemble, 222, 317)})});
    for (std::size_t s = 1; s <= 2; ++s) {
        MachineTimeline& server = timeline.machines[s];
        server[Counter::kTriangles] = 200;
        server[Counter::kSwapPixels] = 3;  // of 12
        server[Counter::kSwapBytes] = 30;
        server[Counter::kReceivedPixels] = 3;
        server[Counter::kTilePixels] = 48;  // of 96
        server[Counter::kTileBytes] = 192;
    }
    return timeline;
}

Rates taught(Algorithm algorithm = Algorithm::kHybrid) {
    Rates rates;
    for (std::size_t i = 0; i < Rates::kEnoughFrames; ++i) rates.add(plan(), timeline(), algorithm, 10);
    return rates;
}

TEST(Rates, AreUnknownUntilThereWereEnoughFrames) {
    Rates rates;
    for (std::size_t i = 0; i < Rates::kEnoughFrames; ++i) {
        EXPECT_FALSE(rates.hardware(Algorithm::kHybrid));
        rates.add(plan(), timeline(), Algorithm::kHybrid, 10);
    }
    EXPECT_TRUE(rates.hardware(Algorithm::kHybrid));
}

TEST(Rates, AreTimeOverWorkByPhase) {
    const Hardware hardware = *taught().hardware(Algorithm::kHybrid);
    EXPECT_NEAR(hardware.server.polygon_s, 0.5e-3, 1e-9);
    EXPECT_EQ(hardware.server.frame_s, 0);
    EXPECT_NEAR(Pricer(hardware).readback_s({0, 0, 108, 1}), 54e-3, 1e-9);  // a content is 18 x 6
    EXPECT_NEAR(1 / hardware.server.pack_pixels_per_s, 2e-3, 1e-9);
    EXPECT_NEAR(1 / hardware.server.merge_pixels_per_s, 3e-3, 1e-9);
    EXPECT_NEAR(1 / hardware.server.gather_pixels_per_s, 1e-3, 1e-9);
    EXPECT_NEAR(1 / hardware.display.colour.write_pixels_per_s, 1e-3, 1e-9);
    EXPECT_NEAR(hardware.network.swath_bytes_per_pixel, 10, 1e-9);
    EXPECT_NEAR(hardware.network.tile_bytes_per_pixel, 4, 1e-9);
    EXPECT_NEAR(hardware.network.active_share, 0.25, 1e-9);
    EXPECT_NEAR(hardware.network.tile_active_share, 0.5, 1e-9);
    EXPECT_EQ(hardware.server.compositing, Compositing::kHost);
    // 3 ms for 10 objects and one level.
    EXPECT_NEAR(hardware.client.transform_s + hardware.client.partition_level_s, 0.3e-3, 1e-9);
}

TEST(Rates, AssumeOfSwathsWhatOnlySwathsCouldTeach) {
    Rates rates;
    FrameTimeline alone = timeline();
    for (std::size_t s = 1; s <= 2; ++s) {
        auto& server = alone.machines[s];
        std::erase_if(server.spans, [](const Span& of) {
            return of.phase == Phase::kSwap || of.phase == Phase::kPixelWrite;
        });
        server[Counter::kSwapPixels] = server[Counter::kSwapBytes] = server[Counter::kReceivedPixels] = 0;
    }
    FramePlan apart = plan();
    apart.servers[0].content = {4, 2, 20, 8};
    apart.servers[1].content = {20, 2, 36, 8};
    for (std::size_t i = 0; i < Rates::kEnoughFrames; ++i) rates.add(apart, alone, Algorithm::kMahd, 10);
    const Hardware hardware = *rates.hardware(Algorithm::kHybrid);
    EXPECT_LT(hardware.server.pack_pixels_per_s, hardware.server.gather_pixels_per_s);
    EXPECT_LT(hardware.server.merge_pixels_per_s, hardware.server.gather_pixels_per_s);
    EXPECT_GT(hardware.network.active_share, 0);
    EXPECT_NEAR(hardware.network.tile_active_share, 0.5, 1e-9);
}

TEST(Rates, HaveTheSharesOfActivePixelsOfEachAlgorithm) {
    Rates rates = taught();
    FrameTimeline dense = timeline();
    for (std::size_t s = 1; s <= 2; ++s) {
        dense.machines[s][Counter::kSwapPixels] = 9;
        dense.machines[s][Counter::kTilePixels] = 96;
    }
    for (std::size_t i = 0; i < 4; ++i) rates.add(plan(), dense, Algorithm::kSortLast, 10);
    EXPECT_NEAR(rates.hardware(Algorithm::kHybrid)->network.active_share, 0.25, 1e-9);
    EXPECT_NEAR(rates.hardware(Algorithm::kSortLast)->network.active_share, 0.75, 1e-9);
    EXPECT_NEAR(rates.hardware(Algorithm::kSortLast)->network.tile_active_share, 1, 1e-9);
}

TEST(Rates, LearnNothingFromAPictureOfNothing) {
    Rates rates = taught();
    FramePlan nothing = plan();
    for (ServerShare& share : nothing.servers) share.content = {};
    FrameTimeline idle = frame(0, {machine("client", {span(Phase::kPartition, 0, 999)}),
                                   machine("display", {span(Phase::kAssemble, 0, 999)})});
    for (int i = 0; i < 100; ++i) rates.add(nothing, idle, Algorithm::kHybrid, 10);
    const Hardware before = *taught().hardware(Algorithm::kHybrid);
    const Hardware after = *rates.hardware(Algorithm::kHybrid);
    EXPECT_EQ(after.server.polygon_s, before.server.polygon_s);
    EXPECT_EQ(after.client.transform_s, before.client.transform_s);
    EXPECT_EQ(after.display.colour.write_pixels_per_s, before.display.colour.write_pixels_per_s);
}

TEST(Rates, SurviveCountersThatCannotBe) {
    Rates rates;
    FrameTimeline wild = timeline();
    for (MachineTimeline& machine : wild.machines) machine.counters.fill(~std::uint64_t{0});
    for (int i = 0; i < 9; ++i) rates.add(plan(), wild, Algorithm::kHybrid, 10);
    for (MachineTimeline& machine : wild.machines) machine.counters.fill(0);
    for (int i = 0; i < 9; ++i) rates.add(plan(), wild, Algorithm::kHybrid, 10);
    const auto hardware = rates.hardware(Algorithm::kHybrid);
    ASSERT_TRUE(hardware);
    EXPECT_TRUE(hardware->server.polygon_s >= 0);
}

}  // namespace
}  // namespace swath
