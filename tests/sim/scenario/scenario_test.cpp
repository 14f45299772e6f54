#include "sim/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/hardware/profile.h"
#include "tests/support/models.h"

namespace swath::sim {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

ScenarioOptions small() {
    ScenarioOptions options;
    options.models = {{"knot", "builtin:knot:300"}};
    options.algorithms = {Algorithm::kHybrid};
    options.servers = {2};
    options.hardware = {"paper-2000"};
    options.sizes = {{64, 48}};
    options.granularities = {{2, 0}};
    options.path.frames = 2;
    return options;
}

std::string error_of(const ScenarioOptions& options) {
    const auto scenario = Scenario::load(options);
    return scenario ? "no error" : scenario.error().message;
}

std::vector<std::string> labels_of(const ScenarioOptions& options) {
    const auto scenario = Scenario::load(options);
    if (!scenario) return {scenario.error().message};
    std::vector<std::string> labels;
    for (const Experiment& e : scenario->experiments())
        labels.push_back(fmt::format("{}, {}, {}", e.model_name, e.algorithm_name, e.servers));
    return labels;
}

std::vector<std::string> settings_of(const ScenarioOptions& options) {
    const auto scenario = Scenario::load(options);
    EXPECT_TRUE(scenario) << scenario.error().message;
    return scenario ? scenario->settings() : std::vector<std::string>{};
}

class ScenarioFiles : public testing::Test {
  protected:
    // The paper's profile with another price of a polygon.
    std::string profile(const std::string& name, const std::string& polygon) const {
        std::string text(find_builtin("paper-2000")->toml);
        const std::string_view before = "1.33 us/polygon";
        return files_.write(name, text.replace(text.find(before), before.size(), polygon));
    }
    swath::test::TemporaryFolder files_;
};

TEST(Scenario, CombinesEverythingAndLabelsWhatThereIsSeveralOf) {
    EXPECT_THAT(labels_of(small()), ElementsAre("knot, hybrid, 2"));

    ScenarioOptions options = small();
    options.algorithms.push_back(Algorithm::kSortLast);
    options.servers.push_back(4);
    EXPECT_THAT(labels_of(options), ElementsAre("knot, hybrid, 2", "knot, hybrid, 4", "knot, sort-last, 2",
                                                "knot, sort-last, 4"));

    options = small();
    options.sizes.push_back({32, 24});
    options.granularities.push_back({3, 0});
    EXPECT_THAT(labels_of(options),
                ElementsAre("knot (depth 2, 64x48), hybrid, 2", "knot (depth 3, 64x48), hybrid, 2",
                            "knot (depth 2, 32x24), hybrid, 2", "knot (depth 3, 32x24), hybrid, 2"));
}

TEST(Scenario, HasAGranularityOnceThatIsAskedForInTwoWays) {
    ScenarioOptions options = small();
    options.granularities = {{2, 0}, {2, 0}};
    EXPECT_THAT(labels_of(options), ElementsAre("knot, hybrid, 2"));
    options.granularities = {{std::nullopt, 100}, {std::nullopt, 101}, {std::nullopt, 1}};
    EXPECT_EQ(labels_of(options).size(), 2u);
}

TEST_F(ScenarioFiles, LabelsProfilesAndRefusesTwoOfOneName) {
    ScenarioOptions options = small();
    options.hardware = {"paper-2000", profile("fast.toml", "1 us/polygon")};
    EXPECT_THAT(labels_of(options), ElementsAre("knot (paper-2000), hybrid, 2", "knot (fast), hybrid, 2"));
    options.hardware.push_back(profile("paper-2000.toml", "1 us/polygon"));
    EXPECT_EQ(error_of(options), "--hardware: two profiles are called 'paper-2000'");
}

TEST(Scenario, RefusesLabelsThatBecomeTheSame) {
    ScenarioOptions options = small();
    options.granularities.push_back({3, 0});
    options.models = {{"knot", "builtin:knot:300"}, {"town", "builtin:town:300"}};
    EXPECT_EQ(labels_of(options).size(), 4u);
    // No flag gives two models one name, but "a (depth 2)" may be the name of one and the label of another.
    options.models = {{"knot", "builtin:knot:300"}};
    ScenarioOptions clash = options;
    clash.models.push_back({"knot", "builtin:town:300"});
    EXPECT_EQ(error_of(clash), "two models would be called 'knot (depth 2)': give them other names");
}

TEST(Scenario, NamesWhatCannotBeLoaded) {
    ScenarioOptions options = small();
    options.hardware = {"cray-1"};
    EXPECT_THAT(error_of(options), AllOf(HasSubstr("--hardware"), HasSubstr("cray-1")));
    options = small();
    options.models = {{"dragon", "no/such/dragon.ply"}};
    EXPECT_THAT(error_of(options), HasSubstr("no/such/dragon.ply"));
    options = small();
    options.models = {{"x", "builtin:teapot"}};
    EXPECT_THAT(error_of(options), HasSubstr("teapot"));
    options = small();
    options.path.path = "no/such/path.txt";
    EXPECT_THAT(error_of(options), HasSubstr("no/such/path.txt"));
}

TEST(Scenario, RepeatsPathsByTheirSeeds) {
    ScenarioOptions options = small();
    options.path.seeds = 3;
    const auto scenario = Scenario::load(options);
    ASSERT_TRUE(scenario);
    ASSERT_EQ(scenario->experiments().front().paths->size(), 3u);
    EXPECT_NE(scenario->experiments().front().paths->at(0), scenario->experiments().front().paths->at(1));
    options.path.path = "orbit";
    const auto orbit = Scenario::load(options);
    ASSERT_TRUE(orbit);
    EXPECT_EQ(orbit->experiments().front().paths->size(), 1u);
}

TEST_F(ScenarioFiles, SettingsAreLinesThatTellRunsApart) {
    ScenarioOptions options = small();
    options.path.path = files_.write("path.txt", "0 0 5 0 0 0 0 1 0 40\n");
    options.hardware = {profile("mine.toml", "1.33 us/polygon")};
    const auto settings = settings_of(options);
    EXPECT_EQ(settings_of(options), settings);
    for (const std::string& line : settings) EXPECT_EQ(line.find('\n'), line.npos) << line;

    ScenarioOptions other = options;
    other.threads = 7;
    EXPECT_EQ(settings_of(other), settings) << "threads change nothing";
    const auto differs = [&](const char* what) { EXPECT_NE(settings_of(other), settings) << what; };
    other.servers = {3};
    differs("servers");
    other = options;
    other.sizes = {{64, 49}};
    differs("size");
    other = options;
    other.granularities = {{3, 0}};
    differs("depth");
    other = options;
    other.frames_in_flight = 2;
    differs("frames in flight");
    other = options;
    other.path.zoom = 1.0000001;
    differs("zoom");
    other = options;
    other.models = {{"knot", "builtin:knot:400"}};
    differs("model");
    other = options;
    files_.write("path.txt", "0 0 5 0 0 0 0 1 0 41\n");
    differs("cameras in a file of the same name");
    files_.write("path.txt", "0 0 5 0 0 0 0 1 0 40\n");
    profile("mine.toml", "1.3300000001 us/polygon");
    differs("profile in a file of the same name");
    profile("mine.toml", "1.33 us/polygon");
    EXPECT_EQ(settings_of(options), settings);
}

}  // namespace
}  // namespace swath::sim
