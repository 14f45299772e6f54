#include "client/director/director.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace swath {

std::ostream& operator<<(std::ostream& out, const DirectorAction& action) {
    static constexpr const char* kNames[] = {"issue", "reconfigure", "finish", "abort"};
    return out << kNames[static_cast<int>(action.kind)] << " frame " << action.frame << " " << action.reason;
}

namespace {

using Actions = Director::Actions;
using Kind = DirectorAction::Kind;

DirectorAction issue(FrameNumber frame) { return {Kind::kIssue, frame, {}}; }
DirectorAction reconfigure() { return {Kind::kReconfigure, 0, {}}; }
DirectorAction finish() { return {Kind::kFinish, 0, {}}; }

Actions good(const Result<Actions>& result) {
    EXPECT_TRUE(result.has_value()) << result.error().message;
    return result.value_or(Actions{});
}
std::string refused(const Result<Actions>& result) { return result ? "not refused" : result.error().message; }

TEST(Director, BeginsAsManyFramesAsMayBeInFlight) {
    EXPECT_EQ(Director(5, 1).on_start(), (Actions{issue(0)}));
    EXPECT_EQ(Director(5, 3).on_start(), (Actions{issue(0), issue(1), issue(2)}));
    EXPECT_EQ(Director(2, 3).on_start(), (Actions{issue(0), issue(1)}));
    EXPECT_EQ(Director(0, 3).on_start(), (Actions{finish()}));
}

TEST(Director, BeginsTheNextFrameWhenOneIsDisplayedAndAccountedFor) {
    Director director(3, 2);
    director.on_start();
    director.on_issued(0, 2);
    director.on_issued(1, 1);
    EXPECT_EQ(good(director.on_server_report(0)), (Actions{}));
    EXPECT_EQ(good(director.on_display_report(0)), (Actions{}));
    EXPECT_EQ(director.complete(), 1u);
    EXPECT_EQ(good(director.on_server_report(0)), (Actions{issue(2)}));
    director.on_issued(2, 0);  // an empty picture: nobody draws
    EXPECT_EQ(good(director.on_display_report(2)), (Actions{}));
    EXPECT_EQ(good(director.on_server_report(1)), (Actions{}));
    EXPECT_EQ(good(director.on_display_report(1)), (Actions{finish()}));
    EXPECT_EQ(director.complete(), 3u);
}

TEST(Director, LetsALaterFrameOvertake) {
    Director director(4, 2);
    director.on_start();
    director.on_issued(0, 1);
    director.on_issued(1, 1);
    good(director.on_server_report(1));
    EXPECT_EQ(good(director.on_display_report(1)), (Actions{issue(2)}));
    director.on_issued(2, 0);
    EXPECT_EQ(good(director.on_display_report(2)), (Actions{issue(3)}));
}

TEST(Director, RefusesReportsThatNoFrameAwaits) {
    Director director(3, 1);
    director.on_start();
    director.on_issued(0, 1);
    EXPECT_EQ(refused(director.on_server_report(1)), "a report for frame 1, which awaits none");
    EXPECT_EQ(refused(director.on_display_report(1)), "a picture for frame 1, which awaits none");
    good(director.on_server_report(0));
    EXPECT_EQ(refused(director.on_server_report(0)), "a report for frame 0, which awaits none");
    good(director.on_display_report(0));
    EXPECT_EQ(refused(director.on_display_report(0)), "a picture for frame 0, which awaits none");
}

TEST(Director, RefusesASecondPictureOfAFrame) {
    Director director(3, 1);
    director.on_start();
    director.on_issued(0, 1);
    good(director.on_display_report(0));
    EXPECT_EQ(refused(director.on_display_report(0)), "a picture for frame 0, which awaits none");
    EXPECT_EQ(director.complete(), 1u);
}

TEST(Director, EndsTheRunOnceWhenSomeoneIsLost) {
    Director director(3, 2);
    director.on_start();
    director.on_issued(0, 2);
    EXPECT_EQ(director.on_lost("server 1 at host:1", "silent for 1.8 s"),
              (Actions{{Kind::kAbort, 0, "server 1 at host:1: silent for 1.8 s"}}));
    EXPECT_EQ(director.on_lost("server 2 at host:2", "closed the connection"), (Actions{}));
    // Later reports change nothing.
    EXPECT_EQ(good(director.on_server_report(0)), (Actions{}));
    EXPECT_EQ(good(director.on_display_report(0)), (Actions{}));
}

TEST(Director, IsNotInterestedInLossesAfterTheEnd) {
    Director director(1, 2);
    director.on_start();
    director.on_issued(0, 0);
    EXPECT_EQ(good(director.on_display_report(0)), (Actions{finish()}));
    EXPECT_EQ(director.on_lost("the display", "closed the connection"), (Actions{}));
}

TEST(LiveDirector, BeginsAFrameWhenOneIsWantedAndOnlyThen) {
    Director director = Director::live(2);
    EXPECT_EQ(director.on_wanted(true), (Actions{}));  // nobody is connected yet
    EXPECT_EQ(director.on_start(), (Actions{issue(0)}));
    director.on_issued(0, 0);
    EXPECT_EQ(director.on_wanted(false), (Actions{}));
    EXPECT_EQ(good(director.on_display_report(0)), (Actions{}));  // and the run has no end
    EXPECT_EQ(director.on_wanted(true), (Actions{issue(1)}));
}

TEST(LiveDirector, QueuesNothingThatIsWantedWhileAllSlotsAreTaken) {
    Director director = Director::live(1);
    director.on_start();
    EXPECT_EQ(director.on_wanted(true), (Actions{issue(0)}));
    director.on_issued(0, 0);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(director.on_wanted(true), (Actions{}));
    EXPECT_EQ(good(director.on_display_report(0)), (Actions{issue(1)}));
    director.on_issued(1, 0);
    EXPECT_EQ(good(director.on_display_report(1)), (Actions{}));
}

TEST(LiveDirector, ReconfiguresWhenNoFrameIsOpenAndBeginsNoneBeforeThatIsDone) {
    Director director = Director::live(2);
    director.on_start();
    director.on_wanted(true);
    director.on_issued(0, 1);
    EXPECT_EQ(director.on_reconfigure(), (Actions{}));
    EXPECT_EQ(director.on_wanted(true), (Actions{}));
    EXPECT_EQ(director.on_reconfigure(), (Actions{}));
    good(director.on_display_report(0));
    EXPECT_EQ(good(director.on_server_report(0)), (Actions{reconfigure()}));
    EXPECT_EQ(director.on_reconfigure(), (Actions{}));
    EXPECT_EQ(director.on_wanted(true), (Actions{}));
    EXPECT_EQ(director.on_reconfigured(), (Actions{}));
    EXPECT_EQ(director.on_wanted(true), (Actions{issue(1)}));
}

TEST(LiveDirector, EndsWhenSomeoneIsLost) {
    Director director = Director::live(2);
    director.on_start();
    EXPECT_EQ(director.on_lost("the display", "gone"), (Actions{{Kind::kAbort, 0, "the display: gone"}}));
    EXPECT_EQ(director.on_wanted(true), (Actions{}));
    EXPECT_EQ(director.on_reconfigure(), (Actions{}));
}

TEST(Director, IssuesEveryFrameOnceInOrderAndNeverTooManyHoweverReportsInterleave) {
    std::mt19937 random(9);
    for (int round = 0; round < 300; ++round) {
        const std::size_t frames = random() % 15;
        const std::size_t in_flight = 1 + random() % 4;
        Director director(frames, in_flight);
        struct Missing {
            std::size_t reports;
            bool picture;
        };
        std::map<FrameNumber, Missing> open;
        FrameNumber next = 0;
        int finishes = 0;
        const auto run = [&](const Actions& actions) {
            for (const DirectorAction& a : actions) {
                if (a.kind == Kind::kFinish) {
                    ++finishes;
                    continue;
                }
                ASSERT_EQ(a, issue(next++));
                open[a.frame] = {random() % 5, true};
                director.on_issued(a.frame, open[a.frame].reports);
            }
        };
        run(director.on_start());
        while (!open.empty()) {
            ASSERT_LE(open.size(), in_flight);
            ASSERT_EQ(finishes, 0);
            auto it = open.begin();
            std::advance(it, static_cast<std::ptrdiff_t>(random() % open.size()));
            const FrameNumber frame = it->first;
            Missing& missing = it->second;
            const bool picture = missing.picture && (missing.reports == 0 || random() % 3 == 0);
            if (picture)
                missing.picture = false;
            else
                --missing.reports;
            if (!missing.picture && missing.reports == 0) open.erase(it);
            run(good(picture ? director.on_display_report(frame) : director.on_server_report(frame)));
        }
        ASSERT_EQ(finishes, 1);
        ASSERT_EQ(next, frames);
        ASSERT_EQ(director.complete(), frames);
    }
}

}  // namespace
}  // namespace swath
