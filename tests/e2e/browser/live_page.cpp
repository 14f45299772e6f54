#include "tests/e2e/browser/live_page.h"

#include <fmt/core.h>

#include <algorithm>

namespace swath::test {
namespace {

// True when the state has the newest wish, nothing is being changed, and the picture shows that state as PNG.
constexpr const char* kAtRest = R"js((() => {
    const state = swath.state;
    if (!state || state.busy) return false;
    if (swath.leads && !(state.by === swath.viewer && state.wish >= swath.wish?.id)) return false;
    const algorithms = state.against ? [state.algorithm, state.against] : [state.algorithm];
    return algorithms.every((algorithm, stream) => {
        const plan = swath.plan(stream);
        const canvas = document.getElementById(`picture-${stream}`);
        return canvas.dataset.format === 'png' && plan.algorithm === algorithm &&
            plan.servers === (state.servers ?? swath.session.servers.length) && plan.width === state.width && plan.height === state.height &&
            String(plan.camera) === String(state.camera);
    });
})())js";

// The page's main facts, for messages.
constexpr const char* kWhatIsThere = R"js(JSON.stringify({
    status: document.getElementById('status')?.textContent,
    picture: {...document.getElementById('picture-0')?.dataset},
    wish: window.swath?.wish, state: window.swath?.state, viewer: window.swath?.viewer, leads: window.swath?.leads,
}, null, 1))js";

}  // namespace

std::string page_address(Process& program) {
    static constexpr std::string_view kAnnouncement = "viewer ";
    return program.wait_for_line("viewer http://", kPatience).substr(kAnnouncement.size());
}

const std::string LivePage::kModel = "builtin:knot:20000";

std::string LivePage::start_client(const Arguments& arguments) {
    client_ = start("swath-client", Arguments{kModel} + arguments);
    return page_address(*client_);
}

void LivePage::end_client() {
    client_->signal(SIGTERM);
    client_->wait(kPatience);
    client_.reset();
}

void LivePage::TearDown() {
    leave_page();
    client_.reset();
    BrowserTest::TearDown();
}

void LivePage::open_page(const std::string& address) {
    browser().open(address);
    wait_for_rest();
}

void LivePage::start_view(const Viewport& viewport, const Arguments& arguments) {
    Arguments all{"--view", "0", "--objects", "200"};
    if (std::find(arguments.begin(), arguments.end(), "--local") == arguments.end())
        all = all + Arguments{"--local", "2"};
    browser().set_viewport(viewport);
    open_page(start_client(all + arguments));
}

void LivePage::wait_until(const std::string& condition) {
    try {
        browser().wait_until(condition, kPatience);
    } catch (const std::runtime_error& error) {
        const auto page = browser().evaluate(kWhatIsThere);
        throw std::runtime_error(fmt::format("{}\n{}", error.what(), page.get<std::string>()));
    }
}

void LivePage::wait_for_rest() {
    // The page sends its wishes before it draws its next animation frame.
    browser().evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
    wait_until(kAtRest);
}

void LivePage::wait_for_setup(const std::string& field, const nlohmann::json& value) {
    wait_until(
        fmt::format("swath.state.{} === {} && swath.plan(0).wish === swath.state.wish && swath.plan(0).by "
                    "=== swath.state.by",
                    field, value.dump()));
    wait_for_rest();
}

void LivePage::wait_for_window_size() {
    wait_until(
        "(() => { const box = document.getElementById('cell-0').getBoundingClientRect(); return [[box.width, "
        "swath.wish.width], [box.height, swath.wish.height]].every(([css, pixels]) => Math.abs(css * "
        "devicePixelRatio - pixels) < 1.5); })()");
    wait_for_rest();
}

LivePage::Drawn LivePage::drawn(int stream) {
    const auto got = browser().evaluate(
        "(async () => ({...await swath.picture(argument), plan: swath.plan(argument)}))()", stream);
    return {got.at("frame"),
            got.at("width"),
            got.at("height"),
            got.at("format"),
            decode_base64(got.at("base64").get<std::string>()),
            got.at("plan")};
}

std::string LivePage::reference(int width, int height) {
    const auto camera = browser().evaluate("swath.cameraText()").get<std::string>();
    const std::string file = files_.write("view.camera", camera);
    const std::string folder = render(
        {kModel, "--single", "--path", file, "--frames", "1", "--size", fmt::format("{}x{}", width, height),
         "--objects", std::to_string(state("objects").get<int>()), "--renderer", state("renderer")});
    return contents(std::filesystem::path(folder) / "frame_0000.png");
}

void LivePage::expect_exact() {
    wait_for_rest();
    const int streams = state("against").is_null() ? 1 : 2;
    std::string expected;
    for (int stream = 0; stream < streams; ++stream) {
        const Drawn picture = drawn(stream);
        EXPECT_EQ(picture.format, "png");
        if (expected.empty()) expected = reference(picture.width, picture.height);
        EXPECT_FALSE(expected.empty());
        EXPECT_TRUE(picture.bytes == expected)
            << "stream " << stream << ", frame " << picture.frame << " of " << picture.width << "x"
            << picture.height << " by " << picture.plan.value("algorithm", "?")
            << " is not what --single draws";
    }
}

Point LivePage::centre_of(const std::string& selector) {
    const auto at = browser().evaluate(
        "(() => { const box = document.querySelector(argument).getBoundingClientRect(); return [box.x + "
        "box.width / 2, box.y + box.height / 2]; })()",
        selector);
    return {at[0], at[1]};
}

void LivePage::drag_picture(double dx, double dy, const std::string& modifier_key) {
    const Point from = centre_of("#picture-0");
    browser().drag(from, {from.x + dx, from.y + dy}, modifier_key);
}

void LivePage::choose(const std::string& id, const std::string& value) {
    const auto kind =
        browser()
            .evaluate(
                "(() => { const e = document.getElementById(argument); return e.type || e.tagName; })()", id)
            .get<std::string>();
    if (kind == "select-one") {
        browser().click(fmt::format("#{} option[value='{}']", id, value));
        return;
    }
    browser().evaluate(
        "(() => { const e = document.getElementById(argument.id); e.value = argument.value; for (const type "
        "of "
        "['input', 'change']) e.dispatchEvent(new Event(type, {bubbles: true})); })()",
        {{"id", id}, {"value", value}});
}

void LivePage::press_down(const std::string& id, bool down) {
    const char* pressed = down ? "true" : "false";
    if (browser().evaluate("document.getElementById(argument).getAttribute('aria-pressed')", id) != pressed)
        browser().click("#" + id);
    wait_until(
        fmt::format("document.getElementById('{}').getAttribute('aria-pressed') === '{}'", id, pressed));
}

std::string LivePage::text_of(const std::string& id) {
    return browser().evaluate("document.getElementById(argument).textContent", id).get<std::string>();
}

}  // namespace swath::test
