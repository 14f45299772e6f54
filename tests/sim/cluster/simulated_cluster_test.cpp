// Times that can be worked out by hand.
#include "sim/cluster/simulated_cluster.h"

#include <gtest/gtest.h>

#include "client/cost/frame_work.h"
#include "tests/client/partition/scenes.h"
#include "tests/sim/cluster/machines.h"

namespace swath::sim {
namespace {

using test::cube;
using test::free_hardware;
using test::front_camera;
using test::kNothing;

constexpr int kWidth = 320;
constexpr int kHeight = 240;

ClusterScenario scenario_of(const std::vector<Object>& objects, const std::vector<Camera>& cameras,
                            const Hardware& hardware, std::size_t servers, std::size_t in_flight,
                            Algorithm algorithm = Algorithm::kHybrid) {
    return {objects, cameras, kWidth, kHeight, algorithm, servers, in_flight, hardware, false};
}

// The number of pixels of a single object's box.
double pixels_of(const Object& object) {
    const View view = make_view(front_camera(), kWidth, kHeight);
    return static_cast<double>(project(std::vector{object}, view, Accounting::kCluster)[0].box.area());
}

TEST(SimulatedCluster, OfOneServerTakesAFramesDrawingAndItsTile) {
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(6, front_camera());
    Hardware hardware = free_hardware();
    hardware.server.polygon_s = 1e-3;
    hardware.server.colour = {2e-3, 1e6, 1e6};
    const double frame_s = 50e-3 + 2e-3 + pixels_of(objects[0]) / 1e6;
    for (const std::size_t in_flight : {1u, 2u, 3u}) {
        const auto costs = simulate(scenario_of(objects, cameras, hardware, 1, in_flight));
        EXPECT_NEAR(costs.frame_s, frame_s, kNothing) << in_flight;
        EXPECT_NEAR(costs.single_s, 50e-3, 1e-12);
        // The frames before it are drawn first.
        const auto n = static_cast<double>(in_flight);
        EXPECT_NEAR(costs.latency_s, frame_s * (n - n * (n - 1) / 2 / 6), kNothing) << in_flight;
        EXPECT_EQ(busiest(costs.use).resource, "server graphics");
        EXPECT_NEAR(busiest(costs.use).share, 1, 1e-3);
    }
}

TEST(SimulatedCluster, AddsUpEveryStageOfAFrameThatIsAlone) {
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(4, front_camera());
    const double pixels = pixels_of(objects[0]);
    Hardware hardware = free_hardware();
    hardware.server.polygon_s = 1e-3;
    hardware.client.transform_s = 5e-3;
    hardware.network.latency_s = 7e-3;
    hardware.network.bytes_per_s = 1e6;
    hardware.network.tile_bytes_per_pixel = 4;
    hardware.display.colour = {11e-3, 1e6, 2e6};
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 1, 1));
    // The server's task (304 bytes) shares the client's link with the display's, and the tile shares the
    // server's link with the report (300 bytes): each takes half of it while both flow.
    const double latency_s =
        5e-3 + (2 * 304e-6 + 7e-3) + 50e-3 + (4 * pixels / 1e6 + 300e-6 + 7e-3) + (11e-3 + pixels / 2e6);
    EXPECT_NEAR(costs.latency_s, latency_s, kNothing);
    // The next frame begins with the display's report.
    EXPECT_NEAR(costs.frame_s, latency_s + 300e-6 + 7e-3, kNothing);
}

TEST(SimulatedCluster, LetsServersOfHostCompositingDrawWhileTheyMerge) {
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(8, front_camera());
    const double pixels = pixels_of(objects[0]);
    Hardware hardware = free_hardware();
    hardware.server.compositing = Compositing::kHost;
    hardware.server.polygon_s = 0.8e-3;                         // draws for 40 ms,
    hardware.server.colour.read_pixels_per_s = pixels / 10e-3;  // reads for 10 ms
    hardware.server.pack_pixels_per_s = pixels / 20e-3;         // and gathers for 20 ms
    EXPECT_NEAR(simulate(scenario_of(objects, cameras, hardware, 1, 1)).frame_s, 70e-3, kNothing);
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 1, 2));
    EXPECT_NEAR(costs.frame_s, 50e-3, kNothing);
    // The first two take 70 and 120 ms; the others begin 100 ms before their picture, with the picture of the
    // last but one.
    EXPECT_NEAR(costs.latency_s, (70e-3 + 120e-3 + 6 * 100e-3) / 8, kNothing);
    hardware.server.compositing = Compositing::kGraphics;
    EXPECT_NEAR(simulate(scenario_of(objects, cameras, hardware, 1, 2)).frame_s, 50e-3, kNothing);
    hardware.server.colour.latency_s = 20e-3;
    EXPECT_NEAR(simulate(scenario_of(objects, cameras, hardware, 1, 2)).frame_s, 70e-3, kNothing);
}

