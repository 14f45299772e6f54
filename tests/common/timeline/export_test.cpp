#include "common/timeline/export.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/common/timeline/sample.h"

namespace swath {
namespace {

using nlohmann::json;

std::vector<json> complete_events(const std::string& trace) {
    std::vector<json> events;
    const json document = json::parse(trace);
    for (const json& event : document.at("traceEvents"))
        if (event.at("ph") == "X") events.push_back(event);
    return events;
}

TEST(Csv, HasARowPerFrameSpanAndNonZeroCounter) {
    FrameTimeline first = frame(7, {machine("client", {span(Phase::kPartition, 100, 102, 1)}),
                                    machine("server 0", {span(Phase::kRender, 103, 120)})});
    first.machines[1][Counter::kSwapPixels] = 4096;
    first.overlap_factor = 1.25;
    EXPECT_EQ(to_csv(std::vector{first}),
              "frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value\n"
              "7,,frame,overlap_factor,,,,1.250000\n"
              "7,client,span,partition,0.000000,2.000000,1.000000,\n"
              "7,server 0,span,render,3.000000,20.000000,0.000000,\n"
              "7,server 0,counter,swap_pixels,,,,4096\n");
}

TEST(Csv, KeepsSingleNanosecondsOfALongRun) {
    const Nanoseconds day = std::chrono::hours(24);
    const FrameTimeline only =
        frame(0, {machine("client", {{Phase::kWait, Nanoseconds(5), day + Nanoseconds(6), Nanoseconds(7)}})});
    EXPECT_NE(to_csv(std::vector{only}).find(",wait,0.000000,86400000.000001,0.000007,"), std::string::npos);
}

TEST(Csv, QuotesNamesThatWouldBreakTheRow) {
    const FrameTimeline only = frame(0, {machine("a,\"b\"", {span(Phase::kWait, 0, 1)})});
    EXPECT_NE(to_csv(std::vector{only}).find("0,\"a,\"\"b\"\"\",span,wait,"), std::string::npos);
}

TEST(Csv, OfNothingIsTheHeader) {
    EXPECT_EQ(to_csv({}), "frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value\n");
}

TEST(Csv, StartsAtTheEarliestSpanEvenIfALaterFrameHasIt) {
    const std::vector<FrameTimeline> frames{frame(0, {machine("client", {span(Phase::kPartition, 20, 30)})}),
                                            frame(1, {machine("client", {span(Phase::kPartition, 10, 20)})})};
    const std::string csv = to_csv(frames);
    EXPECT_NE(csv.find("0,client,span,partition,10.000000,20.000000"), std::string::npos);
    EXPECT_NE(csv.find("1,client,span,partition,0.000000,10.000000"), std::string::npos);
}

TEST(ChromeTrace, NamesAProcessPerMachineInOrderOfAppearance) {
    const std::vector<FrameTimeline> frames{
        frame(0, {machine("server 1", {span(Phase::kRender, 0, 1)})}),
        frame(1, {machine("client", {span(Phase::kPartition, 0, 1)}), machine("server 1", {})})};
    std::map<int, std::string> names;
    const json trace = json::parse(to_chrome_trace(frames));
    for (const json& event : trace.at("traceEvents"))
        if (event.at("ph") == "M" && event.at("name") == "process_name")
            names[event.at("pid").get<int>()] = event.at("args").at("name").get<std::string>();
    EXPECT_EQ(names, (std::map<int, std::string>{{1, "server 1"}, {2, "client"}}));
}

TEST(ChromeTrace, GivesMicrosecondsFrameAndCpuOfASpan) {
    const FrameTimeline only =
        frame(42, {machine("client", {{Phase::kPartition, Nanoseconds(1000), Nanoseconds(3500), ms(2)},
                                      {Phase::kWait, Nanoseconds(3500), Nanoseconds(3500), {}}})});
    const std::vector<json> events = complete_events(to_chrome_trace(std::vector{only}));
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].at("name"), "partition");
    EXPECT_EQ(events[0].at("ts"), 0.0);
    EXPECT_EQ(events[0].at("dur"), 2.5);
    EXPECT_EQ(events[0].at("args").at("frame"), 42);
    EXPECT_EQ(events[0].at("args").at("cpu_ms"), 2.0);
    EXPECT_EQ(events[1].at("ts"), 2.5);
    EXPECT_EQ(events[1].at("dur"), 0.0);
    EXPECT_FALSE(events[1].at("args").contains("cpu_ms")) << "unknown CPU time is not zero CPU time";
}

TEST(ChromeTrace, PutsOverlappingSpansOfPipelinedFramesOnAsFewTracksAsNeeded) {
    // Frame 0 renders until 10 and sends until 14; frame 1 renders from 10, frame 2 from 20.
    const std::vector<FrameTimeline> frames{
        frame(0, {machine("server 0", {span(Phase::kRender, 0, 10), span(Phase::kSwap, 8, 14)})}),
        frame(1, {machine("server 0", {span(Phase::kRender, 10, 20), span(Phase::kSwap, 18, 22)})}),
        frame(2, {machine("server 0", {span(Phase::kRender, 20, 30)})})};
    std::map<int, std::vector<std::pair<double, double>>> tracks;
    for (const json& event : complete_events(to_chrome_trace(frames))) {
        const double begin = event.at("ts").get<double>();
        tracks[event.at("tid").get<int>()].emplace_back(begin, begin + event.at("dur").get<double>());
    }
    EXPECT_EQ(tracks.size(), 2u);
    for (const auto& [track, spans] : tracks)
        for (std::size_t i = 1; i < spans.size(); ++i)
            EXPECT_LE(spans[i - 1].second, spans[i].first) << "track " << track << " overlaps itself";
}

TEST(ChromeTrace, LetsMachinesOverlapOnTheirOwnFirstTrack) {
    const FrameTimeline only = frame(0, {machine("server 0", {span(Phase::kRender, 0, 10)}),
                                         machine("server 1", {span(Phase::kRender, 0, 10)})});
    for (const json& event : complete_events(to_chrome_trace(std::vector{only})))
        EXPECT_EQ(event.at("tid"), 1);
}

TEST(ChromeTrace, SurvivesSpansThatEndBeforeTheyBeginAndNamesThatAreNotUtf8) {
    const FrameTimeline only = frame(0, {machine("\xff\"\n", {span(Phase::kRender, 10, 5)})});
    const std::vector<json> events = complete_events(to_chrome_trace(std::vector{only}));
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].at("dur"), 0.0);
}

TEST(ChromeTrace, OfNothingIsStillATrace) {
    EXPECT_TRUE(json::parse(to_chrome_trace({})).at("traceEvents").empty());
}

TEST(ChromeTrace, IsTheSameTextTwice) {
    const std::vector<FrameTimeline> frames{
        frame(0, {machine("server 0", {span(Phase::kRender, 0, 10), span(Phase::kRender, 0, 10)})})};
    EXPECT_EQ(to_chrome_trace(frames), to_chrome_trace(frames));
}

}  // namespace
}  // namespace swath
