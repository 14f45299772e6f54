#include "common/timeline/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/common/timeline/sample.h"

namespace swath {
namespace {

using testing::HasSubstr;
using testing::Not;

double mean(const Summary::Machine& machine, Phase phase) {
    return machine.mean_ms[static_cast<std::size_t>(phase)];
}

// A frame in which server i is busy for busy[i] ms.
FrameTimeline loaded(std::vector<int> busy) {
    FrameTimeline frame;
    for (std::size_t i = 0; i < busy.size(); ++i)
        frame.machines.push_back(machine(server_name(server_id(i)), {span(Phase::kRender, 0, busy[i])}));
    return frame;
}
double imbalance_of(std::vector<FrameTimeline> frames) { return summarise(frames).imbalance; }

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST(Imbalance, IsZeroWhenAllAreEquallyBusy) { EXPECT_EQ(imbalance_of({loaded({10, 10, 10})}), 0); }

TEST(Imbalance, IsTheIdleShareOfTheMeanServer) {
    // max 10, mean 7.5: a quarter of the cluster waits.
    EXPECT_DOUBLE_EQ(imbalance_of({loaded({10, 5})}), 0.25);
    // One of four works: mean 3.
    EXPECT_DOUBLE_EQ(imbalance_of({loaded({12, 0, 0, 0})}), 0.75);
    EXPECT_DOUBLE_EQ(imbalance_of({loaded({8})}), 0);
}

TEST(Imbalance, IsAveragedOverFramesNotOverTime) {
    // 0.25 and 0.5, though the second frame is ten times as long.
    EXPECT_DOUBLE_EQ(imbalance_of({loaded({10, 5}), loaded({100, 0})}), 0.375);
}

TEST(Imbalance, DoesNotCountFramesInWhichNoServerWorked) {
    EXPECT_DOUBLE_EQ(imbalance_of({loaded({10, 5}), loaded({0, 0}), loaded({})}), 0.25);
}

TEST(Imbalance, AddsAllPhasesButWaitAndLooksAtServersOnly) {
    const FrameTimeline only =
        frame(0, {machine("client", {span(Phase::kPartition, 0, 500)}),
                  machine("server 0",
                          {span(Phase::kCull, 0, 1), span(Phase::kRender, 1, 7), span(Phase::kSwap, 7, 10)}),
                  machine("server 1", {span(Phase::kRender, 0, 5), span(Phase::kWait, 5, 100)})});
    EXPECT_DOUBLE_EQ(imbalance_of({only}), 0.25);
}

TEST(Summary, MeansAreOverTheFramesThatNameTheMachine) {
    FrameTimeline first =
        frame(0, {machine("server 0", {span(Phase::kRender, 0, 10, 8), span(Phase::kRender, 10, 12)}),
                  machine("server 1", {span(Phase::kRender, 0, 6)})});
    FrameTimeline second = frame(1, {machine("server 0", {span(Phase::kRender, 12, 20)})});
    first.machines[0][Counter::kTriangles] = 100;
    second.machines[0][Counter::kTriangles] = 300;
    const Summary summary = summarise(std::vector{first, second});
    ASSERT_EQ(summary.machines.size(), 2u);
    EXPECT_EQ(summary.machines[0].name, "server 0");
    EXPECT_EQ(summary.machines[0].frames, 2u);
    EXPECT_DOUBLE_EQ(mean(summary.machines[0], Phase::kRender), 10);
    EXPECT_DOUBLE_EQ(summary.machines[0].mean_cpu_ms[static_cast<std::size_t>(Phase::kRender)], 4);
    EXPECT_DOUBLE_EQ(summary.machines[0].mean_count[static_cast<std::size_t>(Counter::kTriangles)], 200);
    EXPECT_EQ(summary.machines[1].frames, 1u);
    EXPECT_DOUBLE_EQ(mean(summary.machines[1], Phase::kRender), 6);
}

TEST(Summary, FramesPerSecondRunFromFirstBeginToLastEnd) {
    // Two pipelined frames within 1000 to 1050 ms.
    const std::vector<FrameTimeline> frames{
        frame(0, {machine("client", {span(Phase::kPartition, 1000, 1002)}),
                  machine("display", {span(Phase::kAssemble, 1020, 1030)})}),
        frame(1, {machine("client", {span(Phase::kPartition, 1010, 1012)}),
                  machine("display", {span(Phase::kAssemble, 1040, 1050)})})};
    EXPECT_DOUBLE_EQ(summarise(frames).frames_per_s, 40);
}

TEST(Summary, SwapAndTilesAreOfAllServersPerFrame) {
    FrameTimeline first = loaded({1, 1});
    FrameTimeline second = loaded({1});
    first.machines[0][Counter::kSwapPixels] = 100;
    first.machines[1][Counter::kSwapPixels] = 300;
    second.machines[0][Counter::kSwapPixels] = 200;
    first.machines[1][Counter::kSwapBytes] = 4096;
    second.machines[0][Counter::kTileBytes] = 2048;
    first.machines.push_back(machine("client", {}));
    first.machines.back()[Counter::kSwapPixels] = 1'000'000;
    first.overlap_factor = 1.5;
    second.overlap_factor = 1.0;
    const Summary summary = summarise(std::vector{first, second});
    EXPECT_DOUBLE_EQ(summary.swap_pixels, 300);
    EXPECT_DOUBLE_EQ(summary.swap_bytes, 2048);
    EXPECT_DOUBLE_EQ(summary.tile_bytes, 1024);
    EXPECT_DOUBLE_EQ(summary.overlap_factor, 1.25);
}

TEST(Summary, OfNothingIsAllZeroAndStillPrints) {
    const Summary summary = summarise({});
    EXPECT_EQ(summary.frames, 0u);
    EXPECT_EQ(summary.frames_per_s, 0);
    EXPECT_EQ(summary.imbalance, 0);
    EXPECT_EQ(summary.overlap_factor, 1);
    EXPECT_THAT(to_text(summary), HasSubstr("frames     0, 0.00 frames/s\n"));
}

TEST(SummaryText, IsThisTable) {
    FrameTimeline only =
        frame(0, {machine("client", {span(Phase::kPartition, 0, 2)}),
                  machine("server 0", {span(Phase::kRender, 2, 12), span(Phase::kPixelRead, 12, 14)}),
                  machine("server 1", {span(Phase::kRender, 2, 8), span(Phase::kWait, 8, 14)}),
                  machine("display", {span(Phase::kAssemble, 14, 20)})});
    only.machines[1][Counter::kSwapPixels] = 640;
    only.machines[1][Counter::kSwapBytes] = 7680;
    only.machines[2][Counter::kTileBytes] = 3072;
    only.overlap_factor = 1.0625;
    EXPECT_EQ(to_text(summarise(std::vector{only})),
              "                               pixel\n"
              "ms a frame  partition  render   read  assemble  wait\n"
              "client           2.00    0.00   0.00      0.00  0.00\n"
              "server 0         0.00   10.00   2.00      0.00  0.00\n"
              "server 1         0.00    6.00   0.00      0.00  6.00\n"
              "display          0.00    0.00   0.00      6.00  0.00\n"
              "\n"
              "frames     1, 50.00 frames/s\n"
              "swapped    640 pixels, 7.5 KiB a frame\n"
              "tiles      3.0 KiB a frame\n"
              "imbalance  25.0 %\n"
              "overlap    1.062\n");
}

TEST(SummaryText, SaysWhatAllMachinesDrewAFrame) {
    FrameTimeline first = frame(0, {machine("server 0", {span(Phase::kRender, 0, 1)}),
                                    machine("server 1", {span(Phase::kRender, 0, 1)})});
    FrameTimeline second = frame(1, {machine("server 0", {span(Phase::kRender, 1, 2)})});
    first.machines[0][Counter::kTriangles] = 1000;
    first.machines[1][Counter::kTriangles] = 200;
    second.machines[0][Counter::kTriangles] = 300;
    first.machines[0][Counter::kObjects] = 7;
    second.machines[0][Counter::kObjects] = 3;
    EXPECT_THAT(to_text(summarise(std::vector{first, second})),
                HasSubstr("\ndrawn      750 triangles of 5 objects a frame\n"));
    EXPECT_THAT(to_text(summarise(std::vector{loaded({5})})), Not(HasSubstr("drawn")));
}

TEST(SummaryText, LeavesOutPhasesThatNobodySpentTimeIn) {
    const std::string text = to_text(summarise(std::vector{loaded({5})}));
    EXPECT_THAT(text, HasSubstr("render"));
    EXPECT_THAT(text, Not(HasSubstr("partition")));
    EXPECT_THAT(text, Not(HasSubstr("encode")));
}

TEST(SummaryText, SixteenServersHaveARowEachAndMoreHaveThreeTogether) {
    const std::string sixteen = to_text(summarise(std::vector{loaded(std::vector<int>(16, 4))}));
    EXPECT_THAT(sixteen, HasSubstr("server 15 "));

    std::vector<int> busy(17, 4);
    busy[3] = 1;
    busy[9] = 24;
    const std::string seventeen = to_text(summarise(std::vector{loaded(busy)}));
    EXPECT_THAT(seventeen, Not(HasSubstr("server 1")));
    EXPECT_THAT(seventeen, HasSubstr("17 servers: mean    5.00\n"
                                     "  min               1.00\n"
                                     "  max              24.00\n"));
}

TEST(SummaryText, NeverHasMoreThanAHundredColumns) {
    for (const double largest : {0.001, 99.0, 999.996, 1234.5, 99999.0, 5e7, 9e12}) {
        Summary summary;
        for (const char* name : {"a machine with quite a long name", "server 0", "display"}) {
            Summary::Machine row;
            row.name = name;
            row.mean_ms.fill(largest);
            summary.machines.push_back(row);
        }
        for (const std::string& line : lines_of(to_text(summary)))
            EXPECT_LE(line.size(), 100u) << largest << ": " << line;
    }
}

}  // namespace
}  // namespace swath
