#include "tests/e2e/browser/webdriver.h"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "tests/e2e/programs.h"
#include "tests/e2e/raw_peer.h"

namespace swath::test {
namespace {

using nlohmann::json;

constexpr const char* kPost = "POST";
constexpr const char* kMouse = "mouse";
constexpr int kDragMs = 200;

std::optional<std::filesystem::path> on_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        auto file = std::filesystem::path(folder) / program;
        if (::access(file.c_str(), X_OK) == 0) return file;
    }
    return std::nullopt;
}

// True if the response is as long as its head says. The driver does not close its end.
bool is_whole_response(std::string_view response) {
    static constexpr std::string_view kLength = "Content-Length:";
    const auto head = response.find("\r\n\r\n");
    if (head == std::string_view::npos) return false;
    const auto length = response.substr(0, head).find(kLength);
    if (length == std::string_view::npos) return true;
    const std::string number(response.substr(length + kLength.size(), head - length - kLength.size()));
    return response.size() >= head + 4 + std::strtoull(number.c_str(), nullptr, 10);
}

std::filesystem::path chromedriver() {
    const auto found = on_path("chromedriver");
    if (!found) throw std::runtime_error("no chromedriver on PATH");
    return *found;
}

Process::Options driver_options(const std::filesystem::path& folder) {
    return {{"XDG_CONFIG_HOME=" + (folder / "config").string(),
             "XDG_CACHE_HOME=" + (folder / "cache").string(), "TMPDIR=" + folder.string()},
            folder};
}

json pointer(const std::string& id, const std::string& kind, json actions) {
    return {{"type", "pointer"},
            {"id", id},
            {"parameters", {{"pointerType", kind}}},
            {"actions", std::move(actions)}};
}

json keyboard(json actions) { return {{"type", "key"}, {"id", "keyboard"}, {"actions", std::move(actions)}}; }

json move_to(Point to, int milliseconds) {
    return {{"type", "pointerMove"},
            {"duration", milliseconds},
            {"origin", "viewport"},
            {"x", static_cast<int>(to.x)},
            {"y", static_cast<int>(to.y)}};
}
json press_button() { return {{"type", "pointerDown"}, {"button", 0}}; }
json release_button() { return {{"type", "pointerUp"}, {"button", 0}}; }
json stroke(Point from, Point to) {
    return {move_to(from, 0), press_button(), move_to(to, kDragMs), release_button()};
}

}  // namespace

std::string Browser::missing() {
    for (const char* program : {"chromium", "chromedriver"})
        if (!on_path(program))
            return fmt::format("no {} on PATH (script/bootstrap --browser installs it)", program);
    return {};
}

Browser::Browser(const std::filesystem::path& folder)
    : driver_(chromedriver(), {"--port=0"}, driver_options(folder)) {
    const std::string line = driver_.wait_for_line("started successfully on port ", kPatience);
    const auto digits = line.substr(line.rfind(' ') + 1);
    address_ = fmt::format("127.0.0.1:{}", std::stoi(digits));
    // No sandbox, because containers and root have none; the pages are our own.
    const json options{{"binary", on_path("chromium").value_or("chromium").string()},
                       {"args",
                        {"--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--user-data-dir=" + (folder / "profile").string()}}};
    const json capabilities{{"goog:chromeOptions", options}, {"goog:loggingPrefs", {{"browser", "ALL"}}}};
    session_ = request(kPost, "/session", {{"capabilities", {{"alwaysMatch", capabilities}}}})
                   .at("sessionId")
                   .get<std::string>();
    command(kPost, "/timeouts", {{"script", 2 * kPatience.count()}, {"pageLoad", kPatience.count()}});
}

Browser::~Browser() {
    // The browser's crash handlers leave its family, so looks among all of our descendants.
    std::vector<pid_t> family;
    for (const pid_t pid : living_descendants(::getpid()))
        if (program_of(pid).starts_with("chrom")) family.push_back(pid);
    std::erase(family, driver_.pid());
    try {
        if (!session_.empty()) command("DELETE", "");
    } catch (const std::exception&) {
        // It is killed below. The fixture checks that nothing is left.
    }
    all_end_within(family, kPatience);
}

json Browser::request(const std::string& method, const std::string& path, const json& body) {
    const std::string text = method == kPost ? body.dump() : "";
    const RawConnection connection(address_);
    connection.send(
        fmt::format("{} {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n"
                    "Content-Type: application/json\r\nContent-Length: {}\r\n\r\n{}",
                    method, path, address_, text.size(), text));
    const std::string response = connection.read_until(is_whole_response, 3 * kPatience);
    const auto head = response.find("\r\n\r\n");
    const json answer =
        json::parse(head == std::string::npos ? "" : response.substr(head + 4), nullptr, false);
    if (!answer.is_object() || !answer.contains("value"))
        throw std::runtime_error(fmt::format("{} {}: no answer of a WebDriver: {}", method, path, response));
    const json& value = answer["value"];
    if (!response.starts_with("HTTP/1.1 200"))
        throw std::runtime_error(
            fmt::format("{} {} {}: {}", method, path, text.substr(0, 300), value.value("message", response)));
    return value;
}

json Browser::command(const std::string& method, const std::string& path, const json& body) {
    return request(method, "/session/" + session_ + path, body);
}

std::string Browser::window() { return command("GET", "/window").get<std::string>(); }

std::string Browser::open_window() {
    auto handle = command(kPost, "/window/new", {{"type", "window"}}).at("handle").get<std::string>();
    use_window(handle);
    return handle;
}

void Browser::use_window(const std::string& handle) { command(kPost, "/window", {{"handle", handle}}); }

