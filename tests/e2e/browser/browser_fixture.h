#pragma once
#include <memory>
#include <string>
#include <vector>

#include "common/image/picture.h"
#include "tests/e2e/browser/webdriver.h"
#include "tests/e2e/programs.h"

namespace swath::test {

// A browser, which the tests of a suite use one after another, and the programs. Skips if there is no
// browser. At the end of a test the console may have no error, and no process may be left but the browser; a
// failed test leaves a screenshot, and the next one gets another browser.
class BrowserTest : public EndToEnd {
  protected:
    void SetUp() override;
    void TearDown() override;
    static void TearDownTestSuite();

    Browser& browser() { return *browser_; }
    // Leaves the page, as TearDown does first; for tests that end the page's program.
    void leave_page();
    // Keeps the viewport as NAME.png in the build tree's browser-shots, and prints its path.
    void keep_screenshot(const std::string& name);
    // From now on console errors with these words are no failure: a test that breaks a connection causes
    // some.
    void allow_console_errors(const std::string& words) { allowed_errors_.push_back(words); }

  private:
    static std::unique_ptr<TemporaryFolder> browser_files_;
    static std::unique_ptr<Browser> browser_;
    bool on_page_ = false;
    std::vector<std::string> allowed_errors_;
};

}  // namespace swath::test
