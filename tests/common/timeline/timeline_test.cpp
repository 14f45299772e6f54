#include "common/timeline/timeline.h"

#include <gtest/gtest.h>

#include <set>

#include "common/base/check.h"

namespace swath {
namespace {

TEST(Timeline, EveryPhaseAndCounterHasANameOfItsOwn) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < kPhaseCount; ++i) names.insert(name_of(static_cast<Phase>(i)));
    EXPECT_EQ(names.size(), kPhaseCount);
    for (std::size_t i = 0; i < kCounterCount; ++i) names.insert(name_of(static_cast<Counter>(i)));
    EXPECT_EQ(names.size(), kPhaseCount + kCounterCount);
    EXPECT_FALSE(names.contains(""));
}

TEST(Timeline, NamesStandAtTheirEnumerators) {
    EXPECT_EQ(name_of(Phase::kPartition), "partition");
    EXPECT_EQ(name_of(Phase::kPixelRead), "pixel read");
    EXPECT_EQ(name_of(Phase::kFinalRead), "final read");
    EXPECT_EQ(name_of(Phase::kWait), "wait");
    EXPECT_EQ(name_of(Counter::kTriangles), "triangles");
    EXPECT_EQ(name_of(Counter::kTileBytes), "tile_bytes");
    EXPECT_EQ(name_of(Counter::kReceivedPixels), "received_pixels");
    EXPECT_EQ(name_of(Counter::kLeaves), "leaves");
    EXPECT_EQ(name_of(Counter::kSplitLevel), "split_level");
}

TEST(Timeline, NamingAPhaseOutOfRangeIsABug) {
    EXPECT_THROW(name_of(static_cast<Phase>(kPhaseCount)), CheckFailed);
    EXPECT_THROW(name_of(static_cast<Counter>(kCounterCount)), CheckFailed);
}

TEST(Timeline, OnlyServersAreCalledServers) {
    EXPECT_EQ(server_name(server_id(12)), "server 12");
    EXPECT_TRUE(is_server(server_name(server_id(0))));
    EXPECT_FALSE(is_server("client"));
    EXPECT_FALSE(is_server("display"));
    EXPECT_FALSE(is_server("serverless"));
}

TEST(Timeline, AMachinesCountersAreReachedByName) {
    MachineTimeline machine;
    machine[Counter::kObjects] = 7;
    EXPECT_EQ(machine.counters[1], 7u);
    EXPECT_EQ(std::as_const(machine)[Counter::kObjects], 7u);
}

}  // namespace
}  // namespace swath
