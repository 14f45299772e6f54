#pragma once
#include <memory>
#include <string>

#include "tests/e2e/browser/browser_fixture.h"

namespace swath::test {

// Where a client or a display says that its page is.
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
        std::string bytes;  // of the file
        nlohmann::json plan;
    };

    static const std::string kModel;  // small

    // A live run of kModel with two servers on this machine; then the page, as `viewport` shows it, with the
    // first picture at rest. `arguments` for the client come on top; they may say --local.
    void start_view(const Viewport& viewport = {}, const Arguments& arguments = {});
    // Only the client, with these arguments and kModel; the page's address.
    std::string start_client(const Arguments& arguments);
    void end_client();
    void open_page(const std::string& address);

    // Until the condition holds; one that throws does not yet hold. A failure says what the page shows.
    void wait_until(const std::string& condition);
    // Until the last thing that the page asked for is drawn without loss, in every stream.
    void wait_for_rest();
    // ... with this choice of what no plan tells: objects, renderer, culling. It must be a new one.
    void wait_for_setup(const std::string& field, const nlohmann::json& value);
    // ... at the size that the window asks for.
    void wait_for_window_size();
    Drawn drawn(int stream = 0);
    // The file's bytes of `swath-client --single` for the camera that the page saves, with the objects and
    // the renderer that count, at this size.
    std::string reference(int width, int height);
    // At rest, every stream shows exactly what --single draws.
    void expect_exact();

    Point centre_of(const std::string& selector);
    void drag_picture(double dx, double dy, const std::string& modifier_key = {});
    // Sets a select or a range as a person would.
    void choose(const std::string& id, const std::string& value);
    // A button that stays pressed.
    void press_down(const std::string& id, bool down);
    nlohmann::json state(const std::string& field) { return browser().evaluate("swath.state." + field); }
    std::string text_of(const std::string& id);

    std::unique_ptr<Process> client_;
};

}  // namespace swath::test
