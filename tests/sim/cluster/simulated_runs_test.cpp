// Properties of every run, whatever the scene.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "client/path/path.h"
#include "common/scene/model.h"
#include "sim/cluster/simulated_cluster.h"
#include "sim/hardware/hardware.h"
#include "tests/client/partition/scenes.h"
#include "tests/sim/cluster/machines.h"

namespace swath::sim {
namespace {

Hardware paper() { return *find_hardware("paper-2000"); }

Hardware on_host() {
    Hardware hardware = paper();
    hardware.server.compositing = Compositing::kHost;
    hardware.server.culls = true;
    hardware.server.pack_pixels_per_s = 50e6;
    hardware.server.merge_pixels_per_s = 30e6;
    hardware.network.active_share = 0.5;
    hardware.network.core_bytes_per_s = 300e6;
    return hardware;
}

// From the front, from within, and away from everything.
std::vector<Camera> unlike_cameras() {
    std::vector<Camera> cameras(3, test::front_camera());
    cameras[1].eye = {0.1f, 0, 0};
    cameras[1].target = {1, 0.5f, 0.2f};
    cameras[2].target = {0, 0, 90};
    return cameras;
}

const ObjectSet& knot() {
    static const ObjectSet model = build_objects(*load_model("builtin:knot:3000"), {3, 0});
    return model;
}

std::vector<Camera> path(std::size_t frames) {
    PathOptions options;
    options.frames = frames;
    return *make_path("random", knot().bounds, options);
}

ClusterScenario run_of(const std::vector<Camera>& cameras, Algorithm algorithm, std::size_t servers,
                       std::size_t in_flight, const Hardware& hardware) {
    return {knot().objects, cameras, 320, 240, algorithm, servers, in_flight, hardware, false};
}

void expect_sane(const ClusterRunCosts& costs) {
    for (const double time : {costs.frame_s, costs.latency_s, costs.single_s})
        EXPECT_TRUE(std::isfinite(time) && time >= 0) << time;
    for (const ResourceUse& use : costs.use)
        EXPECT_TRUE(use.share >= 0 && use.share <= 1 + 1e-9) << use.resource << " " << use.share;
}

// With compositing on the host a server composites on another thread than it draws.
std::string station_of(const std::string& machine, Phase phase, Compositing compositing) {
    const bool draws = phase == Phase::kRender || phase == Phase::kPixelRead;
    return is_server(machine) && compositing == Compositing::kHost ? machine + (draws ? " draws" : " merges")
                                                                   : machine;
}

void expect_one_job_at_a_time(const std::vector<FrameTimeline>& frames, Compositing compositing) {
    std::map<std::string, std::vector<std::pair<Nanoseconds, Nanoseconds>>> jobs;
    for (const FrameTimeline& frame : frames)
        for (const MachineTimeline& machine : frame.machines)
            for (const Span& span : machine.spans) {
                EXPECT_LE(span.begin, span.end);
                jobs[station_of(machine.machine, span.phase, compositing)].emplace_back(span.begin, span.end);
            }
    for (auto& [station, spans] : jobs) {
        std::ranges::sort(spans);
        for (std::size_t i = 1; i < spans.size(); ++i)
            ASSERT_LE(spans[i - 1].second, spans[i].first) << station << ", job " << i;
    }
}

// The end of the run's last job, in seconds.
double end_of(const std::vector<FrameTimeline>& frames) {
    Nanoseconds end{0};
    for (const FrameTimeline& frame : frames)
        for (const MachineTimeline& machine : frame.machines)
            for (const Span& span : machine.spans) end = std::max(end, span.end);
    return static_cast<double>(end.count()) * 1e-9;
}

class SimulatedRun : public testing::TestWithParam<std::tuple<Algorithm, std::size_t>> {};

// If a decision object complained, this would throw.
TEST_P(SimulatedRun, OfAwkwardScenesComesToItsEnd) {
    const auto [algorithm, servers] = GetParam();
    const auto cameras = unlike_cameras();
    for (const test::Scene& scene : test::awkward_scenes())
        for (const Hardware& hardware : {paper(), on_host()})
            for (const std::size_t in_flight : {1u, 2u, 3u}) {
                SCOPED_TRACE(fmt::format("{}, {} in flight", scene.name, in_flight));
                const auto costs = simulate(
                    {scene.objects, cameras, 160, 120, algorithm, servers, in_flight, hardware, true});
                expect_sane(costs);
                ASSERT_EQ(costs.timelines.size(), cameras.size());
                for (std::size_t i = 0; i < cameras.size(); ++i) {
                    EXPECT_EQ(costs.timelines[i].frame, i);
                    EXPECT_EQ(costs.timelines[i].machines.size(), servers + 2);
                }
                expect_one_job_at_a_time(costs.timelines, hardware.server.compositing);
            }
}

std::string case_name(const testing::TestParamInfo<std::tuple<Algorithm, std::size_t>>& info) {
    std::string name = fmt::format("{}On{}", name_of(std::get<0>(info.param)), std::get<1>(info.param));
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, SimulatedRun,
                         testing::Combine(testing::ValuesIn(kAll<Algorithm>.begin(), kAll<Algorithm>.end()),
                                          testing::Values(1u, 2u, 3u, 7u, 16u, 64u)),
                         case_name);

class EveryAlgorithm : public testing::TestWithParam<Algorithm> {};

TEST_P(EveryAlgorithm, GivesTheSameRunTwice) {
    const auto cameras = path(5);
    for (const Hardware& hardware : {paper(), on_host()}) {
        ClusterScenario scenario = run_of(cameras, GetParam(), 7, 3, hardware);
        scenario.keep_timelines = true;
        const auto first = simulate(scenario);
        const auto second = simulate(scenario);
        EXPECT_EQ(first.frame_s, second.frame_s);
        EXPECT_EQ(first.latency_s, second.latency_s);
        EXPECT_EQ(first.events, second.events);
        EXPECT_EQ(first.timelines, second.timelines);
        ASSERT_EQ(first.use.size(), second.use.size());
        for (std::size_t i = 0; i < first.use.size(); ++i) EXPECT_EQ(first.use[i].share, second.use[i].share);
        scenario.keep_timelines = false;
        const auto without = simulate(scenario);
        EXPECT_EQ(without.frame_s, first.frame_s) << "watching changes nothing";
        EXPECT_TRUE(without.timelines.empty());
    }
}

TEST_P(EveryAlgorithm, IsNeverFasterThanItsBusiestResource) {
    constexpr std::size_t kFrames = 40;
    const std::vector<Camera> cameras(kFrames, path(1)[0]);  // all frames are alike
    for (const Hardware& hardware : {paper(), on_host()})
        for (const std::size_t servers : {1u, 5u, 16u})
            for (const std::size_t in_flight : {1u, 3u}) {
                ClusterScenario scenario = run_of(cameras, GetParam(), servers, in_flight, hardware);
                scenario.keep_timelines = true;
                const auto costs = simulate(scenario);
                std::map<std::string, Nanoseconds> busy;
                for (const FrameTimeline& frame : costs.timelines)
                    for (const MachineTimeline& machine : frame.machines)
                        for (const Span& span : machine.spans)
                            busy[station_of(machine.machine, span.phase, hardware.server.compositing)] +=
                                span.end - span.begin;
                for (const auto& [station, time] : busy) {
                    const double frame_s = static_cast<double>(time.count()) * 1e-9 / kFrames;
                    // Work that was done ahead of the first picture that counts is missing.
                    EXPECT_GE(costs.frame_s, frame_s * 0.98)
                        << station << ", " << servers << " servers, " << in_flight << " in flight";
                }
            }
}

TEST_P(EveryAlgorithm, IsNotFasterOnASlowerNetwork) {
    const auto cameras = path(6);
    for (Hardware hardware : {paper(), on_host()})
        for (const std::size_t in_flight : {1u, 3u}) {
            double before = 0;
            for (const double rate : {1e12, 1e9, 1e8, 1e7, 1e6, 1e5}) {
                hardware.network.bytes_per_s = rate;
                ClusterScenario scenario = run_of(cameras, GetParam(), 7, in_flight, hardware);
                scenario.keep_timelines = true;
                const double now = end_of(simulate(scenario).timelines);
                EXPECT_GE(now, before * (1 - 1e-6)) << rate << " B/s, " << in_flight << " in flight";
                before = now;
            }
        }
}

TEST_P(EveryAlgorithm, TakesAtLeastTheIdealDrawingTime) {
    const auto cameras = path(8);
    Hardware hardware = paper();
    hardware.network.latency_s = 0;
    hardware.network.bytes_per_s = 1e15;
    hardware.client = {};
    hardware.display.colour = {0, 1e15, 1e15};
    for (const std::size_t servers : {1u, 2u, 8u, 16u}) {
        const double ideal_s = static_cast<double>(knot().mesh.triangle_count()) * hardware.server.polygon_s /
                               static_cast<double>(servers);
        for (const std::size_t in_flight : {1u, 3u})
            EXPECT_GE(simulate(run_of(cameras, GetParam(), servers, in_flight, hardware)).frame_s, ideal_s)
                << servers << " servers, " << in_flight << " in flight";
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryAlgorithm,
                         testing::ValuesIn(kAll<Algorithm>.begin(), kAll<Algorithm>.end()),
                         [](const auto& of) {
                             std::string name(name_of(of.param));
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace swath::sim