void Browser::close_window() { command("DELETE", "/window"); }

void Browser::begin_anew() {
    const json old = command("GET", "/window/handles");
    const std::string fresh = open_window();
    for (const json& handle : old) {
        use_window(handle.get<std::string>());
        close_window();
    }
    use_window(fresh);
    devtools("Network.clearBrowserCookies", json::object());
}

json Browser::devtools(const std::string& method, const json& parameters) {
    return command(kPost, "/goog/cdp/execute", {{"cmd", method}, {"params", parameters}});
}

void Browser::set_viewport(const Viewport& viewport) {
    devtools("Emulation.setDeviceMetricsOverride", {{"width", viewport.width},
                                                    {"height", viewport.height},
                                                    {"deviceScaleFactor", viewport.pixel_ratio},
                                                    {"mobile", viewport.touch}});
    devtools("Emulation.setTouchEmulationEnabled", {{"enabled", viewport.touch}, {"maxTouchPoints", 5}});
    const json scheme{{"name", "prefers-color-scheme"}, {"value", viewport.dark ? "dark" : "light"}};
    devtools("Emulation.setEmulatedMedia", {{"features", json::array({scheme})}});
}

void Browser::open(const std::string& url) { command(kPost, "/url", {{"url", url}}); }

json Browser::evaluate(const std::string& expression, const json& argument) {
    return command(kPost, "/execute/sync",
                   {{"script", "return (async (argument) => (" + expression + "))(arguments[0])"},
                    {"args", json::array({argument})}});
}

void Browser::wait_until(const std::string& condition, std::chrono::milliseconds limit) {
    static constexpr const char* kPoll = R"js(new Promise((done) => {
        const deadline = performance.now() + argument;
        const poll = async () => {
            let holds = false;
            try { holds = Boolean(CONDITION); } catch { }
            if (holds || performance.now() > deadline) done(holds);
            else setTimeout(poll, 10);
        };
        poll();
    }))js";
    std::string poll = kPoll;
    poll.replace(poll.find("CONDITION"), std::string_view("CONDITION").size(), condition);
    if (!evaluate(poll, limit.count()).get<bool>())
        throw std::runtime_error(fmt::format("within {} ms not true: {}", limit.count(), condition));
}

void Browser::click(const std::string& selector) {
    const json element = command(kPost, "/element", {{"using", "css selector"}, {"value", selector}});
    command(kPost, "/element/" + element.begin().value().get<std::string>() + "/click");
}

void Browser::act(const json& sources) {
    command(kPost, "/actions", {{"actions", sources}});
    command("DELETE", "/actions");
}

void Browser::move_mouse(Point to) {
    act(json::array({pointer(kMouse, "mouse", json::array({move_to(to, kDragMs)}))}));
}

void Browser::double_click(Point at) {
    const json actions{move_to(at, 0), press_button(), release_button(), press_button(), release_button()};
    act(json::array({pointer(kMouse, "mouse", actions)}));
}

void Browser::drag(Point from, Point to, const std::string& modifier_key) {
    // All sources act in steps: the key goes down before the button.
    json actions = stroke(from, to);
    json sources = json::array();
    if (!modifier_key.empty()) {
        actions.insert(actions.begin(), json::object({{"type", "pause"}}));
        sources.push_back(
            keyboard(json::array({json::object({{"type", "keyDown"}, {"value", modifier_key}})})));
    }
    sources.push_back(pointer(kMouse, "mouse", actions));
    act(sources);
}

void Browser::turn_wheel(Point at, int pixels) {
    const json turn{{"type", "scroll"},
                    {"origin", "viewport"},
                    {"x", static_cast<int>(at.x)},
                    {"y", static_cast<int>(at.y)},
                    {"deltaX", 0},
                    {"deltaY", pixels},
                    {"duration", 0}};
    act(json::array({{{"type", "wheel"}, {"id", "wheel"}, {"actions", json::array({turn})}}}));
}

void Browser::touch_drag(Point from, Point to) {
    act(json::array({pointer("finger", "touch", stroke(from, to))}));
}

void Browser::pinch(Point centre, double begin, double end) {
    const auto finger = [&](const char* id, double side) {
        return pointer(id, "touch",
                       stroke({centre.x + side * begin, centre.y}, {centre.x + side * end, centre.y}));
    };
    act(json::array({finger("left finger", -1), finger("right finger", 1)}));
}

void Browser::press(const std::string& key, const std::string& modifier_key) {
    json actions = json::array();
    for (const std::string& k : {modifier_key, key})
        if (!k.empty()) actions.push_back({{"type", "keyDown"}, {"value", k}});
    for (const std::string& k : {key, modifier_key})
        if (!k.empty()) actions.push_back({{"type", "keyUp"}, {"value", k}});
    act(json::array({keyboard(actions)}));
}

void Browser::save_screenshot(const std::filesystem::path& file) {
    std::filesystem::create_directories(file.parent_path());
    const std::string bytes = decode_base64(command("GET", "/screenshot").get<std::string>());
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::vector<std::string> Browser::take_console_errors() {
    std::vector<std::string> errors;
    for (const json& entry : command(kPost, "/se/log", {{"type", "browser"}}))
        if (entry.at("level") == "SEVERE") errors.push_back(entry.at("message").get<std::string>());
    return errors;
}

std::string decode_base64(std::string_view text) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    while (text.ends_with('=')) text.remove_suffix(1);
    for (const char c : text) {
        const auto digit = kDigits.find(c);
        if (digit == std::string_view::npos) throw std::runtime_error("not base64");
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

}  // namespace swath::test
