#include "client/live/live_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace swath {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class LiveViewTest : public testing::Test {
  protected:
    static LiveView::Settings settings() {
        LiveView::Settings made;
        made.bounds = {{-1, -1, -1}, {1, 1, 1}};
        made.limits.servers = 3;
        made.start.camera = {0, 0, 9, 0, 0, 0, 0, 1, 0, 30};
        made.start.servers = 3;
        return made;
    }
    void wish(const std::string& json) {
        const auto status = live_.on_wish(json, 1);
        EXPECT_TRUE(status.has_value()) << status.error().message;
    }
    void draw_all() {
        for (int i = 0; i < 1000 && live_.wants_frame(); ++i) live_.next();
        EXPECT_FALSE(live_.wants_frame());
    }
    LiveView live_{settings()};
};

TEST_F(LiveViewTest, WantsNothingWhileNobodyLooks) {
    wish(R"({"path":"orbit","measure":1})");
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, DrawsTheStartForTheFirstViewerAndThenRests) {
    live_.on_viewers(1);
    ASSERT_TRUE(live_.wants_frame());
    const FrameOrder order = live_.next();
    EXPECT_EQ(order.numbers, settings().start.camera);
    EXPECT_EQ(order.servers, 3u);
    EXPECT_EQ(order.stream, 0u);
    EXPECT_LT(order.camera.near, 8);
    EXPECT_GT(order.camera.far, 10);
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, DrawsAFrameForEveryNewcomer) {
    live_.on_viewers(1);
    draw_all();
    live_.on_viewers(2);
    EXPECT_TRUE(live_.wants_frame());
    draw_all();
    live_.on_viewers(1);
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, DrawsTheNewestWishOnly) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"id":1,"camera":[0,0,8,0,0,0,0,1,0,30]})");
    wish(R"({"id":2,"camera":[0,0,7,0,0,0,0,1,0,30]})");
    const FrameOrder order = live_.next();
    EXPECT_EQ(order.wish, 2u);
    EXPECT_EQ(order.by, 1u);
    EXPECT_EQ(order.numbers[2], 7);
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, DrawsNothingForAWishThatChangesNothing) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"id":3,"servers":3})");
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, DrawsEveryCameraTwiceToCompareTwoAlgorithms) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"algorithm":"mahd","against":"hybrid"})");
    const FrameOrder one = live_.next();
    wish(R"({"camera":[0,0,8,0,0,0,0,1,0,30]})");
    const FrameOrder two = live_.next();
    EXPECT_EQ(one.algorithm, Algorithm::kMahd);
    EXPECT_EQ(two.algorithm, Algorithm::kHybrid);
    EXPECT_EQ(one.stream, 0u);
    EXPECT_EQ(two.stream, 1u);
    EXPECT_EQ(one.numbers, two.numbers);
    EXPECT_EQ(live_.next().numbers[2], 8);
    wish(R"({"against":null})");
    EXPECT_EQ(live_.next().stream, 0u);
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, TellsTheWishedCameraAtOnceAndNotWhenItIsDrawn) {
    wish(R"({"camera":[1,2,3,0,0,0,0,1,0,40]})");
    EXPECT_EQ(live_.camera(), (CameraNumbers{1, 2, 3, 0, 0, 0, 0, 1, 0, 40}));
}

TEST_F(LiveViewTest, PlaysAPathRoundAndRoundWithCamerasThatAFileCanHold) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"path":"orbit"})");
    std::set<CameraNumbers> seen;
    for (int i = 0; i < 500; ++i) {
        ASSERT_TRUE(live_.wants_frame());
        const FrameOrder order = live_.next();
        seen.insert(order.numbers);
        EXPECT_EQ(live_.camera(), order.numbers);
        EXPECT_EQ(camera_of(order.numbers)->eye, order.camera.eye);
        EXPECT_EQ(camera_of(order.numbers)->fov_y, order.camera.fov_y);
    }
    EXPECT_EQ(seen.size(), 240u);
    wish(R"({"path":null})");
    EXPECT_EQ(live_.next().numbers, settings().start.camera);
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, RestsWhilePausedButForSingleSteps) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"path":"orbit","paused":true})");
    EXPECT_FALSE(live_.wants_frame());
    wish(R"({"step":1})");
    wish(R"({"step":2})");
    draw_all();
    wish(R"({"step":2})");
    EXPECT_FALSE(live_.wants_frame());
    wish(R"({"paused":false})");
    EXPECT_TRUE(live_.wants_frame());
}

TEST_F(LiveViewTest, DrawsOneFrameForAStep) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"path":"orbit","paused":true,"step":1})");
    live_.next();
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, WantsNoFrameUntilTheSetupIsInEffect) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"objects":400,"cull":"none"})");
    EXPECT_FALSE(live_.wants_frame());
    const LiveSetup wanted{400, {{RendererKind::kOsmesa}, CullAlgorithm::kNone}};
    EXPECT_EQ(live_.wanted_setup(), wanted);
    live_.on_setup(wanted);
    EXPECT_EQ(live_.wanted_setup(), std::nullopt);
    EXPECT_TRUE(live_.wants_frame());
}

