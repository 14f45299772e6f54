#pragma once
#include <memory>
#include <string>
#include <vector>

#include "common/image/picture.h"
#include "tests/e2e/browser/webdriver.h"
#include "tests/e2e/programs.h"

namespace swath::test {

// A browser and the programs. Skips where there is no browser. At the end of a test nothing may have been
// said on the console as an error, and no process may be left; a test that failed leaves a screenshot.
class BrowserTest : public EndToEnd {
  protected:
    void SetUp() override;
    void TearDown() override;

    Browser& browser() { return *browser_; }
    // What TearDown does first; for whoever ends what the page is connected with.
    void close_browser();
    // Keeps what the viewport shows as NAME.png in the build tree's browser-shots, and prints its path.
    void keep_screenshot(const std::string& name);
    // Of now on console errors with these words are no failure: those of a connection that a test breaks.
    void allow_console_errors(const std::string& words) { allowed_errors_.push_back(words); }

  private:
    std::unique_ptr<Browser> browser_;
    std::vector<std::string> allowed_errors_;
};

}  // namespace swath::test
