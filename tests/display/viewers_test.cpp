#include "display/view/viewers.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace swath {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using namespace std::chrono_literals;
using Done = std::vector<std::string>;

constexpr ViewFormat kJpeg = ViewFormat::kJpeg;
constexpr ViewFormat kPng = ViewFormat::kPng;

SharedBytes bytes_of(const std::string& text) {
    auto bytes = std::make_shared<Buffer>();
    bytes->append(text.data(), text.size());
    return bytes;
}

std::string text_of(const SharedBytes& bytes) {
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "nothing";
}

std::string picture_name(const PictureKey& key) {
    return fmt::format("{}{}{}", key.format == kPng ? "png " : "jpeg ", key.frame,
                       key.stream == 0 ? "" : "'");
}

// Viewers, a clock that the test moves, and actions as lines: "encode jpeg 3" ("3'" is frame 3 of stream 1),
// "2 < jpeg 3" (is written to viewer 2), "2 < audience: 1 leads 2".
class ViewersTest : public testing::Test {
  protected:
    Done join(ViewerId viewer) { return lines(viewers_.on_join(viewer, now_)); }
    Done leave(ViewerId viewer) { return lines(viewers_.on_leave(viewer, now_)); }
    Done lead(ViewerId viewer) { return lines(viewers_.on_lead(viewer, now_)); }
    Done written(ViewerId viewer) { return lines(viewers_.on_written(viewer, now_)); }
    Done shown(ViewerId viewer, FrameNumber frame, ViewFormat format = kJpeg, std::uint32_t stream = 0) {
        return lines(viewers_.on_shown(viewer, {viewers_.run(), frame, stream, format}, now_));
    }
    Done session(bool live = true) { return lines(viewers_.on_session(live, now_)); }
    Done session_end() { return lines(viewers_.on_session_end(now_)); }
    Done note(NoteTopic topic, const std::string& text, FrameNumber frame = 0) {
        return lines(viewers_.on_note(topic, frame, bytes_of(text), now_));
    }
    Done picture(FrameNumber frame, std::uint32_t stream = 0) {
        return lines(viewers_.on_picture(frame, stream, std::make_shared<Picture>(), now_));
    }
    Done encoded(FrameNumber frame, ViewFormat format = kJpeg, std::uint32_t stream = 0) {
        const PictureKey key{viewers_.run(), frame, stream, format};
        return lines(viewers_.on_encoded(key, bytes_of(picture_name(key)), now_));
    }
    Done tick_after(Nanoseconds time) {
        now_ += time;
        return lines(viewers_.on_tick(now_));
    }
    // Adds a viewer who has been told the audience, and to whom nothing is being written.
    void settled_viewer(ViewerId viewer) {
        join(viewer);
        read_all();
    }
    // Finishes everything that is being written, and all that follows. Returns what viewers got.
    Done read_all() {
        Done all;
        for (bool more = true; more;) {
            more = false;
            for (ViewerId viewer = 1; viewer < 10; ++viewer)
                for (const std::string& line : written(viewer)) {
                    all.push_back(line);
                    more = more || line.find('<') != std::string::npos;
                }
        }
        return all;
    }

    Viewers viewers_;
    Nanoseconds now_ = 1h;

  private:
    static Done lines(const Viewers::Actions& actions) {
        Done all;
        for (const ViewerAction& action : actions) {
            if (const auto* task = std::get_if<EncodePicture>(&action)) {
                EXPECT_NE(task->picture, nullptr);
                all.push_back("encode " + picture_name(task->key) +
                              (task->plan ? " with " + text_of(task->plan) : ""));
            } else if (const auto* sent = std::get_if<SendBytes>(&action)) {
                const std::string what = text_of(sent->bytes);
                EXPECT_EQ(sent->text, !what.starts_with("jpeg") && !what.starts_with("png"));
                all.push_back(fmt::format("{} < {}", sent->to, what));
            } else {
                const auto& audience = std::get<SendAudience>(action);
                all.push_back(fmt::format("{} < audience: {} leads {}{}", audience.to, audience.lead,
                                          audience.viewers, audience.session ? "" : ", no session"));
            }
        }
        return all;
    }
};

