#pragma once
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace swath::test {

// The screen of a page. Sides are in CSS pixels.
struct Viewport {
    int width = 1280;
    int height = 800;
    double pixel_ratio = 1;
    bool dark = false;
    bool touch = false;  // a finger in place of a mouse
};

// CSS pixels from the viewport's upper left corner.
struct Point {
    double x = 0;
    double y = 0;
};

// Keys without a character, by their WebDriver numbers.
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
// at a time. "The page" is that of the window in use. Functions throw std::runtime_error with the driver's
// words when something fails or takes too long. The destructor ends the browser and the driver and waits
// until nothing of them is left. Not thread-safe.
class Browser {
  public:
    // Names missing programs, for a message; empty if a browser can be started.
    static std::string missing();
    // `folder` must exist and gets the profile.
    explicit Browser(const std::filesystem::path& folder);
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    std::string window();
    std::string open_window();  // and uses it
    void use_window(const std::string& handle);
    void close_window();                          // then use another
    void set_viewport(const Viewport& viewport);  // for the window in use
    void begin_anew();                            // with one new window, and without cookies
    void open(const std::string& url);

    // The value of a JavaScript expression in the page, awaited if it is a promise; `await` and
    // `argument` may be used in it.
    nlohmann::json evaluate(const std::string& expression, const nlohmann::json& argument = nullptr);
    // Waits until the expression is true. One that throws is not true yet.
    void wait_until(const std::string& condition, std::chrono::milliseconds limit);

    // Scrolls there and clicks; fails if something else lies over it.
    void click(const std::string& selector);
    void double_click(Point at);
    void move_mouse(Point to);
    void drag(Point from, Point to, const std::string& modifier_key = {});
    void turn_wheel(Point at, int pixels);
    void touch_drag(Point from, Point to);
    // Two fingers move from `begin` pixels right and left of `centre` to `end`.
    void pinch(Point centre, double begin, double end);
    // Presses a key for the focused element, while another is held down.
    void press(const std::string& key, const std::string& modifier_key = {});

    // Saves the viewport as a PNG.
    void save_screenshot(const std::filesystem::path& file);
    // Takes the console's errors, with uncaught exceptions and failed loads, of all windows since the last
    // call.
    std::vector<std::string> take_console_errors();
    // Calls a method of the DevTools protocol.
    nlohmann::json devtools(const std::string& method, const nlohmann::json& parameters);

  private:
    nlohmann::json request(const std::string& method, const std::string& path,
                           const nlohmann::json& body = nlohmann::json::object());
    nlohmann::json command(const std::string& method, const std::string& path,
                           const nlohmann::json& body = nlohmann::json::object());
    void act(const nlohmann::json& sources);

    Process driver_;
    std::string address_;  // the driver's
    std::string session_;
};

std::string decode_base64(std::string_view text);  // throws std::runtime_error for other text

}  // namespace swath::test
