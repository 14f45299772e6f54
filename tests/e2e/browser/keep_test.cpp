// Downloads from the page.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <sstream>

#include "tests/e2e/browser/live_page.h"

namespace swath::test {
namespace {

using nlohmann::json;

class LiveKeep : public LivePage {
  protected:
    void start_view_with_downloads() {
        start_view();
        std::filesystem::create_directory(downloads_);
        browser().devtools("Browser.setDownloadBehavior",
                           {{"behavior", "allow"}, {"downloadPath", downloads_}});
    }
    // The file that a click saves. A file that is not complete has another name.
    std::filesystem::path saved_by(const std::string& button, const std::string& extension) {
        browser().click("#" + button);
        const auto deadline = std::chrono::steady_clock::now() + kPatience;
        while (std::chrono::steady_clock::now() < deadline) {
            for (const std::string& name : file_names(downloads_))
                if (name.ends_with(extension)) return std::filesystem::path(downloads_) / name;
            browser().evaluate("new Promise((done) => setTimeout(done, 10))");
        }
        throw std::runtime_error(button + " saves nothing");
    }
    const std::string downloads_ = files_.path_of("downloads");
};

TEST_F(LiveKeep, TheFrameIsSavedAsItIsShown) {
    start_view_with_downloads();
    drag_picture(70, 30);
    wait_for_rest();
    EXPECT_TRUE(contents(saved_by("save-frame", ".png")) == drawn().bytes);
}

TEST_F(LiveKeep, TheCommandAndTheCameraDrawTheSamePicture) {
    start_view_with_downloads();
    choose("algorithm", "sort-last");
    drag_picture(70, 30);
    wait_for_rest();
    const std::filesystem::path camera = saved_by("save-camera", ".camera");
    EXPECT_EQ(camera.filename(), "view.camera");
    EXPECT_EQ(browser().evaluate("swath.cameraText()"), contents(camera));

    const auto command = browser().evaluate("document.getElementById('command').value").get<std::string>();
    EXPECT_EQ(state("command"), command);
    EXPECT_THAT(command, testing::HasSubstr("--algorithm sort-last"));
    std::istringstream words(command);
    std::string program;
    words >> program;
    EXPECT_EQ(program, "swath-client");
    Arguments arguments;
    for (std::string word; words >> word;) {
        if (word == "--out")
            words >> word;
        else
            arguments.push_back(word == "view.camera" ? camera.string() : word);
    }
    const std::string folder = render(arguments);
    EXPECT_TRUE(contents(std::filesystem::path(folder) / "frame_0000.png") == drawn().bytes) << command;
}

TEST_F(LiveKeep, TheTimelineIsSavedInTheTraceEventFormat) {
    start_view_with_downloads();
    drag_picture(70, 30);
    wait_for_rest();
    const json trace = json::parse(contents(saved_by("save-timeline", ".json")), nullptr, false);
    ASSERT_TRUE(trace.contains("traceEvents"));
    EXPECT_GT(trace["traceEvents"].size(), 10u);
}

TEST_F(LiveKeep, TheCommandIsCopied) {
    start_view();
    browser().devtools("Browser.grantPermissions",
                       {{"permissions", {"clipboardReadWrite", "clipboardSanitizedWrite"}}});
    browser().click("#copy-command");
    wait_until("await navigator.clipboard.readText() === swath.state.command");
}

}  // namespace
}  // namespace swath::test