TEST_F(LiveViewTest, DoesNotTryARefusedSetupAgainUntilAnotherIsWishedFor) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"renderer":"egl"})");
    live_.on_setup_refused(*live_.wanted_setup(), "server 1: no EGL");
    EXPECT_EQ(live_.refused(), (Refusals{{"renderer", "server 1: no EGL"}}));
    EXPECT_EQ(live_.setup().draw.renderers.front(), RendererKind::kOsmesa);
    wish(R"({"renderer":"egl","camera":[0,0,8,0,0,0,0,1,0,30]})");
    EXPECT_EQ(live_.wanted_setup(), std::nullopt);
    EXPECT_TRUE(live_.wants_frame());
    wish(R"({"renderer":"osmesa"})");
    EXPECT_THAT(live_.refused(), IsEmpty());
    EXPECT_EQ(live_.wanted_setup(), std::nullopt);
    wish(R"({"renderer":"egl"})");
    EXPECT_TRUE(live_.wanted_setup().has_value());
}

TEST_F(LiveViewTest, TriesWhatWasWishedForWhileAnotherSetupWasRefused) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"renderer":"egl"})");
    const LiveSetup tried = *live_.wanted_setup();
    wish(R"({"renderer":"osmesa","objects":6000})");
    live_.on_setup_refused(tried, "no EGL");
    EXPECT_THAT(live_.refused(), IsEmpty());
    EXPECT_EQ(live_.wanted_setup(), (LiveSetup{6000, {{RendererKind::kOsmesa}, CullAlgorithm::kWide}}));
}

TEST_F(LiveViewTest, TellsTheWishedSetupUnlessItIsRefused) {
    wish(R"({"renderer":"egl"})");
    EXPECT_EQ(live_.accepted_setup().draw.renderers.front(), RendererKind::kEgl);
    live_.on_setup_refused(*live_.wanted_setup(), "no EGL");
    EXPECT_EQ(live_.accepted_setup().draw.renderers.front(), RendererKind::kOsmesa);
}

TEST_F(LiveViewTest, RefusesCamerasThatSinglePrecisionCannotProject) {
    live_.on_viewers(1);
    draw_all();
    for (const char* camera : {"[0,0,9,0,0,0,0,1,0,1e-38]", "[0,0,1e12,0,0,0,0,1,0,30]"}) {
        wish(std::string(R"({"camera":)") + camera + "}");
        EXPECT_EQ(live_.refused().count("camera"), 1u) << camera;
        EXPECT_EQ(live_.wish().camera, settings().start.camera);
        EXPECT_FALSE(live_.wants_frame());
    }
    wish(R"({"camera":[0,0,1000,0,0,0,0,1,0,30]})");
    EXPECT_THAT(live_.refused(), IsEmpty());
    EXPECT_TRUE(live_.wants_frame());
}

TEST_F(LiveViewTest, SaysWhatOfAWishCannotBeHad) {
    wish(R"({"servers":4})");
    EXPECT_THAT(live_.refused().at("servers"), HasSubstr("1 to 3"));
    wish(R"({"servers":2})");
    EXPECT_THAT(live_.refused(), IsEmpty());
    EXPECT_FALSE(live_.on_wish("no", 1).has_value());
}

TEST_F(LiveViewTest, MeasuresWithEveryNumberOfServersAndThenShowsTheWishAgain) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"measure":1,"servers":2})");
    std::map<std::size_t, std::size_t> counted;
    while (live_.measuring()) {
        const FrameOrder order = live_.next();
        EXPECT_EQ(order.measurement, 1u);
        counted[order.servers] += order.counts ? 1 : 0;
    }
    const std::size_t each = kMeasuredFrames - kUncountedFrames;
    EXPECT_EQ(counted, (std::map<std::size_t, std::size_t>{{1, each}, {2, each}, {3, each}}));
    ASSERT_TRUE(live_.wants_frame());
    EXPECT_EQ(live_.next().servers, 2u);
    EXPECT_FALSE(live_.wants_frame());
}

TEST_F(LiveViewTest, StopsMeasuringWhenTheCameraMovesOrNobodyLooks) {
    live_.on_viewers(1);
    draw_all();
    wish(R"({"measure":1})");
    live_.next();
    wish(R"({"camera":[0,0,8,0,0,0,0,1,0,30]})");
    EXPECT_FALSE(live_.measuring());
    EXPECT_EQ(live_.next().measurement, 0u);
    wish(R"({"measure":2})");
    EXPECT_TRUE(live_.measuring());
    live_.on_viewers(0);
    EXPECT_FALSE(live_.measuring());
}

TEST_F(LiveViewTest, HandsOutEachTraceThatIsAskedForOnce) {
    EXPECT_FALSE(live_.take_trace());
    wish(R"({"trace":1})");
    EXPECT_TRUE(live_.take_trace());
    EXPECT_FALSE(live_.take_trace());
    wish(R"({"trace":1})");
    EXPECT_FALSE(live_.take_trace());
}

}  // namespace
}  // namespace swath
