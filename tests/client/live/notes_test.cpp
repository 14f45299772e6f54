#include "client/live/notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/models.h"

namespace swath {
namespace {

using Json = nlohmann::json;

LiveView live_view() {
    LiveView::Settings settings;
    settings.bounds = {{-1, -1, -1}, {1, 1, 1}};
    settings.limits.servers = 2;
    settings.start.camera = {0.1f, 0, 9, 0, 0, 0, 0, 1, 0, 30};
    settings.start.servers = 2;
    return LiveView(settings);
}

TEST(Notes, OfAPlanHaveWhatTheOverlaysDraw) {
    FrameOrder order;
    order.numbers = {0.1f, 2, 3, 0, 0, 0, 0, 1, 0, 30};
    order.width = 8;
    order.height = 4;
    order.algorithm = Algorithm::kSortLast;
    order.wish = 12;
    order.by = 3;
    FramePlan plan;
    plan.frame = 5;
    plan.view.width = 8;
    plan.view.height = 4;
    plan.view.clip_from_model[3][0] = 7;
    plan.view.pose = 0.1f;
    plan.servers = {{{0, 2, 9}, {{0, 0, 4, 4}}, {0, 0, 6, 4}}, {{}, {{4, 0, 8, 4}}, {}}};
    const Json note = Json::parse(plan_note(order, plan, 1.25, 2));
    EXPECT_EQ(note["wish"], 12);
    EXPECT_EQ(note["by"], 3);
    EXPECT_EQ(note["algorithm"], "sort-last");
    EXPECT_EQ(note["servers"], 2);
    EXPECT_EQ(note["camera"][0].dump(), "0.1");
    EXPECT_EQ(note["generation"], 2);
    EXPECT_EQ(note["overlap"], 1.25);
    EXPECT_EQ(note["clip"][12], 7);
    EXPECT_EQ(note["pose"].dump(), "0.1");
    EXPECT_EQ(note["tiles"].dump(), "[[0,0,4,4],[4,0,8,4]]");
    EXPECT_EQ(note["contents"].dump(), "[[0,0,6,4],[]]");
    EXPECT_EQ(note["groups"].dump(), "[[0,2,7],[]]");
    EXPECT_EQ(note["links"].dump(), "[[0,1,4,0,6,4]]");
}

TEST(Notes, OfTheStateSayWhatCountsAndWhatIsRefused) {
    LiveView live = live_view();
    ASSERT_TRUE(live.on_wish(R"({"id":4,"against":"mahd","servers":7,"renderer":"egl","path":"orbit"})", 9));
    const Json note = Json::parse(state_note(live, "changing", "swath-client x"));
    EXPECT_EQ(note["type"], "state");
    EXPECT_EQ(note["wish"], 4);
    EXPECT_EQ(note["by"], 9);
    EXPECT_EQ(note["against"], "mahd");
    EXPECT_EQ(note["servers"], 2);
    EXPECT_EQ(note["renderer"], "egl");
    EXPECT_EQ(note["path"], "orbit");
    EXPECT_EQ(note["busy"], "changing");
    EXPECT_EQ(note["command"], "swath-client x");
    EXPECT_EQ(note["refused"].dump(), R"({"servers":"a whole number from 1 to 2 is expected"})");
    EXPECT_TRUE(Json::parse(state_note(live, "", ""))["busy"].is_null());
}

TEST(Notes, SayWhichRenderersTheServersHaveInTurn) {
    LiveView::Settings settings;
    settings.bounds = {{-1, -1, -1}, {1, 1, 1}};
    settings.start.setup.draw.renderers = {RendererKind::kRaycast, RendererKind::kOsmesa};
    LiveView live(settings);
    const auto choices = [&] {
        return Json::parse(session_note({}, &live, {2, 100, 50}))["choices"]["renderers"].dump();
    };
    EXPECT_EQ(Json::parse(state_note(live, "", ""))["renderer"], "raycast,osmesa");
    EXPECT_EQ(choices(), R"(["raster","osmesa","egl","raycast","raycast,osmesa"])");
    ASSERT_TRUE(live.on_wish(R"({"id":1,"renderer":"raycast"})", 1));
    EXPECT_EQ(Json::parse(state_note(live, "", ""))["renderer"], "raycast");
    EXPECT_EQ(choices(), R"(["raster","osmesa","egl","raycast","raycast,osmesa"])");  // the list can be chosen again
}

TEST(Notes, OfTheSessionSayWhatThereIsToChooseFrom) {
    const LiveView live = live_view();
    SessionFacts facts{
        "a \"model\"\xff", 12, {{0, 0, 0}, {1, 2, 3}}, {{"a:1", "llvmpipe"}, {"b:2", "x"}}, {1, 2, 255}};
    const Json note = Json::parse(session_note(facts, &live, {2, 100, 50}));
    EXPECT_EQ(note["triangles"], 12);
    EXPECT_EQ(note["live"], true);
    EXPECT_TRUE(note["why"].is_null());
    EXPECT_EQ(note["home"][2], 9);
    EXPECT_EQ(note["bounds"].dump(), "[0.0,0.0,0.0,1.0,2.0,3.0]");
    EXPECT_EQ(note["servers"][1]["name"], "server 1");
    EXPECT_EQ(note["servers"][1]["address"], "b:2");
    EXPECT_EQ(note["background"], "#0102ff");
    EXPECT_EQ(note["choices"]["algorithms"].dump(), R"(["hybrid","mahd","kd-split","sort-last"])");
    EXPECT_EQ(note["choices"]["renderers"].dump(), R"(["raster","osmesa","egl","raycast"])");
    EXPECT_EQ(note["choices"]["culls"].dump(), R"(["wide","a2ssb","adsb","none"])");
    EXPECT_EQ(note["choices"]["max_width"], 100);
    const Json path = Json::parse(session_note(facts, nullptr, {}));
    EXPECT_EQ(path["live"], false);
    EXPECT_TRUE(path["why"].is_string());
}

TEST(Notes, OfObjectsHaveTheirBoxes) {
    const ObjectSet scene = build_objects(test::cube(), {2, 0});
    const ObjectSet by_sah = build_objects(test::cube(), {.objects = 3, .by = ObjectsBy::kSah});
    EXPECT_EQ(Json::parse(objects_note(7, by_sah))["by"], "sah");
    EXPECT_TRUE(Json::parse(objects_note(7, by_sah))["depth"].is_null());
    const Json note = Json::parse(objects_note(3, scene));
    EXPECT_EQ(note["generation"], 3);
    EXPECT_EQ(note["depth"], 2);
    EXPECT_EQ(note["count"], scene.objects.size());
    ASSERT_EQ(note["boxes"].size(), 6 * scene.objects.size());
    EXPECT_EQ(note["boxes"][3].get<float>(), scene.objects[0].box.max.x);
    EXPECT_TRUE(note["end_boxes"].is_null());
    Mesh mesh = test::cube();
    mesh.motion.assign(mesh.vertices.size(), glm::vec3(5, 0, 0));
    const ObjectSet moving = build_objects(mesh, {2, 0});
    const Json ends = Json::parse(objects_note(4, moving))["end_boxes"];
    ASSERT_EQ(ends.size(), 6 * moving.objects.size());
    EXPECT_EQ(ends[3].get<float>(), moving.objects[0].box.max.x + 5);
}

TEST(Notes, OfAFrameHaveEverySpanAndWhatWasCounted) {
    FinishedFrame frame;
    frame.order.servers = 1;
    frame.order.stream = 1;
    frame.timeline.frame = 6;
    frame.timeline.overlap_factor = 1.5;
    MachineTimeline server;
    server.machine = "server 0";
    server.spans = {{Phase::kPixelRead, std::chrono::microseconds(1500), std::chrono::microseconds(2000),
                     std::chrono::microseconds(250)}};
    server[Counter::kTriangles] = 77;
    frame.timeline.machines = {{"client", {}, {}}, server};
    FrameFindings findings;
    Json note = Json::parse(frame_note(frame, findings));
    EXPECT_EQ(note["frame"], 6);
    EXPECT_EQ(note["stream"], 1);
    EXPECT_EQ(note["overlap"], 1.5);
    EXPECT_TRUE(note["interval"].is_null());
    EXPECT_EQ(note["machines"][1]["name"], "server 0");
    EXPECT_EQ(note["machines"][1]["spans"].dump(), R"([["pixel read",1.5,2.0,0.25]])");
    EXPECT_EQ(note["machines"][1]["counters"].dump(), R"({"triangles":77})");
    findings.interval = std::chrono::milliseconds(20);
    note = Json::parse(frame_note(frame, findings));
    EXPECT_EQ(note["interval"], 20);
}

}  // namespace
}  // namespace swath