// Leading.

TEST_F(ViewersTest, TheFirstLeadsAndEverybodyHearsWhoLooks) {
    session();
    EXPECT_THAT(join(1), ElementsAre("1 < audience: 1 leads 1"));
    EXPECT_THAT(join(2), ElementsAre("2 < audience: 1 leads 2"));
    EXPECT_THAT(written(1), ElementsAre("1 < audience: 1 leads 2"));
    EXPECT_EQ(viewers_.count(), 2u);
    EXPECT_TRUE(viewers_.steers(1));
    EXPECT_FALSE(viewers_.steers(2));
}

TEST_F(ViewersTest, WhoAsksToLeadDoes) {
    session();
    settled_viewer(1);
    settled_viewer(2);
    EXPECT_THAT(lead(2), ElementsAre("1 < audience: 2 leads 2", "2 < audience: 2 leads 2"));
    EXPECT_TRUE(viewers_.steers(2));
    EXPECT_FALSE(viewers_.steers(1));
    EXPECT_THAT(lead(2), IsEmpty());
    EXPECT_THAT(lead(7), IsEmpty());  // there is no such viewer
    EXPECT_TRUE(viewers_.steers(2));
}

TEST_F(ViewersTest, TheOneWhoHasBeenThereLongestTakesOverFromALeaderWhoGoes) {
    session();
    for (const ViewerId viewer : {1u, 2u, 3u}) settled_viewer(viewer);
    EXPECT_THAT(leave(2), ElementsAre("1 < audience: 1 leads 2", "3 < audience: 1 leads 2"));
    settled_viewer(4);
    lead(4);
    read_all();
    EXPECT_THAT(leave(4), ElementsAre("1 < audience: 1 leads 2", "3 < audience: 1 leads 2"));
    read_all();
    EXPECT_THAT(leave(1), ElementsAre("3 < audience: 3 leads 1"));
    EXPECT_THAT(leave(3), IsEmpty());
    EXPECT_EQ(viewers_.count(), 0u);
    EXPECT_THAT(join(5), ElementsAre("5 < audience: 5 leads 1"));
}

TEST_F(ViewersTest, NobodySteersWhatIsNotLive) {
    settled_viewer(1);
    EXPECT_FALSE(viewers_.steers(1));
    session(false);
    EXPECT_FALSE(viewers_.steers(1));
    session_end();
    session(true);
    EXPECT_TRUE(viewers_.steers(1));
    session_end();
    EXPECT_FALSE(viewers_.steers(1));
}

TEST_F(ViewersTest, WhatIsSaidByAndForThoseWhoHaveGoneIsNothing) {
    session();
    settled_viewer(1);
    leave(1);
    EXPECT_THAT(leave(1), IsEmpty());
    EXPECT_THAT(written(1), IsEmpty());
    EXPECT_THAT(shown(1, 0), IsEmpty());
    EXPECT_THAT(picture(0), IsEmpty());
    EXPECT_EQ(viewers_.deadline(), std::nullopt);
}

// Pictures.

TEST_F(ViewersTest, NothingIsEncodedWhileNobodyLooks) {
    session();
    for (FrameNumber frame = 0; frame < 100; ++frame) {
        viewers_.on_announced(frame);
        EXPECT_THAT(picture(frame), IsEmpty());
        EXPECT_EQ(viewers_.deadline(), std::nullopt);
        now_ += 1s;
    }
}

TEST_F(ViewersTest, AnEncodingIsMadeOnceForAll) {
    session();
    settled_viewer(1);
    settled_viewer(2);
    settled_viewer(3);
    EXPECT_THAT(picture(0), ElementsAre("encode jpeg 0"));
    EXPECT_THAT(encoded(0), ElementsAre("1 < jpeg 0", "2 < jpeg 0", "3 < jpeg 0"));
    EXPECT_THAT(read_all(), IsEmpty());
}

