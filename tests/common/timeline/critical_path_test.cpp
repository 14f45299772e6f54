#include "common/timeline/critical_path.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/timeline/sample.h"

namespace swath {
namespace {

using testing::ElementsAre;

// "server 0 render" and so on, first to last.
std::vector<std::string> path(const FrameTimeline& timeline, Nanoseconds clock_error = kClockError) {
    std::vector<std::string> names;
    for (const CriticalSpan& span : critical_path(timeline, clock_error))
        names.push_back(fmt::format("{} {}", span.machine, name_of(span.phase)));
    return names;
}

Span exactly(Phase phase, int begin_us, int end_us) {
    return {phase, std::chrono::microseconds(begin_us), std::chrono::microseconds(end_us), Nanoseconds(0)};
}

// The machines' clocks agree. Server 1 draws longer, so server 0 waits for its swath and the display for
// server 0's tile.
FrameTimeline two_servers() {
    return frame(7, {machine("client", {span(Phase::kPartition, 0, 2)}),
                     machine("server 0", {span(Phase::kCull, 3, 4), span(Phase::kRender, 4, 20),
                                          span(Phase::kPixelRead, 20, 22), span(Phase::kSwap, 22, 23),
                                          span(Phase::kWait, 23, 41), span(Phase::kPixelWrite, 41, 45),
                                          span(Phase::kFinalRead, 45, 46), span(Phase::kSend, 46, 47)}),
                     machine("server 1", {span(Phase::kCull, 3, 4), span(Phase::kRender, 4, 36),
                                          span(Phase::kPixelRead, 36, 38), span(Phase::kSwap, 38, 40),
                                          span(Phase::kPixelWrite, 40, 42), span(Phase::kFinalRead, 42, 43),
                                          span(Phase::kSend, 43, 44)}),
                     machine("display", {span(Phase::kAssemble, 3, 4), span(Phase::kWait, 4, 45),
                                         span(Phase::kAssemble, 45, 46), span(Phase::kWait, 46, 48),
                                         span(Phase::kAssemble, 48, 50), span(Phase::kEncode, 50, 55)})});
}

TEST(CriticalPath, GoesThroughTheServersThatThePictureWaitedFor) {
    EXPECT_THAT(path(two_servers()),
                ElementsAre("client partition", "server 1 cull", "server 1 render", "server 1 pixel read",
                            "server 1 swap", "server 0 pixel write", "server 0 final read", "server 0 send",
                            "display assemble", "display encode"));
}

TEST(CriticalPath, HasTheSpansAsTheyAre) {
    const auto found = critical_path(two_servers());
    EXPECT_EQ(found.front(), (CriticalSpan{"client", Phase::kPartition, ms(0), ms(2)}));
    EXPECT_EQ(found.back(), (CriticalSpan{"display", Phase::kEncode, ms(50), ms(55)}));
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].end, found[i].begin);
}

TEST(CriticalPath, StaysOnTheServerThatHadNothingToWaitFor) {
    FrameTimeline timeline = two_servers();
    // The other's swath came long before.
    timeline.machines[1].spans = {span(Phase::kCull, 3, 4),         span(Phase::kRender, 4, 39),
                                  span(Phase::kPixelRead, 39, 40),  span(Phase::kSwap, 40, 41),
                                  span(Phase::kPixelWrite, 41, 45), span(Phase::kFinalRead, 45, 46),
                                  span(Phase::kSend, 46, 47)};
    EXPECT_THAT(path(timeline),
                ElementsAre("client partition", "server 0 cull", "server 0 render", "server 0 pixel read",
                            "server 0 swap", "server 0 pixel write", "server 0 final read", "server 0 send",
                            "display assemble", "display encode"));
}

TEST(CriticalPath, NamesAServersWaitForItsDrawingThreadAndNoOther) {
    FrameTimeline timeline = two_servers();
    timeline.machines[2].spans[0] = span(Phase::kWait, 3, 30);
    timeline.machines[2].spans[1] = span(Phase::kRender, 30, 36);
    const auto found = path(timeline);
    ASSERT_GE(found.size(), 3u);
    EXPECT_EQ(found[0], "client partition");
    EXPECT_EQ(found[1], "server 1 wait");
    EXPECT_EQ(found[2], "server 1 render");
    EXPECT_EQ(std::ranges::count_if(found, [](const auto& text) { return text.ends_with("wait"); }), 1);
}

TEST(CriticalPath, OfADisplayThatIsLateIsTheDisplays) {
    FrameTimeline timeline = two_servers();
    timeline.machines[3].spans = {span(Phase::kAssemble, 3, 4), span(Phase::kAssemble, 50, 60),
                                  span(Phase::kAssemble, 60, 70)};
    const auto found = path(timeline);
    ASSERT_GE(found.size(), 3u);
    EXPECT_EQ(found[found.size() - 3], "server 0 send");
    EXPECT_EQ(found[found.size() - 2], "display assemble");
    EXPECT_EQ(found[found.size() - 1], "display assemble");
}

