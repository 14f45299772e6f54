// A person's changes while frames run: each takes effect without a restart and leaves the picture exact.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/e2e/browser/live_page.h"

namespace swath::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LiveControls : public LivePage {
  protected:
    std::vector<std::string> choices(const std::string& of) {
        return browser().evaluate("swath.session.choices[argument].map(String)", of);
    }
    int frame() { return drawn().frame; }
    // The number of painted pixels of an overlay.
    int painted(const std::string& id) {
        return browser().evaluate(
            "(() => { const c = document.getElementById(argument); if (!c.width || !c.height) return 0; "
            "const d = "
            "c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = 3; i < "
            "d.length; "
            "i += 4) n += d[i] > 0; return n; })()",
            id);
    }
};

TEST_F(LiveControls, AnyNumberOfServersTakesPart) {
    start_view({}, {"--local", "3"});
    EXPECT_EQ(browser().evaluate("swath.session.servers.length"), 3);
    for (const char* servers : {"1", "2", "3"}) {
        choose("servers", servers);
        wait_for_rest();
        const Drawn picture = drawn();
        EXPECT_EQ(picture.plan.at("servers"), std::stoi(servers));
        EXPECT_EQ(picture.plan.at("tiles").size(), std::stoul(servers));
        expect_exact();
    }
}

TEST_F(LiveControls, ObjectsAreCutAnew) {
    start_view();
    const std::string most = choices("objects").back();
    const int before = browser().evaluate("swath.plan(0).generation");
    choose("objects", most);
    wait_for_setup("objects", std::stoi(most));
    EXPECT_GT(browser().evaluate("swath.plan(0).generation").get<int>(), before);
    expect_exact();
}

TEST_F(LiveControls, EveryCullingGivesTheSamePicture) {
    start_view();
    const std::string bytes = drawn().bytes;
    for (const std::string& cull : choices("culls")) {
        if (state("cull") == cull) continue;
        choose("cull", cull);
        wait_for_setup("cull", cull);
        EXPECT_TRUE(drawn().bytes == bytes) << cull;
    }
    expect_exact();
}

TEST_F(LiveControls, ARendererIsHadOrRefusedWithAReason) {
    start_view();
    if (browser().evaluate("document.querySelector(`#renderer option[value='egl']`).disabled").get<bool>()) {
        EXPECT_THAT(browser()
                        .evaluate("document.querySelector(`#renderer option[value='egl']`).textContent")
                        .get<std::string>(),
                    HasSubstr("not in this build"));
        return;
    }
    const std::string before = state("renderer").get<std::string>();
    choose("renderer", "egl");
    wait_until("swath.state.renderer === 'egl' || swath.state.refused.renderer");
    const json refused = state("refused");
    if (refused.contains("renderer")) {
        EXPECT_EQ(state("renderer"), before);
        EXPECT_THAT(text_of("renderer-why"), HasSubstr(refused["renderer"].get<std::string>()));
    } else {
        wait_for_setup("renderer", "egl");
        expect_exact();
        choose("renderer", before);
        wait_for_setup("renderer", before);
    }
    drag_picture(30, 30);
    expect_exact();
}

TEST_F(LiveControls, TwoAlgorithmsShareACameraSideBySide) {
    start_view();
    choose("against", "sort-last");
    wait_for_window_size();
    drag_picture(50, 40);
    wait_for_rest();
    const Drawn first = drawn(0);
    const Drawn second = drawn(1);
    EXPECT_EQ(first.plan.at("algorithm"), "hybrid");
    EXPECT_EQ(second.plan.at("algorithm"), "sort-last");
    EXPECT_EQ(first.plan.at("camera"), second.plan.at("camera"));
    EXPECT_TRUE(first.bytes == second.bytes);
    const json boxes = browser().evaluate(
        "['picture-0', 'picture-1'].map((id) => document.getElementById(id).getBoundingClientRect())"
        ".map(({left, right, top}) => [left, right, top])");
    EXPECT_LE(boxes[0][1].get<double>(), boxes[1][0].get<double>()) << "not side by side";
    expect_exact();
    keep_screenshot("side_by_side");

    choose("against", "");
    wait_for_window_size();
    EXPECT_EQ(browser().evaluate("document.getElementById('cell-1').hidden"), true);
    expect_exact();
}

