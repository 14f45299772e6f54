#pragma once
#include <memory>
#include <string>

#include "tests/e2e/browser/browser_fixture.h"

namespace swath::test {

// The address of the page, from the program's output.
std::string page_address(Process& program);

// A live run of the real programs and its page in a browser. `window.swath` and the ids that this uses are
// the page's hooks for tests (display/web/README.md).
class LivePage : public BrowserTest {
  protected:
    void TearDown() override;

    // A picture as the page drew it, and its plan.
    struct Drawn {
        int frame = 0;
        int width = 0;
        int height = 0;
        std::string format;
        std::string bytes;  // the file's
        nlohmann::json plan;
    };

    static const std::string kModel;  // small

    // Starts a live run of kModel with two servers on this machine, and opens the page in `viewport` with the
    // first picture at rest. `arguments` for the client are added; they may have --local.
    void start_view(const Viewport& viewport = {}, const Arguments& arguments = {});
    // Starts only the client, with these arguments and kModel; returns the page's address.
    std::string start_client(const Arguments& arguments);
    void end_client();
    void open_page(const std::string& address);

    // Waits until the condition is true; one that throws is not true yet. A failure prints the page's state.
    void wait_until(const std::string& condition);
    // Waits until the page's last wish is drawn as PNG, in every stream.
    void wait_for_rest();
    // Waits likewise for a new value of something that no plan has: objects, renderer, culling.
    void wait_for_setup(const std::string& field, const nlohmann::json& value);
    // Waits likewise for a picture of the window's size.
    void wait_for_window_size();
    Drawn drawn(int stream = 0);
    // The PNG of `swath-client --single` for the camera that the page saves, with the run's objects and
    // renderer, at this size.
    std::string reference(int width, int height);
    // Expects that at rest every stream shows the picture of --single.
    void expect_exact();

    Point centre_of(const std::string& selector);
    void drag_picture(double dx, double dy, const std::string& modifier_key = {});
    // Sets a select or a range as a person would.
    void choose(const std::string& id, const std::string& value);
    // Presses or releases a button that stays pressed.
    void press_down(const std::string& id, bool down);
    nlohmann::json state(const std::string& field) { return browser().evaluate("swath.state." + field); }
    std::string text_of(const std::string& id);

    std::unique_ptr<Process> client_;
};

}  // namespace swath::test
