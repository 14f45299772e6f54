// The harness itself, on a page of its own.
#include <gmock/gmock.h>

#include "tests/e2e/browser/browser_fixture.h"

namespace swath::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Throws;

constexpr std::string_view kPage = R"html(<!doctype html><title>harness</title>
<meta name="viewport" content="width=device-width">
<style>
body{margin:0} #box{width:200px;height:100px;background:#c00}
#cover{position:fixed;z-index:1;inset:150px 0 0 0} #covered{position:fixed;top:200px}
</style>
<div id="box" tabindex="0"></div><button id="button">b</button>
<div id="cover"></div><button id="covered">c</button>
<script>
window.seen = [];
for (const type of ['pointerdown', 'pointerup', 'wheel', 'keydown', 'dblclick', 'click'])
  addEventListener(type, (e) => {
    const place = e.clientX === undefined ? '' : `${Math.round(e.clientX)},${Math.round(e.clientY)}`;
    seen.push(`${type} ${e.pointerType ?? e.key ?? ''} ${place}${e.shiftKey ? ' shift' : ''}`);
  });
</script>)html";

class WebDriver : public BrowserTest {
  protected:
    void SetUp() override {
        BrowserTest::SetUp();
        if (!IsSkipped()) browser().open("file://" + files_.write("page.html", kPage));
    }
    std::vector<std::string> seen() { return browser().evaluate("seen.splice(0)"); }
};

TEST_F(WebDriver, EvaluatesExpressionsAndPromisesWithAnArgument) {
    EXPECT_EQ(browser().evaluate("document.title"), "harness");
    EXPECT_EQ(browser().evaluate("(await Promise.resolve(argument.a)) + 1", {{"a", 41}}), 42);
    EXPECT_THAT([&] { browser().evaluate("nothing.at.all"); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("nothing is not defined")));
}

TEST_F(WebDriver, WaitsUntilAConditionHoldsAndNoLongerThanTold) {
    browser().evaluate("setTimeout(() => { window.later = {done: true} }, 20)");
    browser().wait_until("later.done", kPatience);
    EXPECT_THAT([&] { browser().wait_until("later.never", std::chrono::milliseconds(30)); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("later.never")));
}

TEST_F(WebDriver, SetsSizePixelRatioColourSchemeAndTouch) {
    static constexpr const char* kWhatItIs =
        "[innerWidth, innerHeight, devicePixelRatio, matchMedia('(prefers-color-scheme: dark)').matches, "
        "navigator.maxTouchPoints > 0]";
    browser().set_viewport({.width = 800, .height = 600});
    EXPECT_EQ(browser().evaluate(kWhatItIs), nlohmann::json({800, 600, 1, false, false}));
    browser().set_viewport({.width = 390, .height = 844, .pixel_ratio = 3, .dark = true, .touch = true});
    EXPECT_EQ(browser().evaluate(kWhatItIs), nlohmann::json({390, 844, 3, true, true}));
}

TEST_F(WebDriver, MovesAMouseAWheelAndKeys) {
    browser().drag({10, 10}, {60, 40}, kShiftKey);
    EXPECT_THAT(seen(), ElementsAre("keydown Shift  shift", "pointerdown mouse 10,10 shift",
                                    "pointerup mouse 60,40 shift", "click mouse 60,40 shift"));
    browser().turn_wheel({20, 30}, 100);
    browser().wait_until("seen.length > 0", kPatience);  // the driver does not wait for a wheel's event
    EXPECT_THAT(seen(), ElementsAre("wheel  20,30"));
    browser().double_click({15, 15});
    EXPECT_THAT(seen(), testing::Contains("dblclick  15,15"));
    browser().press(kTabKey);
    browser().press("a");
    browser().press(kLeftKey, kShiftKey);
    EXPECT_THAT(seen(), ElementsAre("keydown Tab ", "keydown a ", "keydown Shift  shift",
                                    "keydown ArrowLeft  shift"));
}

TEST_F(WebDriver, TouchesWithOneFingerAndWithTwo) {
    browser().set_viewport({.width = 390, .height = 844, .touch = true});
    browser().touch_drag({10, 20}, {30, 40});
    EXPECT_THAT(seen(), testing::Contains("pointerdown touch 10,20"));
    browser().pinch({100, 50}, 20, 60);
    EXPECT_THAT(seen(), testing::IsSupersetOf({"pointerdown touch 80,50", "pointerdown touch 120,50"}));
}

TEST_F(WebDriver, ClicksWhatCanBeClickedAndSaysWhatLiesOverTheRest) {
    browser().click("#button");
    EXPECT_THAT(seen(), testing::Contains(testing::StartsWith("click")));
    EXPECT_THAT([&] { browser().click("#covered"); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("cover")));
}

TEST_F(WebDriver, TellsConsoleErrorsAndUncaughtExceptionsOfAllWindows) {
    browser().evaluate("console.log('fine')");
    EXPECT_THAT(browser().take_console_errors(), IsEmpty());
    browser().evaluate("console.error('one')");
    const std::string first = browser().window();
    browser().open_window();
    browser().open("file://" + files_.write("two.html", "<script>throw new Error('two')</script>"));
    browser().use_window(first);
    EXPECT_THAT(browser().take_console_errors(),
                testing::UnorderedElementsAre(HasSubstr("one"), HasSubstr("two")));
    EXPECT_THAT(browser().take_console_errors(), IsEmpty());
}

TEST_F(WebDriver, KeepsAScreenshotOfTheViewport) {
    browser().set_viewport({.width = 300, .height = 200, .pixel_ratio = 2});
    const std::filesystem::path file = files_.path_of("shot.png");
    browser().save_screenshot(file);
    const std::string bytes = contents(file);
    const auto picture = decode_png({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 600);
    EXPECT_EQ(picture->height, 400);
    // The red box is at the upper left.
    const std::size_t top_left =
        3 * static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height - 1);
    EXPECT_EQ(picture->rgb[top_left], 0xcc);
    EXPECT_EQ(picture->rgb[top_left + 2], 0);
}

TEST(Base64, IsDecodedAndWhatIsNoneIsRefused) {
    EXPECT_EQ(decode_base64(""), "");
    EXPECT_EQ(decode_base64("TQ=="), "M");
    EXPECT_EQ(decode_base64("TWE="), "Ma");
    EXPECT_EQ(decode_base64("TWFuTQ=="), "ManM");
    EXPECT_THROW(decode_base64("T*E="), std::runtime_error);
}

}  // namespace
}  // namespace swath::test
