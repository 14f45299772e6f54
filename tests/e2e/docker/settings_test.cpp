// Every setting of the compose files is in .env and in the README, with its real default.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>

namespace swath::test {
namespace {

std::string text_of(const std::string& name) {
    std::ifstream stream(SWATH_SOURCE_DIR "/docker/" + name);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::map<std::string, std::string> settings() {
    const std::string text = text_of("compose.yaml") + text_of("compose.paper.yaml");
    static const std::regex kUse(R"(\$\{(SWATH_\w+):-([^}]*)\})");
    std::map<std::string, std::string> found;
    for (std::sregex_iterator use(text.begin(), text.end(), kUse), end; use != end; ++use) {
        const auto [place, is_new] = found.emplace((*use)[1], (*use)[2]);
        EXPECT_EQ(place->second, (*use)[2]) << place->first << " has two defaults";
    }
    return found;
}

TEST(DockerSettings, AreDocumentedWithTheirDefaults) {
    const std::string env = text_of(".env");
    const std::string readme = text_of("README.md");
    EXPECT_GT(settings().size(), 5u);
    for (const auto& [name, value] : settings()) {
        EXPECT_THAT(env, testing::HasSubstr("\n#" + name + "=" + value + "\n"));
        EXPECT_THAT(readme, testing::HasSubstr("| `" + name + "` | `" + value + "` |"));
    }
}

TEST(DockerSettings, OfTheFileAreUsed) {
    const std::string env = text_of(".env");
    const auto used = settings();
    static const std::regex kSetting(R"(#?(SWATH_\w+)=)");
    for (std::sregex_iterator setting(env.begin(), env.end(), kSetting), end; setting != end; ++setting)
        EXPECT_TRUE(used.contains((*setting)[1])) << (*setting)[1];
}

}  // namespace
}  // namespace swath::test