TEST(SimulatedCluster, LetsEachServerWaitForTheOthersSwath) {
    // Two objects that overlap on the screen; the second has more to draw.
    const std::vector<Object> objects{cube({-0.2f, 0, 0}, 0.3f, 30), cube({0.2f, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(3, front_camera());
    Hardware hardware = free_hardware();
    hardware.server.polygon_s = 1e-3;
    hardware.server.colour = {1e-3, 1e7, 1e6};
    hardware.server.depth = {3e-3, 1e7, 1e6};
    const View view = make_view(cameras[0], kWidth, kHeight);
    const auto projected = project(objects, view, Accounting::kCluster);
    const FramePlan plan = make_partitioner(Algorithm::kHybrid, objects)->partition({0, view, projected, 2});
    const auto work = frame_work(plan, projected, hardware);
    ASSERT_EQ(work[0].outgoing.size(), 1u);
    ASSERT_EQ(work[1].outgoing.size(), 1u);
    ASSERT_GT(work[0].outgoing[0].merge_s, 4e-3);

    // A server composites when it has sent its own swath and the other's has come.
    const double sent[] = {work[0].render_s + work[0].outgoing[0].send_s,
                           work[1].render_s + work[1].outgoing[0].send_s};
    const double both = std::max(sent[0], sent[1]);
    const double frame_s = both + std::max(work[1].outgoing[0].merge_s + work[0].final_s,
                                           work[0].outgoing[0].merge_s + work[1].final_s);
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 2, 1));
    EXPECT_NEAR(costs.frame_s, frame_s, kNothing);
    EXPECT_NEAR(costs.latency_s, frame_s, kNothing);
    EXPECT_NEAR(costs.single_s, 80e-3, 1e-12);
}

TEST(SimulatedCluster, IsLimitedByTheDisplayWhereThatIsSlowest) {
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(5, front_camera());
    Hardware hardware = free_hardware();
    hardware.display.colour = {30e-3, 1e15, 1e15};
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 1, 3));
    EXPECT_NEAR(costs.frame_s, 30e-3, kNothing);
    EXPECT_EQ(busiest(costs.use).resource, "display");
}

// Three frames begin together, their pictures come in a burst, and then all wait for the network.
TEST(SimulatedCluster, FramesTakeTheSameHoweverManyThereAre) {
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    Hardware hardware = free_hardware();
    hardware.network.latency_s = 10e-3;
    hardware.display.colour.latency_s = 2e-3;
    constexpr double kRound = 3 * 10e-3 + 2e-3;  // the task, the tile, the picture, the report
    for (const std::size_t frames : {4u, 5u, 6u, 7u, 8u, 50u}) {
        const std::vector<Camera> cameras(frames, front_camera());
        EXPECT_NEAR(simulate(scenario_of(objects, cameras, hardware, 1, 3)).frame_s, kRound / 3, kNothing)
            << frames;
    }
    for (const std::size_t frames : {1u, 2u, 3u}) {
        const std::vector<Camera> cameras(frames, front_camera());
        const auto n = static_cast<double>(frames);
        EXPECT_NEAR(simulate(scenario_of(objects, cameras, hardware, 1, 3)).frame_s, (20e-3 + n * 2e-3) / n,
                    kNothing)
            << frames;
    }
}

TEST(SimulatedCluster, SharesTheClientsLinkAmongItsServers) {
    std::vector<Object> objects;
    for (int i = 0; i < 16; ++i)
        objects.push_back(cube(
            {static_cast<float>(i % 4) * 0.4f - 0.6f, static_cast<float>(i / 4) * 0.4f - 0.6f, 0}, 0.1f, 50));
    const std::vector<Camera> cameras(10, front_camera());
    Hardware hardware = free_hardware();
    hardware.network.bytes_per_s = 1e6;
    hardware.network.swath_bytes_per_pixel = hardware.network.tile_bytes_per_pixel = 1e-9;
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 16, 3));
    EXPECT_EQ(busiest(costs.use).resource, "client network");
    EXPECT_GT(busiest(costs.use).share, 0.8);
}

TEST(SimulatedCluster, ComparesWithAServerThatAlsoFillsPixels) {
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(2, front_camera());
    Hardware hardware = free_hardware();
    hardware.server.polygon_s = 1e-6;
    hardware.server.fill_pixels_per_s = 1e6;
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 1, 1));
    EXPECT_NEAR(costs.single_s, pixels_of(objects[0]) / 1e6, 1e-12);
    EXPECT_NEAR(costs.frame_s, costs.single_s, kNothing);
}

TEST(SimulatedCluster, ShowsBackgroundWhereNothingIsVisible) {
    const std::vector<Object> objects{cube({0, 0, 50}, 0.3f, 50)};  // behind the camera
    const std::vector<Camera> cameras(5, front_camera());
    Hardware hardware = free_hardware();
    hardware.server.culls = true;
    hardware.server.polygon_s = 1;
    hardware.client.transform_s = 2e-3;
    const auto costs = simulate(scenario_of(objects, cameras, hardware, 4, 3));
    EXPECT_NEAR(costs.frame_s, 2e-3, kNothing) << "the client's";
    EXPECT_EQ(costs.single_s, 0);
}

TEST(SimulatedCluster, ReportsHowOftenTrianglesAreDrawn) {
    // It lies in the middle of the screen, where two tiles meet.
    const std::vector<Object> objects{cube({0, 0, 0}, 0.3f, 50)};
    const std::vector<Camera> cameras(1, front_camera());
    const Hardware hardware = free_hardware();
    for (const auto& [algorithm, factor] : {std::pair{Algorithm::kHybrid, 1.0}, {Algorithm::kKdSplit, 2.0}}) {
        ClusterScenario scenario = scenario_of(objects, cameras, hardware, 2, 1, algorithm);
        scenario.keep_timelines = true;
        EXPECT_EQ(simulate(scenario).timelines.at(0).overlap_factor, factor) << name_of(algorithm);
    }
}

TEST(Busiest, IsTheFirstOfEquals) {
    const std::vector<ResourceUse> use{{"a", 0.1}, {"b", 0.7}, {"c", 0.7}};
    EXPECT_EQ(busiest(use).resource, "b");
}

}  // namespace
}  // namespace swath::sim