TEST_F(ViewersTest, ANewcomerGetsTheNewestAtOnceAndWithoutLossWhenNothingMoves) {
    session();
    picture(3);
    picture(4);
    settled_viewer(1);
    encoded(4);
    EXPECT_THAT(join(2), ElementsAre("2 < audience: 1 leads 2"));
    EXPECT_THAT(written(2), ElementsAre("2 < jpeg 4"));
    read_all();
    EXPECT_THAT(tick_after(1s), ElementsAre("encode png 4"));
    EXPECT_THAT(encoded(4, kPng), ElementsAre("1 < png 4", "2 < png 4"));
    read_all();
    join(3);
    EXPECT_THAT(written(3), ElementsAre("3 < png 4"));  // of the picture that is there
}

TEST_F(ViewersTest, AtMostTwoPicturesAreOnTheirWayAndThenTheNewestFollows) {
    session();
    settled_viewer(1);
    for (const FrameNumber frame : {0u, 1u}) {
        picture(frame);
        EXPECT_THAT(encoded(frame), ElementsAre(fmt::format("1 < jpeg {}", frame)));
        EXPECT_THAT(written(1), IsEmpty());
    }
    for (const FrameNumber frame : {2u, 3u, 4u}) EXPECT_THAT(picture(frame), IsEmpty());
    EXPECT_THAT(shown(1, 0), ElementsAre("encode jpeg 4"));
    EXPECT_THAT(encoded(4), ElementsAre("1 < jpeg 4"));
    EXPECT_THAT(written(1), IsEmpty());
    EXPECT_THAT(picture(5), IsEmpty());
    // The newer of two is shown, which is an answer to both.
    EXPECT_THAT(shown(1, 4), ElementsAre("encode jpeg 5"));
    encoded(5);
    written(1);
    EXPECT_THAT(picture(6), ElementsAre("encode jpeg 6"));
}

TEST_F(ViewersTest, OnlyWhatWasSentCanBeShown) {
    session();
    settled_viewer(1);
    for (const FrameNumber frame : {0u, 1u}) {
        picture(frame);
        encoded(frame);
        written(1);
    }
    picture(2);
    EXPECT_THAT(shown(1, 2), IsEmpty());
    EXPECT_THAT(shown(1, 0, kPng), IsEmpty());
    EXPECT_THAT(shown(1, 0, kJpeg, 1), IsEmpty());
    EXPECT_THAT(shown(1, 0), Not(IsEmpty()));
    EXPECT_THAT(shown(1, 0), IsEmpty());  // a second time
}

TEST_F(ViewersTest, WhatIsNextIsChosenWhenTheLastIsWritten) {
    session();
    settled_viewer(1);
    picture(0);
    EXPECT_THAT(encoded(0), ElementsAre("1 < jpeg 0"));
    for (const FrameNumber frame : {1u, 2u, 3u}) EXPECT_THAT(picture(frame), IsEmpty());
    EXPECT_THAT(written(1), ElementsAre("encode jpeg 3"));
}

TEST_F(ViewersTest, ASlowViewerMissesWhatItHasNoRoomForAndSlowsNobody) {
    session();
    settled_viewer(1);
    settled_viewer(2);  // a slow one: nothing gets written to it
    picture(0);
    encoded(0);
    written(1);
    shown(1, 0);
    for (FrameNumber frame = 1; frame < 50; ++frame) {
        EXPECT_THAT(picture(frame), ElementsAre(fmt::format("encode jpeg {}", frame)));
        EXPECT_THAT(encoded(frame), ElementsAre(fmt::format("1 < jpeg {}", frame)));
        EXPECT_EQ(viewers_.waiting_bytes(), bytes_of(fmt::format("jpeg {}", frame))->size());
        EXPECT_THAT(written(1), IsEmpty());
        EXPECT_THAT(shown(1, frame), IsEmpty());
    }
    EXPECT_THAT(written(2), ElementsAre("2 < jpeg 49"));
}

