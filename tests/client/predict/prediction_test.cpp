#include "client/predict/prediction.h"

#include <gtest/gtest.h>

#include "tests/client/partition/scenes.h"
#include "tests/common/timeline/sample.h"

namespace swath {
namespace {

Hardware slow() {
    Hardware hardware;
    hardware.server.compositing = Compositing::kHost;
    hardware.server.polygon_s = 1;
    hardware.server.fill_pixels_per_s = 1e9;
    hardware.server.colour = {100, 1, 0};
    hardware.server.depth = {0, 1e12, 0};
    hardware.server.pack_pixels_per_s = 0.1;
    hardware.server.merge_pixels_per_s = 0.05;
    hardware.server.gather_pixels_per_s = 4;
    hardware.display.colour = {0, 0, 0.5};
    hardware.network.active_share = 0.5;
    hardware.network.tile_active_share = 0.25;
    hardware.client = {2, 0, 1};
    return hardware;
}

// Two servers whose groups overlap by [18,22) x [2,8); the tiles meet at 20.
struct Overlapping {
    std::vector<ProjectedObject> objects{{{4, 2, 22, 8}, 7, true}, {{18, 2, 36, 8}, 5, true}};
    std::vector<Object> model{test::cube({-1, 0, 0}, 1, 7), test::cube({1, 0, 0}, 1, 5)};
    FramePlan plan;
    Overlapping() {
        plan.view.width = 40;
        plan.view.height = 10;
        plan.servers = {{{0}, {{0, 0, 20, 10}}, objects[0].box}, {{1}, {{20, 0, 40, 10}}, objects[1].box}};
    }
    Prediction on(const Hardware& hardware) const {
        return predict(plan, objects, Algorithm::kHybrid, model, hardware);
    }
};

TEST(Prediction, HasEveryMachinesPhases) {
    const Prediction found = Overlapping().on(slow());
    ASSERT_EQ(found.machines.size(), 4u);
    EXPECT_EQ(found.machines[0].name, "client");
    EXPECT_DOUBLE_EQ(found.machines[0][Phase::kPartition], 1e3 * 2 * (2 + 1));
    EXPECT_EQ(found.machines[1].name, "server 0");
    EXPECT_DOUBLE_EQ(found.machines[1][Phase::kRender], 7e3);
    EXPECT_DOUBLE_EQ(found.machines[2][Phase::kRender], 5e3);
    for (const std::size_t s : {1u, 2u}) {
        const MachinePrediction& server = found.machines[s];
        EXPECT_NEAR(server[Phase::kPixelRead], 1e3 * (100 + 18 * 6), 1e-3);
        EXPECT_DOUBLE_EQ(server[Phase::kSwap], 1e3 * 10 * 0.5 * 12);
        EXPECT_DOUBLE_EQ(server[Phase::kPixelWrite], 1e3 * 20 * 0.5 * 12);
        EXPECT_DOUBLE_EQ(server[Phase::kFinalRead], 1e3 * 0.25 * 16 * 6 / 4);
    }
    EXPECT_EQ(found.machines[3].name, "display");
    EXPECT_DOUBLE_EQ(found.machines[3][Phase::kAssemble], 1e3 * 2 * 0.25 * 2 * 16 * 6);
    EXPECT_DOUBLE_EQ(found.swap_pixels, 0.5 * 24);
    EXPECT_DOUBLE_EQ(found.overlap, 1);
}

TEST(Prediction, OfAFrameIsTheLongestMachine) {
    Hardware hardware = slow();
    const Prediction servers = Overlapping().on(hardware);
    EXPECT_DOUBLE_EQ(servers.frame_ms, servers.machines[1].sum_ms());
    hardware.display.colour.write_pixels_per_s = 1e-3;
    const Prediction display = Overlapping().on(hardware);
    EXPECT_DOUBLE_EQ(display.frame_ms, display.machines[3].sum_ms());
}

TEST(Prediction, OfGraphicsCardsReadsSwathsFromThem) {
    Hardware hardware = slow();
    hardware.server.compositing = Compositing::kGraphics;
    hardware.server.colour = {100, 1, 0.5};
    hardware.server.depth = {100, 1, 0.5};
    const Prediction found = Overlapping().on(hardware);
    EXPECT_DOUBLE_EQ(found.machines[1][Phase::kPixelRead], 1e3 * 2 * (100 + 12));
    EXPECT_EQ(found.machines[1][Phase::kSwap], 0);
}

// Four quarters of the screen, each with work, and one object in the middle on all of them.
struct Quarters {
    std::vector<Object> model{test::cube({-0.6f, -0.4f, 0}, 0.2f, 100),
                              test::cube({0.6f, -0.4f, 0}, 0.2f, 100),
                              test::cube({-0.6f, 0.4f, 0}, 0.2f, 100), test::cube({0.6f, 0.4f, 0}, 0.2f, 100),
                              test::cube({0, 0, 0}, 0.5f, 40)};
    View view = test::front_view();
    std::vector<ProjectedObject> objects = project(model, view);
    std::vector<std::unique_ptr<Partitioner>> partitioners;
    std::vector<Contender> contenders;
    Quarters() {
        for (const Algorithm algorithm : kAll<Algorithm>) {
            partitioners.push_back(make_partitioner(algorithm, model));
            contenders.push_back({algorithm, partitioners.back().get()});
        }
    }
    std::vector<Comparison> compared(const Rates& rates, std::size_t servers) const {
        return compare(test::input_of(objects, view, servers), model, contenders, rates);
    }
};

// The rates of machines that take a ms a triangle and almost nothing else.
Rates drawing_rates() {
    FramePlan plan;
    plan.view = test::front_view();
    plan.servers = {{{0}, {plan.view.viewport()}, plan.view.viewport()}};
    FrameTimeline timeline = frame(
        0,
        {machine("client", {}), machine("server 0", {span(Phase::kRender, 0, 100)}), machine("display", {})});
    timeline.machines[1].spans.push_back(
        {Phase::kFinalRead, ms(100), ms(100) + Nanoseconds(1), Nanoseconds(1)});
    timeline.machines[1][Counter::kTriangles] = 100;
    timeline.machines[1][Counter::kTilePixels] = 1000;
    Rates rates;
    for (std::size_t i = 0; i < Rates::kEnoughFrames; ++i) rates.add(plan, timeline, Algorithm::kHybrid, 5);
    return rates;
}

TEST(Compare, SaysNothingWhileRatesAreUnknown) { EXPECT_TRUE(Quarters().compared(Rates(), 4).empty()); }

TEST(Compare, PredictsEveryAlgorithmForTheSameView) {
    const auto found = Quarters().compared(drawing_rates(), 4);
    ASSERT_EQ(found.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const Prediction& of = found[i].prediction;
        EXPECT_EQ(found[i].algorithm, kAll<Algorithm>[i]);
        if (grouping_of(found[i].algorithm) == Grouping::kExactlyOnce) {
            EXPECT_EQ(of.overlap, 1);
            EXPECT_GT(of.swap_pixels, 0);
            EXPECT_NEAR(of.frame_ms, 140, 1);
        } else {
            EXPECT_EQ(of.overlap, (400 + 4 * 40) / 440.0);
            EXPECT_EQ(of.swap_pixels, 0);
            EXPECT_NEAR(of.frame_ms, 140, 1);
        }
    }
}

TEST(Compare, IsForAsManyServersAsAskedFor) {
    const Quarters scene;
    const Rates rates = drawing_rates();
    for (const std::size_t servers : {1u, 2u, 3u})
        for (const Comparison& each : scene.compared(rates, servers))
            EXPECT_EQ(each.prediction.machines.size(), servers + 2);
    EXPECT_NEAR(scene.compared(rates, 1)[0].prediction.frame_ms, 440, 1);
}

}  // namespace
}  // namespace swath