// A message seems to arrive 0.1 ms before it was sent.
TEST(CriticalPath, AllowsForClocksThatDisagreeALittle) {
    FrameTimeline timeline = frame(
        0,
        {machine("client", {exactly(Phase::kPartition, 0, 1100)}),
         machine("server 0", {exactly(Phase::kRender, 1000, 9000), exactly(Phase::kSwap, 9000, 9100),
                              exactly(Phase::kWait, 9100, 20000), exactly(Phase::kPixelWrite, 20000, 21000),
                              exactly(Phase::kSend, 21000, 21100)}),
         machine("server 1", {exactly(Phase::kRender, 1000, 20000), exactly(Phase::kSwap, 20000, 20100)}),
         machine("display", {exactly(Phase::kAssemble, 21000, 23000)})});
    EXPECT_THAT(path(timeline), ElementsAre("client partition", "server 1 render", "server 1 swap",
                                            "server 0 pixel write", "server 0 send", "display assemble"));
    // A span that begins more than a little later is not the cause.
    timeline.machines[3].spans = {exactly(Phase::kAssemble, 20700, 23000)};
    EXPECT_THAT(path(timeline), ElementsAre("client partition", "display assemble"));
}

TEST(CriticalPath, FollowsAMessageThatCameBeforeItsSenderLookedAtTheClock) {
    const FrameTimeline timeline =
        frame(0, {machine("client", {span(Phase::kPartition, 0, 6)}),
                  machine("server 0", {span(Phase::kRender, 5, 50), span(Phase::kSend, 50, 58)}),
                  machine("display", {span(Phase::kAssemble, 3, 4), span(Phase::kAssemble, 51, 55)})});
    EXPECT_THAT(path(timeline),
                ElementsAre("client partition", "server 0 render", "server 0 send", "display assemble"));
}

TEST(CriticalPath, PrefersTheOwnMachineThatWasBusyUntilThen) {
    // By the clocks, server 1's swath came while server 0 coded its own.
    const FrameTimeline timeline = frame(
        0, {machine("server 0", {exactly(Phase::kRender, 0, 8000), exactly(Phase::kSwap, 8000, 9000),
                                 exactly(Phase::kPixelWrite, 9000, 9500)}),
            machine("server 1", {exactly(Phase::kRender, 0, 8000), exactly(Phase::kSwap, 8000, 9050)})});
    EXPECT_THAT(path(timeline), ElementsAre("server 0 render", "server 0 swap", "server 0 pixel write"));
}

// As in the simulator: swaths are read from the card, tiles are gathered and sent at once, and no machine has
// a wait.
TEST(CriticalPath, FollowsSwathsThatAreReadFromGraphicsCards) {
    const FrameTimeline timeline =
        frame(0, {machine("client", {span(Phase::kPartition, 0, 2)}),
                  machine("server 0", {span(Phase::kRender, 2, 10), span(Phase::kPixelRead, 10, 11),
                                       span(Phase::kPixelWrite, 34, 36), span(Phase::kFinalRead, 36, 37)}),
                  machine("server 1", {span(Phase::kRender, 2, 30), span(Phase::kPixelRead, 30, 33)}),
                  machine("display", {span(Phase::kAssemble, 38, 40)})});
    EXPECT_THAT(path(timeline),
                ElementsAre("client partition", "server 1 render", "server 1 pixel read",
                            "server 0 pixel write", "server 0 final read", "display assemble"));
}

TEST(CriticalPath, TakesOnlySwathsForTheCauseOfAMerge) {
    // Server 2 sends nothing; it just finished drawing when server 1's swath came.
    const FrameTimeline timeline = frame(
        0, {machine("server 0",
                    {span(Phase::kRender, 0, 5), span(Phase::kSwap, 5, 6), span(Phase::kPixelWrite, 20, 21)}),
            machine("server 1", {span(Phase::kRender, 0, 17), span(Phase::kSwap, 17, 18)}),
            machine("server 2", {span(Phase::kRender, 0, 19), span(Phase::kPixelRead, 19, 20)})});
    EXPECT_THAT(path(timeline), ElementsAre("server 1 render", "server 1 swap", "server 0 pixel write"));
}

TEST(CriticalPath, WithoutTilesIsTheClientsAndTheDisplays) {
    EXPECT_THAT(path(frame(0, {machine("client", {span(Phase::kPartition, 0, 2)}), machine("server 0", {}),
                               machine("display", {span(Phase::kAssemble, 3, 4)})})),
                ElementsAre("client partition", "display assemble"));
}

TEST(CriticalPath, OfOneProcessIsItsWork) {
    EXPECT_THAT(
        path(frame(0, {machine("single", {span(Phase::kCull, 0, 1), span(Phase::kWait, 1, 2),
                                          span(Phase::kRender, 2, 9), span(Phase::kEncode, 9, 12)})})),
        ElementsAre("single cull", "single render", "single encode"));
}

TEST(CriticalPath, OfNothingIsEmpty) {
    EXPECT_THAT(path({}), ElementsAre());
    EXPECT_THAT(path(frame(0, {machine("display", {}), machine("server 0", {})})), ElementsAre());
    EXPECT_THAT(path(frame(0, {machine("server 0", {span(Phase::kWait, 0, 5)})})), ElementsAre());
    EXPECT_THAT(path(frame(0, {machine("display", {span(Phase::kAssemble, 5, 4)})})), ElementsAre());
}

// All servers composite and code at the same instant, repeatedly.
TEST(CriticalPath, EndsAlsoWhereTimeStandsStill) {
    FrameTimeline timeline;
    for (std::size_t s = 0; s < 4; ++s) {
        timeline.machines.push_back(machine(server_name(server_id(s)), {}));
        for (int i = 0; i < 50; ++i) {
            timeline.machines.back().spans.push_back(span(Phase::kPixelWrite, 5, 5));
            timeline.machines.back().spans.push_back(span(Phase::kSwap, 5, 5));
        }
    }
    const auto found = critical_path(timeline);
    EXPECT_FALSE(found.empty());
    EXPECT_LE(found.size(), 400u);
}

}  // namespace
}  // namespace swath
