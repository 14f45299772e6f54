// Simulated machines of known hardware: their frames teach the hardware's own rates, and a prediction from
// these rates agrees with the simulation.
#include <gtest/gtest.h>

#include "client/cost/frame_work.h"
#include "client/path/path.h"
#include "client/predict/prediction.h"
#include "common/scene/model.h"
#include "sim/cluster/simulated_cluster.h"
#include "sim/hardware/hardware.h"

namespace swath {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

const ObjectSet& knot() {
    static const ObjectSet model = build_objects(*load_model("builtin:knot:20000"), {4, 0});
    return model;
}

// The input and the result of each frame.
struct Run {
    Algorithm algorithm;
    std::vector<std::vector<ProjectedObject>> objects;
    std::vector<FramePlan> plans;
    std::vector<FrameTimeline> timelines;
};

// Adds the counters of servers, which simulated ones do not have.
Run simulated(const Hardware& hardware, Algorithm algorithm, std::size_t servers, std::uint64_t seed) {
    PathOptions options;
    options.frames = 6;
    options.seed = seed;
    const std::vector<Camera> cameras = *make_path("random", knot().bounds, options);
    Run run{algorithm, {}, {}, {}};
    run.timelines =
        sim::simulate({knot().objects, cameras, kWidth, kHeight, algorithm, servers, 3, hardware, true})
            .timelines;
    const auto partitioner = make_partitioner(algorithm, knot().objects);
    for (std::size_t f = 0; f < cameras.size(); ++f) {
        const View view = make_view(cameras[f], kWidth, kHeight);
        run.objects.push_back(project(knot().objects, view));
        run.plans.push_back(partitioner->partition({f, view, run.objects[f], servers}));
        const auto work = frame_work(run.plans[f], run.objects[f], hardware);
        const auto rounded = [](double count) { return static_cast<std::uint64_t>(std::llround(count)); };
        for (std::size_t s = 0; s < servers; ++s) {
            MachineTimeline& machine = run.timelines[f].machines[1 + s];
            for (const ObjectId id : run.plans[f].servers[s].group)
                machine[Counter::kTriangles] += run.objects[f][id].work;
            for (const SwathWork& swath : work[s].outgoing) {
                machine[Counter::kSwapPixels] += rounded(swath.pixels);
                machine[Counter::kSwapBytes] += rounded(swath.bytes);
                run.timelines[f].machines[1 + index(swath.peer)][Counter::kReceivedPixels] +=
                    rounded(swath.pixels);
            }
            machine[Counter::kTileBytes] = rounded(work[s].tile_bytes);
            machine[Counter::kTilePixels] =
                rounded(work[s].tile_bytes / hardware.network.tile_bytes_per_pixel);
        }
    }
    return run;
}

// gbe-2026 with values that profiles leave out, and without parts that are not learned apart.
Hardware known() {
    Hardware hardware = *sim::find_hardware("gbe-2026");
    hardware.server.polygon_s = 2e-6;
    hardware.server.frame_s = 3e-3;
    hardware.server.fill_pixels_per_s = 1e15;
    hardware.server.colour.latency_s = 20e-6;
    hardware.server.pack_pixels_per_s = 40e6;
    hardware.server.gather_pixels_per_s = 250e6;
    hardware.display.colour.latency_s = 0;
    return hardware;
}

void teach(Rates& rates, const Run& run) {
    for (std::size_t f = 0; f < run.plans.size(); ++f)
        rates.add(run.plans[f], run.timelines[f], run.algorithm, knot().objects.size());
}

double ms_of(const MachineTimeline& machine, Phase phase) {
    Nanoseconds sum{0};
    for (const Span& span : machine.spans)
        if (span.phase == phase) sum += span.end - span.begin;
    return std::chrono::duration<double, std::milli>(sum).count();
}

void expect_agree(const Run& run, const Hardware& hardware, double tolerance) {
    for (std::size_t f = 0; f < run.plans.size(); ++f) {
        const Prediction predicted =
            predict(run.plans[f], run.objects[f], run.algorithm, knot().objects, hardware);
        const auto& machines = run.timelines[f].machines;
        ASSERT_EQ(predicted.machines.size(), machines.size());
        EXPECT_DOUBLE_EQ(predicted.overlap, run.timelines[f].overlap_factor);
        for (std::size_t m = 0; m < machines.size(); ++m) {
            EXPECT_EQ(predicted.machines[m].name, machines[m].machine);
            for (std::size_t p = 0; p < kPhaseCount; ++p) {
                const auto phase = static_cast<Phase>(p);
                const double measured = ms_of(machines[m], phase);
                EXPECT_NEAR(predicted.machines[m][phase], measured, tolerance * measured + 1e-4)
                    << name_of(run.algorithm) << ", frame " << f << ", " << machines[m].machine << " "
                    << name_of(phase);
            }
        }
    }
}

TEST(RatesOfSimulatedMachines, AreThoseOfTheirHardware) {
    const Hardware truth = known();
    Rates rates;
    teach(rates, simulated(truth, Algorithm::kHybrid, 2, 1));
    teach(rates, simulated(truth, Algorithm::kHybrid, 6, 2));
    const auto learned = rates.hardware(Algorithm::kHybrid);
    ASSERT_TRUE(learned);
    const auto expect_close = [](double found, double wanted, const char* what) {
        EXPECT_NEAR(found / wanted, 1, 0.03) << what;
    };
    expect_close(learned->server.polygon_s, truth.server.polygon_s, "polygon");
    expect_close(learned->server.frame_s, truth.server.frame_s, "frame");
    expect_close(learned->server.colour.latency_s, truth.server.colour.latency_s, "latency of reading");
    expect_close(1 / learned->server.colour.read_pixels_per_s,
                 1 / truth.server.colour.read_pixels_per_s + 1 / truth.server.depth.read_pixels_per_s,
                 "reading");
    expect_close(learned->server.pack_pixels_per_s, truth.server.pack_pixels_per_s, "pack");
    expect_close(learned->server.merge_pixels_per_s, truth.server.merge_pixels_per_s, "merge");
    expect_close(learned->server.gather_pixels_per_s, truth.server.gather_pixels_per_s, "gather");
    expect_close(learned->display.colour.write_pixels_per_s, truth.display.colour.write_pixels_per_s,
                 "display");
    expect_close(learned->client.transform_s, truth.client.transform_s, "transform");
    expect_close(learned->client.partition_level_s, truth.client.partition_level_s, "level");
    expect_close(learned->network.swath_bytes_per_pixel, truth.network.swath_bytes_per_pixel, "swath bytes");
    expect_close(learned->network.tile_bytes_per_pixel, truth.network.tile_bytes_per_pixel, "tile bytes");
    expect_close(learned->network.active_share, truth.network.active_share, "share of swaths");
    expect_close(learned->network.tile_active_share, truth.network.tile_active_share, "share of tiles");
}

class Algorithms : public testing::TestWithParam<Algorithm> {};

TEST_P(Algorithms, ArePredictedAsTheyAreSimulated) {
    for (const char* profile : {"gbe-2026", "paper-2000"}) {
        Hardware hardware = *sim::find_hardware(profile);
        hardware.server.culls = true;
        expect_agree(simulated(hardware, GetParam(), 5, 3), hardware, 1e-6);
    }
}

// Predicts other cameras and another number of servers.
TEST_P(Algorithms, ArePredictedFromWhatTheHybridTaught) {
    Rates rates;
    teach(rates, simulated(known(), Algorithm::kHybrid, 2, 1));
    teach(rates, simulated(known(), Algorithm::kHybrid, 6, 2));
    expect_agree(simulated(known(), GetParam(), 4, 3), *rates.hardware(GetParam()), 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, Algorithms, testing::ValuesIn(kAll<Algorithm>.begin(), kAll<Algorithm>.end()));

}  // namespace
}  // namespace swath