TEST_F(LiveControls, PausedItDrawsAFrameAStep) {
    start_view();
    press_down("pause", true);
    wait_until("swath.state.paused");
    const int paused_at = frame();
    drag_picture(80, 10);
    // The client has read the wish.
    wait_until(
        "swath.wish.camera.some((n, i) => n !== swath.plan(0).camera[i]) && swath.state.wish === "
        "swath.wish.id");
    EXPECT_EQ(frame(), paused_at);
    browser().click("#step");
    wait_for_rest();
    EXPECT_GT(frame(), paused_at);
    expect_exact();
    press_down("pause", false);
    drag_picture(-30, 10);
    expect_exact();
}

TEST_F(LiveControls, APathPlaysUntilAPersonSteers) {
    start_view();
    for (const std::string& path : choices("paths")) {
        choose("path", path);
        browser().evaluate("window.seen = new Set()");
        wait_until("seen.add(JSON.stringify(swath.plan(0).camera)).size >= 4 && swath.state.path");
        EXPECT_EQ(state("path"), path);
        drag_picture(30, 20);
        wait_for_rest();
        EXPECT_TRUE(state("path").is_null());
        expect_exact();
    }
}

TEST_F(LiveControls, EachOverlayIsPaintedAndTakenAway) {
    start_view({}, {"--local", "3"});
    choose("algorithm", "mahd");  // it draws objects more than once
    wait_for_rest();
    EXPECT_EQ(painted("overlay-0"), 0);
    for (const char* layer : {"tiles", "groups", "boxes", "overlap"}) {
        press_down(fmt::format("show-{}", layer), true);
        EXPECT_GT(painted("overlay-0"), 100) << layer;
        keep_screenshot(fmt::format("overlay_{}", layer));
        press_down(fmt::format("show-{}", layer), false);
        EXPECT_EQ(painted("overlay-0"), 0) << layer;
    }
    choose("algorithm", "hybrid");  // it swaps pixels
    wait_for_rest();
    press_down("show-swaths", true);
    EXPECT_GT(painted("overlay-0"), 100);
    press_down("show-tiles", true);
    keep_screenshot("overlay_swaths");
}

TEST_F(LiveControls, ShowsWhatEveryMachineDidAndWhatOtherAlgorithmsWouldTake) {
    start_view();
    choose("path", "orbit");
    // Predictions need rates, which take some frames to learn.
    wait_until(
        "document.querySelectorAll('#predictions tbody tr').length === "
        "swath.session.choices.algorithms.length");
    wait_until("document.getElementById('frame-table').textContent.includes('all, predicted')");
    EXPECT_EQ(browser().evaluate(
                  "[...document.querySelectorAll('#frame-table thead th')].map((e) => e.textContent)"),
              json({"ms", "client", "0", "1", "display"}));
    EXPECT_THAT(text_of("predictions"), HasSubstr("in use"));
    EXPECT_THAT(text_of("critical"), HasSubstr("Critical path"));
    for (const char* chart : {"gantt", "bars"}) EXPECT_GT(painted(chart), 100) << chart;
    keep_screenshot("machines");
}

TEST_F(LiveControls, SpeedUpIsMeasuredForEachNumberOfServers) {
    start_view({}, {"--local", "3"});
    browser().click("#measure");
    wait_until(
        "!document.getElementById('measure').disabled && "
        "document.querySelectorAll('#curve-table tbody tr').length === 3");
    EXPECT_GT(painted("curve"), 100);
    keep_screenshot("speedup");
    expect_exact();
}

}  // namespace
}  // namespace swath::test
