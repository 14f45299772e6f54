// The picture of a live run, as a person sees and steers it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/e2e/browser/live_page.h"

namespace swath::test {
namespace {

using nlohmann::json;

class LivePicture : public LivePage {
  protected:
    json camera() { return drawn().plan.at("camera"); }
    // The camera at rest after `act`; fails if it is still the one before.
    template <class Act>
    json camera_after(const char* what, const Act& act) {
        const json before = camera();
        act();
        wait_for_rest();
        const json after = camera();
        EXPECT_NE(before, after) << what;
        return after;
    }
    static json eye(const json& camera) { return {camera[0], camera[1], camera[2]}; }
    static json target(const json& camera) { return {camera[3], camera[4], camera[5]}; }
    static double distance(const json& camera) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double d = camera[i].get<double>() - camera[i + 3].get<double>();
            sum += d * d;
        }
        return std::sqrt(sum);
    }
};

TEST_F(LivePicture, ComesByItselfAndIsTheOneOfASingleProcess) {
    start_view();
    EXPECT_TRUE(browser().evaluate("swath.leads").get<bool>());
    EXPECT_THAT(text_of("status"), testing::HasSubstr("You steer"));
    wait_for_window_size();
    expect_exact();
    keep_screenshot("first_picture");
}

TEST_F(LivePicture, FollowsADragInJpegAndIsExactAtRest) {
    start_view();
    const Drawn before = drawn();
    browser().evaluate(R"js((() => {
        window.formats = new Set();
        const canvas = document.getElementById('picture-0');
        new MutationObserver(() => formats.add(canvas.dataset.format)).observe(canvas, {attributes: true});
    })())js");
    drag_picture(150, 60);
    wait_for_rest();
    const Drawn after = drawn();
    EXPECT_GT(after.frame, before.frame);
    EXPECT_NE(after.bytes, before.bytes);
    EXPECT_EQ(browser().evaluate("formats.has('jpeg')"), true) << "no picture while it moved";
    expect_exact();
}

TEST_F(LivePicture, TurnsMovesZoomsCentresAndResets) {
    start_view();
    const json home = camera();
    EXPECT_EQ(home, browser().evaluate("swath.session.home"));
    const Point middle = centre_of("#picture-0");

    const json turned = camera_after("drag", [&] { drag_picture(120, -40); });
    EXPECT_EQ(target(turned), target(home));
    EXPECT_NEAR(distance(turned), distance(home), 1e-3 * distance(home));

    const json moved = camera_after("drag with Shift", [&] { drag_picture(60, 30, kShiftKey); });
    EXPECT_NE(target(moved), target(turned));
    EXPECT_NEAR(distance(moved), distance(home), 1e-3 * distance(home));

    const json nearer = camera_after("wheel", [&] {
        const int before = browser().evaluate("swath.wish.id");
        browser().turn_wheel(middle, -240);
        wait_until(fmt::format("swath.wish.id > {}", before));
    });
    EXPECT_LT(distance(nearer), 0.95 * distance(moved));

    camera_after("double click", [&] { browser().double_click({middle.x + 80, middle.y + 50}); });
    camera_after("arrow", [&] { browser().press(kLeftKey); });
    const json farther = camera_after("minus", [&] { browser().press("-"); });
    EXPECT_GT(distance(farther), distance(nearer));
    expect_exact();

    EXPECT_EQ(camera_after("Home", [&] { browser().press(kHomeKey); }), home);
    camera_after("arrow", [&] { browser().press(kUpKey, kShiftKey); });
    EXPECT_EQ(camera_after("reset", [&] { browser().click("#reset"); }), home);
}

TEST_F(LivePicture, FollowsFingers) {
    start_view({.width = 390, .height = 844, .pixel_ratio = 2, .touch = true});
    wait_for_window_size();
    const json home = camera();
    const Point middle = centre_of("#picture-0");
    const json turned = camera_after("one finger", [&] {
        browser().touch_drag(middle, {middle.x + 70, middle.y + 20});
    });
    EXPECT_EQ(target(turned), target(home));
    const json nearer = camera_after("pinch", [&] { browser().pinch(middle, 30, 90); });
    EXPECT_LT(distance(nearer), 0.7 * distance(turned));
    expect_exact();
}

TEST_F(LivePicture, IsExactAtAnySizeAndPixelRatio) {
    start_view();
    for (const Viewport& viewport :
         {Viewport{1920, 1080, 1}, Viewport{1000, 700, 2}, Viewport{901, 613, 1.5}}) {
        browser().set_viewport(viewport);
        wait_for_window_size();
        const Drawn fitting = drawn();
        // Pixel for pixel: the browser does not scale.
        const json shown = browser().evaluate(
            "(() => { const box = document.getElementById('picture-0').getBoundingClientRect(); return "
            "[box.width "
            "* devicePixelRatio, box.height * devicePixelRatio]; })()");
        EXPECT_NEAR(shown[0].get<double>(), fitting.width, 0.05);
        EXPECT_NEAR(shown[1].get<double>(), fitting.height, 0.05);
        drag_picture(50, 25);
        expect_exact();
    }
    choose("size", "640x480");
    wait_for_rest();
    EXPECT_EQ(drawn().width, 640);
    EXPECT_EQ(drawn().height, 480);
    expect_exact();
}

TEST_F(LivePicture, IsMadeSmallerAtItsShapeWhereTheClientAllowsNoMore) {
    start_view({.width = 2000, .height = 1300, .pixel_ratio = 2}, {"--view-max-size", "800x600"});
    const Drawn picture = drawn();
    EXPECT_LE(picture.width, 800);
    EXPECT_LE(picture.height, 600);
    const double asked = browser().evaluate("swath.wish.width / swath.wish.height");
    EXPECT_NEAR(static_cast<double>(picture.width) / picture.height, asked, 0.01);
    expect_exact();
}

TEST_F(LivePicture, IsExactForEachAlgorithm) {
    start_view({}, {"--local", "3"});
    const auto algorithms =
        browser().evaluate("swath.session.choices.algorithms").get<std::vector<std::string>>();
    EXPECT_THAT(algorithms, testing::IsSupersetOf({"hybrid", "mahd", "kd-split", "sort-last"}));
    for (const std::string& algorithm : algorithms) {
        choose("algorithm", algorithm);
        wait_for_rest();
        EXPECT_EQ(drawn().plan.at("algorithm"), algorithm);
        expect_exact();
        drag_picture(40, 30);
        expect_exact();
    }
}

TEST_F(LivePicture, IsLosslessWithinHalfASecondOfRest) {
    start_view({.width = 800, .height = 600});
    browser().evaluate(R"js((() => {
        window.timing = {};
        addEventListener('pointermove', (e) => { if (e.buttons) timing.input = performance.now(); }, true);
        const canvas = document.getElementById('picture-0');
        new MutationObserver(() => {
            if (canvas.dataset.format === 'png') timing.lossless = performance.now();
        }).observe(canvas, {attributes: true, attributeFilter: ['data-format', 'data-frame']});
    })())js");
    std::vector<double> took_ms;
    for (int i = 0; i < 5; ++i) {
        drag_picture(60, 20);
        wait_for_rest();
        took_ms.push_back(browser().evaluate("timing.lossless - timing.input").get<double>());
        EXPECT_GT(took_ms.back(), 0);
    }
    // The median of five, because other programs take the processor now and then.
    std::sort(took_ms.begin(), took_ms.end());
    EXPECT_LT(took_ms[2], 500 * kSlowdown) << testing::PrintToString(took_ms);
}

}  // namespace
}  // namespace swath::test
