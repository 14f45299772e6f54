#include "client/live/speed_ups.h"

#include <gtest/gtest.h>

namespace swath {
namespace {

using std::chrono::milliseconds;

FrameOrder order(std::size_t measurement, std::size_t servers, bool counts = true) {
    FrameOrder made;
    made.measurement = measurement;
    made.servers = servers;
    made.counts = counts;
    return made;
}

// Two servers, the busier of which needs `cpu`; the client needs more.
FrameTimeline timeline(Nanoseconds cpu) {
    FrameTimeline made;
    const Nanoseconds none(0);
    made.machines = {
        {"client", {{Phase::kPartition, none, none, 10 * cpu}}, {}},
        {"server 0", {{Phase::kRender, none, none, cpu / 2}, {Phase::kSwap, none, none, cpu / 2}}, {}},
        {"server 1", {{Phase::kRender, none, none, cpu / 3}}, {}}};
    return made;
}

TEST(SpeedUps, AreMeansOverTheFramesThatCount) {
    SpeedUps found;
    EXPECT_FALSE(found.on_frame(order(0, 2), timeline(milliseconds(6)), milliseconds(9), {}));
    EXPECT_FALSE(found.on_frame(order(1, 2, false), timeline(milliseconds(6)), milliseconds(9), {}));
    EXPECT_FALSE(found.on_frame(order(1, 2), timeline(milliseconds(6)), std::nullopt, {}));
    EXPECT_TRUE(found.points().empty());
    EXPECT_TRUE(found.on_frame(order(1, 2), timeline(milliseconds(6)), milliseconds(10), {}));
    EXPECT_TRUE(found.on_frame(order(1, 2), timeline(milliseconds(12)), milliseconds(20), 4.0));
    EXPECT_TRUE(found.on_frame(order(1, 1), timeline(milliseconds(30)), milliseconds(40), {}));
    const auto points = found.points();
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].servers, 1u);
    EXPECT_EQ(points[0].predicted_ms, std::nullopt);
    EXPECT_DOUBLE_EQ(points[1].interval_ms, 15);
    EXPECT_DOUBLE_EQ(points[1].busiest_cpu_ms, 9);
    EXPECT_EQ(points[1].predicted_ms, 4.0);
}

TEST(SpeedUps, OfANewMeasurementReplaceTheLastOnes) {
    SpeedUps found;
    found.on_frame(order(1, 1), timeline(milliseconds(6)), milliseconds(10), {});
    FrameOrder other = order(2, 3);
    other.algorithm = Algorithm::kMahd;
    found.on_frame(other, timeline(milliseconds(6)), milliseconds(10), {});
    ASSERT_EQ(found.points().size(), 1u);
    EXPECT_EQ(found.points()[0].servers, 3u);
    EXPECT_EQ(found.algorithm(), Algorithm::kMahd);
}

}  // namespace
}  // namespace swath