TEST_F(ViewersTest, APictureThatCameWhileAnotherWasEncodedFollowsIt) {
    session();
    settled_viewer(1);
    EXPECT_THAT(picture(0), ElementsAre("encode jpeg 0"));
    EXPECT_THAT(picture(1), IsEmpty());
    EXPECT_THAT(picture(2), IsEmpty());
    EXPECT_THAT(encoded(0), ElementsAre("encode jpeg 2", "1 < jpeg 0"));
    EXPECT_THAT(encoded(2), IsEmpty());
    EXPECT_THAT(written(1), ElementsAre("1 < jpeg 2"));
}

TEST_F(ViewersTest, StreamsAreSeparateAndTakeTurns) {
    session();
    settled_viewer(1);
    for (const FrameNumber frame : {0u, 2u}) {
        picture(frame, 0);
        picture(frame + 1, 1);
        encoded(frame, kJpeg, 0);
        encoded(frame + 1, kJpeg, 1);
        EXPECT_THAT(read_all(), ElementsAre(fmt::format("1 < jpeg {}'", frame + 1)));
    }
    EXPECT_THAT(picture(4, 0), IsEmpty());  // two of each are on their way
    EXPECT_THAT(picture(5, 1), IsEmpty());
    EXPECT_THAT(shown(1, 1, kJpeg, 1), ElementsAre("encode jpeg 5'"));
    EXPECT_THAT(shown(1, 0, kJpeg, 0), ElementsAre("encode jpeg 4"));
    EXPECT_THAT(encoded(5, kJpeg, 1), ElementsAre("1 < jpeg 5'"));
    EXPECT_THAT(encoded(4, kJpeg, 0), IsEmpty());
    EXPECT_THAT(written(1), ElementsAre("1 < jpeg 4"));
}

TEST_F(ViewersTest, AnOlderFrameThatIsCompleteLaterIsOfNoUse) {
    session();
    settled_viewer(1);
    viewers_.on_announced(0);
    viewers_.on_announced(1);
    EXPECT_THAT(picture(1), ElementsAre("encode jpeg 1"));
    EXPECT_THAT(encoded(1), ElementsAre("1 < jpeg 1"));
    EXPECT_THAT(picture(0), IsEmpty());
    EXPECT_THAT(read_all(), IsEmpty());
}

TEST_F(ViewersTest, APictureThatCannotBeEncodedIsPassedOver) {
    session();
    settled_viewer(1);
    picture(0);
    EXPECT_THAT(viewers_.on_encoded({viewers_.run(), 0, 0, kJpeg}, nullptr, now_), IsEmpty());
    EXPECT_THAT(read_all(), IsEmpty());
    EXPECT_THAT(picture(1), ElementsAre("encode jpeg 1"));
}

// PNG.

TEST_F(ViewersTest, TheNewestComesWithoutLossWhenItHasHadNoSuccessorForAWhile) {
    session();
    settled_viewer(1);
    picture(0);
    encoded(0);
    now_ += 100ms;
    picture(1);
    written(1);
    encoded(1);
    written(1);
    EXPECT_EQ(viewers_.deadline(), now_ + 150ms);
    EXPECT_THAT(tick_after(149ms), IsEmpty());
    EXPECT_THAT(tick_after(1ms), IsEmpty());  // two are on their way
    EXPECT_EQ(viewers_.deadline(), std::nullopt);
    EXPECT_THAT(shown(1, 0), ElementsAre("encode png 1"));
    EXPECT_THAT(encoded(1, kPng), ElementsAre("1 < png 1"));
    EXPECT_THAT(written(1), IsEmpty());
    shown(1, 1);
    EXPECT_THAT(shown(1, 1, kPng), IsEmpty());  // that is all
    EXPECT_THAT(tick_after(1h), IsEmpty());
    EXPECT_THAT(picture(2), ElementsAre("encode jpeg 2"));
}

