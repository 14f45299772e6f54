// The page's look for everybody: sizes, colour schemes, keys, accessibility.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

#include "tests/e2e/browser/live_page.h"

namespace swath::test {
namespace {

using nlohmann::json;
using testing::IsEmpty;

struct Look {
    std::string name;
    Viewport viewport;
};
void PrintTo(const Look& look, std::ostream* out) { *out << look.name; }

const std::vector<Look> kLooks{
    {"Laptop", {.width = 1280, .height = 800}},
    {"Desktop", {.width = 1920, .height = 1080}},
    {"Phone", {.width = 390, .height = 844, .pixel_ratio = 2, .touch = true}},
};

// Finds faults of the layout, as sentences. Runs in the page.
constexpr const char* kLayoutFaults = R"js((() => {
    const faults = [];
    const name = (e) => `<${e.tagName.toLowerCase()}${e.id ? ` id=${e.id}` : ''}> ` +
        `"${(e.textContent || e.value || '').trim().slice(0, 30)}"`;
    const root = document.documentElement;
    if (root.scrollWidth > innerWidth) faults.push(`the page is ${root.scrollWidth} wide, the window ${innerWidth}`);

    // For screen readers only, or closed.
    const unseen = (e) => !e.checkVisibility({visibilityProperty: true, contentVisibilityAuto: true}) ||
        e.closest('.hidden, [hidden], dialog:not([open])') !== null;
    const scrolls = (e) => e && e !== root && e !== document.body &&
        (/auto|scroll/.test(getComputedStyle(e).overflowX) ? e : scrolls(e.parentElement));

    // Text is within the window and not cut off.
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const e = walker.currentNode.parentElement;
        if (!walker.currentNode.data.trim() || unseen(e)) continue;
        if (e.closest('script, noscript, option, textarea, svg')) continue;
        const range = document.createRange();
        range.selectNodeContents(walker.currentNode);
        const box = range.getBoundingClientRect();
        let clipped = scrolls(e);
        for (let a = e; a && a !== document.body; a = a.parentElement) {
            const style = getComputedStyle(a);
            const inner = a.getBoundingClientRect();
            // An ellipsis says that something is missing, and the title has it.
            if (style.textOverflow === 'ellipsis' && a.closest('[title]')) {
                clipped = true;
                break;
            }
            if (/hidden|clip/.test(style.overflowX) && (box.left < inner.left - 1 || box.right > inner.right + 1)) {
                faults.push(`${name(e)} is cut off by ${name(a)}`);
                clipped = true;
                break;
            }
            if (/auto|scroll/.test(style.overflowX)) break;
        }
        if (!clipped && (box.left < -1 || box.right > innerWidth + 1)) faults.push(`${name(e)} leaves the window`);
    }

    // Controls can be reached with a pointer and do not overlap.
    const controls = [...document.querySelectorAll('button, select, input, textarea, summary, canvas[tabindex]')]
        .filter((e) => !unseen(e));
    for (const e of controls) {
        e.scrollIntoView({block: 'nearest'});
        const box = e.getBoundingClientRect();
        if (box.width < 16 || box.height < 16) faults.push(`${name(e)} is ${box.width} x ${box.height}`);
        const hit = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
        const over_picture = e.id.startsWith('picture-') && hit?.closest('.cell') === e.closest('.cell');
        if (!hit || !(e.contains(hit) || hit.contains(e) && hit.tagName === 'LABEL' || over_picture))
            faults.push(`${name(e)} lies under ${hit ? name(hit) : 'nothing: outside the window'}`);
    }
    scrollTo(0, 0);
    for (const [i, a] of controls.entries())
        for (const b of controls.slice(i + 1)) {
            const p = a.getBoundingClientRect(), q = b.getBoundingClientRect();
            const across = Math.min(p.right, q.right) - Math.max(p.left, q.left);
            const down = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
            if (across > 1 && down > 1 && !scrolls(a) && !scrolls(b)) faults.push(`${name(a)} overlaps ${name(b)}`);
        }
    return faults;
})())js";

