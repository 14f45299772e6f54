#include "tests/e2e/browser/browser_fixture.h"

#include <algorithm>
#include <iostream>

namespace swath::test {

void BrowserTest::SetUp() {
    if (const std::string missing = Browser::missing(); !missing.empty()) GTEST_SKIP() << missing;
    const std::filesystem::path folder = files_.path_of("browser");
    std::filesystem::create_directory(folder);
    browser_ = std::make_unique<Browser>(folder);
    browser_->set_viewport({});
}

void BrowserTest::close_browser() {
    if (browser_) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        if (HasFailure())
            keep_screenshot(std::string("failed_") + test->test_suite_name() + "." + test->name());
        for (const std::string& error : browser_->take_console_errors())
            EXPECT_TRUE(
                std::any_of(allowed_errors_.begin(), allowed_errors_.end(),
                            [&](const auto& words) { return error.find(words) != std::string::npos; }))
                << "on the browser's console: " << error;
    }
    browser_.reset();
}

void BrowserTest::TearDown() {
    close_browser();
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
