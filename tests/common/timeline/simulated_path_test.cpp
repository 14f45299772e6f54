// The critical path of simulated machines is known: with one frame at a time and a network that takes no
// time, some machine on it works at every moment.
#include <gtest/gtest.h>

#include "client/path/path.h"
#include "common/scene/model.h"
#include "common/timeline/critical_path.h"
#include "sim/cluster/simulated_cluster.h"
#include "sim/hardware/hardware.h"

namespace swath {
namespace {

std::vector<FrameTimeline> simulated(Hardware hardware, Algorithm algorithm) {
    hardware.network.latency_s = 0;
    hardware.network.bytes_per_s = 1e15;
    const ObjectSet scene = build_objects(*load_model("builtin:knot:3000"), {3, 0});
    PathOptions options;
    options.frames = 4;
    const std::vector<Camera> cameras = *make_path("random", scene.bounds, options);
    return sim::simulate({scene.objects, cameras, 320, 240, algorithm, /*servers=*/5, /*frames_in_flight=*/1,
                          hardware, true})
        .timelines;
}

class SimulatedCriticalPath : public testing::TestWithParam<std::tuple<const char*, Algorithm>> {};

TEST_P(SimulatedCriticalPath, AccountsForEveryMomentOfAFrame) {
    const auto& [profile, algorithm] = GetParam();
    const auto frames = simulated(*sim::find_hardware(profile), algorithm);
    ASSERT_EQ(frames.size(), 4u);
    for (const FrameTimeline& frame : frames) {
        const auto path = critical_path(frame, Nanoseconds(0));
        ASSERT_GE(path.size(), 4u);
        EXPECT_EQ(path.front().phase, Phase::kPartition);
        EXPECT_EQ(path[1].phase, Phase::kRender);
        EXPECT_EQ(path.back().phase, Phase::kAssemble);
        EXPECT_EQ(path.back().end, frame.machines.back().spans.back().end);
        // Messages still take a nanosecond or two.
        for (std::size_t i = 1; i < path.size(); ++i) {
            EXPECT_GE(path[i].begin, path[i - 1].end);
            EXPECT_LE(path[i].begin - path[i - 1].end, Nanoseconds(100))
                << frame.frame << ": before " << path[i].machine << " " << name_of(path[i].phase);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, SimulatedCriticalPath,
                         testing::Combine(testing::Values("paper-2000", "gbe-2026"),
                                          testing::Values(Algorithm::kHybrid, Algorithm::kMahd,
                                                          Algorithm::kSortLast)));

}  // namespace
}  // namespace swath