class LiveLayout : public LivePage, public testing::WithParamInterface<Look> {
  protected:
    // Fills every part of the page: frames, predictions, a measured speed-up.
    void start_full_view() {
        start_view(GetParam().viewport, {"--local", "3"});
        browser().click("#measure");
        wait_until(
            "!document.getElementById('measure').disabled && "
            "document.querySelectorAll('#curve-table tbody tr').length === 3");
        choose("path", "orbit");
        wait_until("document.querySelectorAll('#predictions tbody tr').length > 1");
        choose("path", "");
        wait_for_window_size();
        browser().evaluate("scrollTo(0, 0)");
    }
    // Looks for faults of layout and accessibility in both colour schemes, and keeps a screenshot of each. What
    // lies under a dialog is no fault.
    void expect_flawless(const std::string& part, bool dialog = false) {
        for (const bool dark : {false, true}) {
            const std::string name = GetParam().name + (dark ? "Dark" : "Light") + part;
            Viewport viewport = GetParam().viewport;
            viewport.dark = dark;
            browser().set_viewport(viewport);
            wait_until("document.getAnimations().length === 0");  // colours change by and by
            if (!dialog) {
                EXPECT_THAT(faults(), IsEmpty()) << name;
            }
            EXPECT_THAT(violations(), IsEmpty()) << name;
            keep_screenshot("page_" + name);
        }
    }

    const std::string axe_ = contents(SWATH_AXE);

  private:
    std::vector<std::string> faults() { return browser().evaluate(kLayoutFaults); }
    // What axe-core finds; nothing without it.
    std::vector<std::string> violations() {
        if (axe_.empty()) return {};
        return browser().evaluate(
            "(await axe.run()).violations.map(({id, help, nodes}) => `${id}: ${help}: ${nodes.map(({target}) "
            "=> target).join('; ')}`)");
    }
};

TEST_P(LiveLayout, IsAccessibleAndNothingIsCutOffOrOverlaps) {
    start_full_view();
    if (!axe_.empty()) browser().evaluate("eval(argument)", axe_);
    expect_flawless("");
    press_down("show-tiles", true);
    press_down("show-swaths", true);
    choose("against", "mahd");
    wait_for_window_size();
    expect_flawless("_side_by_side");
    browser().click("#help");
    wait_until("document.getElementById('help-dialog').open");
    EXPECT_EQ(browser().evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
    expect_flawless("_help", true);
    browser().press(kEscapeKey);
    wait_until("!document.getElementById('help-dialog').open");
    expect_exact();
    if (axe_.empty()) GTEST_SKIP() << "no axe-core (script/bootstrap --dev installs it where npm is)";
}

INSTANTIATE_TEST_SUITE_P(, LiveLayout, testing::ValuesIn(kLooks),
                         [](const auto& look) { return look.param.name; });

class LiveKeys : public LivePage {
  protected:
    struct Focus {
        std::string name;
        bool visible = false;
    };
    Focus focus() {
        const json at = browser().evaluate(R"js((() => {
            const e = document.activeElement, style = getComputedStyle(e);
            const outlined = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) > 0;
            return [window.names(e), outlined || style.boxShadow !== 'none'];
        })())js");
        return {at[0], at[1]};
    }
};

TEST_F(LiveKeys, TabReachesEveryControlWithVisibleFocus) {
    start_view();
    const json expected = browser().evaluate(R"js((() => {
        const can = [...document.querySelectorAll('button, select, input, textarea, summary, [tabindex="0"]')]
            .filter((e) => !e.disabled && e.checkVisibility() && !e.closest('dialog:not([open])'));
        window.names = (e) => e.id || `${e.tagName} ${can.indexOf(e)}`;
        return can.map(names);
    })())js");
    std::set<std::string> reached;
    for (std::size_t i = 0; i < expected.size() + 20; ++i) {
        browser().press(kTabKey);
        const Focus at = focus();
        if (at.name.starts_with("BODY")) continue;
        EXPECT_TRUE(at.visible) << at.name << " has the focus and does not show it";
        reached.insert(at.name);
    }
    for (const json& name : expected) EXPECT_TRUE(reached.contains(name)) << name << " is not reached";
}

TEST_F(LiveKeys, ArrowsSteerAndKeysSwitchWithoutAMouse) {
    start_view();
    browser().evaluate("document.getElementById('picture-0').focus()");
    const json before = drawn().plan.at("camera");
    for (const std::string& key : {kLeftKey, kUpKey}) browser().press(key);
    wait_for_rest();
    EXPECT_NE(drawn().plan.at("camera"), before);
    expect_exact();
    browser().press("t");
    EXPECT_EQ(browser().evaluate("document.getElementById('show-tiles').getAttribute('aria-pressed')"),
              "true");
    browser().press("?");
    wait_until("document.getElementById('help-dialog').open");
    browser().press(kEnterKey);
    wait_until("!document.getElementById('help-dialog').open");
}

}  // namespace
}  // namespace swath::test