TEST_F(ViewersTest, AFrameThatIsAnnouncedIsASuccessor) {
    session();
    settled_viewer(1);
    viewers_.on_announced(0);
    picture(0);
    encoded(0);
    written(1);
    viewers_.on_announced(1);
    EXPECT_EQ(viewers_.deadline(), std::nullopt);
    EXPECT_THAT(tick_after(10s), IsEmpty());
    EXPECT_THAT(picture(1), ElementsAre("encode jpeg 1"));
    EXPECT_EQ(viewers_.deadline(), now_ + 150ms);
}

TEST_F(ViewersTest, WhatMovesAgainWaitsForNoPictureWithoutLossAndComesInOrder) {
    session();
    settled_viewer(1);
    picture(0);
    encoded(0);
    written(1);
    shown(1, 0);
    EXPECT_THAT(tick_after(150ms), ElementsAre("encode png 0"));
    viewers_.on_announced(1);
    EXPECT_THAT(picture(1), ElementsAre("encode jpeg 1"));
    EXPECT_THAT(encoded(1), ElementsAre("1 < jpeg 1"));
    EXPECT_THAT(encoded(0, kPng), IsEmpty());
    EXPECT_THAT(read_all(), IsEmpty());
}

TEST_F(ViewersTest, BothStreamsComeWithoutLoss) {
    session();
    settled_viewer(1);
    picture(0, 0);
    picture(1, 1);
    encoded(0, kJpeg, 0);
    encoded(1, kJpeg, 1);
    read_all();
    EXPECT_THAT(tick_after(150ms), ElementsAre("encode png 0", "encode png 1'"));
}

// Notes.

TEST_F(ViewersTest, NewcomersGetTheNewestOfWhatLasts) {
    session();
    note(NoteTopic::kState, "state 1");
    note(NoteTopic::kSpeedup, "speedup");
    note(NoteTopic::kObjects, "objects");
    note(NoteTopic::kSession, "session");
    note(NoteTopic::kState, "state 2");
    note(NoteTopic::kTrace, "trace");
    note(NoteTopic::kFrame, "frame");
    join(1);
    EXPECT_THAT(read_all(), ElementsAre("1 < session", "1 < objects", "1 < state 2", "1 < speedup"));
}

TEST_F(ViewersTest, OfEachTopicTheNewestWaits) {
    session();
    join(1);  // takes long to read the audience
    for (const char* i : {"1", "2", "3"})
        for (const auto& [topic, name] : {std::pair{NoteTopic::kTrace, "trace "},
                                          {NoteTopic::kState, "state "},
                                          {NoteTopic::kSession, "session "}})
            EXPECT_THAT(note(topic, std::string(name) + i), IsEmpty());
    EXPECT_EQ(viewers_.waiting_bytes(), std::string("trace 3state 3session 3").size());
    EXPECT_THAT(read_all(), ElementsAre("1 < session 3", "1 < state 3", "1 < trace 3"));
}

TEST_F(ViewersTest, OfFrameNotesTheOldestGoWhenManyWait) {
    session();
    join(1);
    for (int i = 0; i < 100; ++i) note(NoteTopic::kFrame, fmt::format("frame {}", i));
    const Done got = read_all();
    ASSERT_EQ(got.size(), Viewers::kMaxFrameNotes);
    EXPECT_EQ(got.front(), "1 < frame 36");
    EXPECT_EQ(got.back(), "1 < frame 99");
}

TEST_F(ViewersTest, PicturesAndFrameNotesTakeTurns) {
    session();
    settled_viewer(1);
    picture(0);
    encoded(0);  // is being written
    shown(1, 0);
    for (const char* text : {"frame a", "frame b", "frame c"}) note(NoteTopic::kFrame, text);
    EXPECT_THAT(written(1), ElementsAre("1 < frame a"));
    picture(1);
    encoded(1);
    EXPECT_THAT(written(1), ElementsAre("1 < jpeg 1"));
    EXPECT_THAT(written(1), ElementsAre("1 < frame b"));
    EXPECT_THAT(written(1), ElementsAre("1 < frame c"));
}

