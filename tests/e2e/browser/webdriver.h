#pragma once
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace swath::test {

// What a page is shown on. Sides are in CSS pixels.
struct Viewport {
    int width = 1280;
    int height = 800;
    double pixel_ratio = 1;
    bool dark = false;
    bool touch = false;  // a finger in place of a mouse
};

// In CSS pixels from the viewport's upper left corner.
struct Point {
    double x = 0;
    double y = 0;
};

// Keys that have no character, as WebDriver names them.
inline const std::string kTabKey = "\uE004";
inline const std::string kEnterKey = "\uE007";
inline const std::string kShiftKey = "\uE008";
inline const std::string kEscapeKey = "\uE00C";
inline const std::string kHomeKey = "\uE011";
inline const std::string kLeftKey = "\uE012";
inline const std::string kUpKey = "\uE013";
inline const std::string kRightKey = "\uE014";
inline const std::string kDownKey = "\uE015";

// A headless Chromium with a new profile, driven through chromedriver by the WebDriver protocol; at most one
// at a time. What is said of "the page" is about the window in use. Not thread-safe. Functions throw
// std::runtime_error with the driver's words when something fails or takes too long. The destructor ends the
// browser and the driver and waits until nothing of them is left.
class Browser {
  public:
    // What is not installed, for a message; empty when a browser can be started.
    static std::string missing();
    // The profile is made in `folder`, which exists.
    explicit Browser(const std::filesystem::path& folder);
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    std::string window();
    std::string open_window();  // and use it
    void use_window(const std::string& handle);
    void close_window();                          // then another is to be used
    void set_viewport(const Viewport& viewport);  // of the window in use
    void open(const std::string& url);

    // The value of a JavaScript expression in the page, awaited if it is a promise; `await` and
    // `argument` may be used in it.
    nlohmann::json evaluate(const std::string& expression, const nlohmann::json& argument = nullptr);
    // Until the expression is true. One that throws is not true yet.
    void wait_until(const std::string& condition, std::chrono::milliseconds limit);

    // Scrolls there and clicks; fails when something else lies over it.
    void click(const std::string& selector);
    void double_click(Point at);
    void move_mouse(Point to);
    void drag(Point from, Point to, const std::string& modifier_key = {});
    void turn_wheel(Point at, int pixels);
    void touch_drag(Point from, Point to);
    // Two fingers, at first `begin` pixels right and left of `centre` and in the end `end`.
    void pinch(Point centre, double begin, double end);
    // To what has the focus, with another key held down.
    void press(const std::string& key, const std::string& modifier_key = {});

    // A PNG of what the viewport shows.
    void save_screenshot(const std::filesystem::path& file);
    // What was said on the console as an error, uncaught exceptions and failed loads included, in all windows
    // since the last call.
    std::vector<std::string> take_console_errors();
    // What the page says as a method of the DevTools protocol.
    nlohmann::json devtools(const std::string& method, const nlohmann::json& parameters);

  private:
    nlohmann::json request(const std::string& method, const std::string& path,
                           const nlohmann::json& body = nlohmann::json::object());
    nlohmann::json command(const std::string& method, const std::string& path,
                           const nlohmann::json& body = nlohmann::json::object());
    void act(const nlohmann::json& sources);

    Process driver_;
    std::string address_;  // of the driver
    std::string session_;
};

std::string decode_base64(std::string_view text);  // throws std::runtime_error for what is none

}  // namespace swath::test
