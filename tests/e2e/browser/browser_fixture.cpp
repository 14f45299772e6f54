#include "tests/e2e/browser/browser_fixture.h"

#include <algorithm>
#include <iostream>

namespace swath::test {

std::unique_ptr<TemporaryFolder> BrowserTest::browser_files_;
std::unique_ptr<Browser> BrowserTest::browser_;

void BrowserTest::SetUp() {
    if (const std::string missing = Browser::missing(); !missing.empty()) GTEST_SKIP() << missing;
    outlasting_ = "chrom";
    if (browser_) {
        browser_->begin_anew();
    } else {
        browser_files_ = std::make_unique<TemporaryFolder>();
        const std::filesystem::path folder = browser_files_->path_of("browser");
        std::filesystem::create_directory(folder);
        browser_ = std::make_unique<Browser>(folder);
    }
    on_page_ = true;
    browser_->set_viewport({});
}

void BrowserTest::TearDownTestSuite() {
    browser_.reset();
    browser_files_.reset();
}

void BrowserTest::leave_page() {
    if (on_page_) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        if (HasFailure())
            keep_screenshot(std::string("failed_") + test->test_suite_name() + "." + test->name());
        for (const std::string& error : browser_->take_console_errors())
            EXPECT_TRUE(
                std::any_of(allowed_errors_.begin(), allowed_errors_.end(),
                            [&](const auto& words) { return error.find(words) != std::string::npos; }))
                << "on the browser's console: " << error;
    }
    if (on_page_) browser().open("about:blank");
    on_page_ = false;
}

void BrowserTest::TearDown() {
    leave_page();
    if (HasFailure()) TearDownTestSuite();
    EndToEnd::TearDown();
}

void BrowserTest::keep_screenshot(const std::string& name) {
    std::string file = name;
    std::replace(file.begin(), file.end(), '/', '_');
    const auto path = std::filesystem::path(SWATH_BROWSER_SHOTS) / (file + ".png");
    browser().save_screenshot(path);
    std::cout << "screenshot " << path.string() << '\n';
}

}  // namespace swath::test