TEST_F(ViewersTest, PlansComeWithTheirPictures) {
    session();
    settled_viewer(1);
    EXPECT_THAT(note(NoteTopic::kPlan, "plan 0", 0), IsEmpty());
    EXPECT_THAT(note(NoteTopic::kPlan, "plan 1", 1), IsEmpty());
    EXPECT_THAT(picture(0), ElementsAre("encode jpeg 0 with plan 0"));
    encoded(0);
    EXPECT_THAT(written(1), IsEmpty());
    EXPECT_THAT(picture(1), ElementsAre("encode jpeg 1 with plan 1"));
    EXPECT_THAT(encoded(1), ElementsAre("1 < jpeg 1"));
    written(1);
    shown(1, 1);
    EXPECT_THAT(tick_after(150ms), ElementsAre("encode png 1 with plan 1"));
    EXPECT_THAT(picture(2), ElementsAre("encode jpeg 2"));
}

TEST_F(ViewersTest, PlansWithoutPicturesDoNotPileUp) {
    session();
    settled_viewer(1);
    for (FrameNumber frame = 0; frame < 100; ++frame) note(NoteTopic::kPlan, "plan", frame);
    EXPECT_THAT(picture(100 - Viewers::kMaxPlans - 1), ElementsAre("encode jpeg 87"));
    encoded(87);
    written(1);
    EXPECT_THAT(picture(100 - Viewers::kMaxPlans), ElementsAre("encode jpeg 88 with plan"));
}

// Sessions.

TEST_F(ViewersTest, WhatASessionLeftIsForgottenWithIt) {
    session();
    settled_viewer(1);
    note(NoteTopic::kSession, "old");
    read_all();
    note(NoteTopic::kState, "old");  // is being written; these wait:
    note(NoteTopic::kSession, "old");
    note(NoteTopic::kFrame, "old");
    note(NoteTopic::kPlan, "old", 1);
    viewers_.on_announced(1);
    picture(0);
    EXPECT_THAT(session_end(), IsEmpty());
    EXPECT_THAT(read_all(), ElementsAre("1 < audience: 1 leads 1, no session"));
    EXPECT_EQ(viewers_.waiting_bytes(), 0u);
    EXPECT_EQ(viewers_.deadline(), std::nullopt);
    EXPECT_THAT(join(2),
                ElementsAre("1 < audience: 1 leads 2, no session", "2 < audience: 1 leads 2, no session"));
    EXPECT_THAT(read_all(), IsEmpty());

    EXPECT_THAT(session(), ElementsAre("1 < audience: 1 leads 2", "2 < audience: 1 leads 2"));
    read_all();
    EXPECT_THAT(picture(1), ElementsAre("encode jpeg 1"));  // without a plan
}

TEST_F(ViewersTest, FrameNumbersBeginAnewWithASession) {
    session();
    settled_viewer(1);
    for (const FrameNumber frame : {7u, 8u}) {
        picture(frame);
        encoded(frame);
        written(1);
    }
    EXPECT_THAT(picture(9), IsEmpty());
    session_end();
    session();
    read_all();
    EXPECT_THAT(picture(0), ElementsAre("encode jpeg 0"));
    EXPECT_THAT(encoded(0), ElementsAre("1 < jpeg 0"));
}

TEST_F(ViewersTest, APictureEncodedForASessionThatIsOverGoesToNobody) {
    session();
    settled_viewer(1);
    picture(0);
    const PictureKey old{viewers_.run(), 0, 0, kJpeg};
    session_end();
    session();
    read_all();
    EXPECT_THAT(picture(0), ElementsAre("encode jpeg 0"));
    EXPECT_THAT(viewers_.on_encoded(old, bytes_of("jpeg old"), now_), IsEmpty());
    EXPECT_THAT(encoded(0), ElementsAre("1 < jpeg 0"));
}

}  // namespace
}  // namespace swath
