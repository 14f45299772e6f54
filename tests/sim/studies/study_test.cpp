#include "sim/studies/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "sim/studies/published.h"
#include "tests/support/models.h"

namespace swath::sim {
namespace {

using testing::HasSubstr;

std::string file_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream) << file;
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files[entry.path().filename().string()] = file_text(entry.path());
    return files;
}

class Study : public testing::Test {
  protected:
    StudyOptions small(const std::string& folder, std::vector<std::string> names) const {
        StudyOptions options;
        options.names = std::move(names);
        options.models = {{"knot", "builtin:knot:3000"}};
        options.frames = 3;
        options.seeds = 2;
        options.quiet = true;
        options.out = files_.path_of(folder);
        return options;
    }
    swath::test::TemporaryFolder files_;
};

// The golden file is made by these commands; look at the difference before.
//   swath-sim study feasibility --model knot=builtin:knot:3000 --frames 3 --seeds 2 --out DIR
//   cp DIR/table1.csv tests/sim/studies/golden/
TEST_F(Study, OfFeasibilityMakesTheTableThatItMadeBefore) {
    ASSERT_TRUE(run_studies(small("out", {"feasibility"})));
    EXPECT_EQ(file_text(files_.path_of("out/table1.csv")), file_text(SWATH_GOLDEN "/table1.csv"));
}

TEST_F(Study, MakesTheSameBytesOnAnyNumberOfThreads) {
    StudyOptions one = small("one", study_names());
    StudyOptions three = small("three", study_names());
    three.threads = 3;
    ASSERT_TRUE(run_studies(one));
    ASSERT_TRUE(run_studies(three));
    const auto files = files_of(one.out);
    EXPECT_GT(files.size(), 20u);
    EXPECT_EQ(files, files_of(three.out));
}

TEST_F(Study, MakesAPageWhosePicturesAreAllThere) {
    const StudyOptions options = small("page", study_names());
    ASSERT_TRUE(run_studies(options));
    const std::string html = file_text(options.out / "index.html");
    std::size_t pictures = 0;
    const std::regex source("src=\"([^\"]+)\"");
    for (std::sregex_iterator at(html.begin(), html.end(), source), end; at != end; ++at, ++pictures)
        EXPECT_TRUE(std::filesystem::exists(options.out / (*at)[1].str())) << (*at)[1];
    EXPECT_GE(pictures, 15u);
    for (const char* section :
         {"Feasibility", "Scalability", "sort-first", "sort-last", "resolution", "granularity"})
        EXPECT_THAT(html, HasSubstr(section));
}

TEST_F(Study, ShowsOnlyWhatWasAskedFor) {
    const StudyOptions options = small("some", {"resolution"});
    ASSERT_TRUE(run_studies(options));
    EXPECT_TRUE(std::filesystem::exists(options.out / "figure_11.svg"));
    EXPECT_FALSE(std::filesystem::exists(options.out / "table1.csv"));
}

TEST_F(Study, PutsThePapersFiguresBesideAModelOfThePaper) {
    StudyOptions options = small("dragon", {"feasibility"});
    options.models = {{"dragon", "builtin:knot:3000"}};
    ASSERT_TRUE(run_studies(options));
    const std::string html = file_text(options.out / "index.html");
    EXPECT_THAT(html, HasSubstr("(160.9)"));  // hybrid, 8 servers
    EXPECT_THAT(html, HasSubstr("Buddha is not here"));
    EXPECT_THAT(html, HasSubstr("builtin:hand, a procedural model, stands in for it"));
    EXPECT_THAT(file_text(options.out / "table1.csv"), HasSubstr("\nhybrid,hand-stand-in,64,speedup,"));
}

TEST_F(Study, NamesWhatIsMissing) {
    StudyOptions options = small("missing", {"feasibility"});
    options.models = {{"buddha", files_.path_of("none.ply")}};
    const Status missing = run_studies(options);
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("none.ply"));

    options = small("missing", {"feasibility"});
    options.hardware = "paper-1999";
    const Status hardware = run_studies(options);
    ASSERT_FALSE(hardware);
    EXPECT_THAT(hardware.error().message, HasSubstr("paper-2000"));

    options = small("file", {"feasibility"});
    options.out = files_.write("file", "in the way");
    const Status folder = run_studies(options);
    ASSERT_FALSE(folder);
    EXPECT_THAT(folder.error().message, HasSubstr("--out"));
}

TEST_F(Study, RefusesNamesThatItCouldNotTellApartOrPlace) {
    const auto error_of = [&](const StudyOptions& options) {
        const Status status = run_studies(options);
        return status ? "no error" : status.error().message;
    };
    StudyOptions options = small("names", {"feasibility"});
    options.zooms = {{"knut", 2}};
    EXPECT_THAT(error_of(options), HasSubstr("--zoom: no model is called 'knut'"));
    options.zooms = {};
    options.models = {{"dragon", "builtin:knot:300"}, {"Dragon", "builtin:knot:300"}};
    EXPECT_THAT(error_of(options), HasSubstr("'dragon' and 'Dragon' are both the paper's dragon"));
    options.models = {{"dragon", "builtin:knot:300"}, {"hand-stand-in", "builtin:knot:300"}};
    EXPECT_THAT(error_of(options), HasSubstr("two models are called 'hand-stand-in'"));
    EXPECT_FALSE(std::filesystem::exists(options.out / "index.html"));
}

// A model may have any name: its files are in the folder and the page finds them.
TEST_F(Study, GivesFilesPlainNames) {
    StudyOptions options = small("plain", {"scalability"});
    options.models = {{"../a b#1%", "builtin:knot:300"}};
    ASSERT_TRUE(run_studies(options));
    const std::string name = "figure_9_..~2fa~20b~231~25.svg";
    EXPECT_TRUE(std::filesystem::exists(options.out / name));
    EXPECT_THAT(file_text(options.out / "index.html"), HasSubstr("src=\"" + name + "\""));
}

TEST_F(Study, OfASingleTriangleDividesByNothing) {
    StudyOptions options = small("triangle", study_names());
    options.models = {{"triangle", files_.write("triangle.ply",
                                                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                                "property float y\nproperty float z\nelement face 1\n"
                                                "property list uchar int vertex_indices\nend_header\n"
                                                "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")}};
    const Status status = run_studies(options);
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_FALSE(std::regex_search(file_text(options.out / "index.html"), std::regex("\\b(nan|inf)\\b|>-0")));
}

TEST_F(Study, SaysWhenItsHardwareIsNotThePapers) {
    StudyOptions options = small("paper", {"feasibility"});
    ASSERT_TRUE(run_studies(options));
    EXPECT_THAT(file_text(options.out / "index.html"), testing::Not(HasSubstr("compare two clusters")));
    options = small("gbe", {"feasibility"});
    options.hardware = "gbe-2026";
    ASSERT_TRUE(run_studies(options));
    EXPECT_THAT(file_text(options.out / "index.html"), HasSubstr("compare two clusters"));
}

class StudyFlagsTest : public testing::Test {
  protected:
    static Result<StudyOptions> read(std::vector<std::string> arguments) {
        CLI::App app;
        StudyFlags flags;
        flags.add_to(app);
        std::reverse(arguments.begin(), arguments.end());
        try {
            app.parse(arguments);
        } catch (const CLI::ParseError& error) {
            return fail("{}", error.what());
        }
        return flags.read();
    }
    static std::string error_of(const std::vector<std::string>& arguments) {
        const auto options = read(arguments);
        return options ? "no error" : options.error().message;
    }
};

TEST_F(StudyFlagsTest, NameStudiesModelsAndZooms) {
    const auto options = read({"all", "--out", "x", "--model", "dragon=a.ply", "--model", "builtin:knot",
                               "--zoom", "dragon=2.5", "--seeds", "7"});
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_EQ(options->names, study_names());
    EXPECT_EQ(options->models, (std::vector<ModelName>{{"dragon", "a.ply"}, {"knot", "builtin:knot"}}));
    EXPECT_EQ(options->zooms.at("dragon"), 2.5);
    EXPECT_EQ(options->seeds, 7u);
    EXPECT_GE(options->threads, 1u);
}

TEST_F(StudyFlagsTest, ThatAreWrongAreNamed) {
    EXPECT_THAT(error_of({"feasability", "--out", "x"}),
                HasSubstr("'feasability' is not known; there are: feasibility"));
    EXPECT_THAT(error_of({"all"}), HasSubstr("--out"));
    EXPECT_THAT(error_of({"--out", "x"}), HasSubstr("NAME"));
    EXPECT_THAT(error_of({"all", "--out", "x", "--zoom", "dragon"}),
                HasSubstr("'dragon': expected MODEL=ZOOM"));
    EXPECT_THAT(error_of({"all", "--out", "x", "--zoom", "dragon=nan"}), HasSubstr("expected MODEL=ZOOM"));
    EXPECT_THAT(error_of({"all", "--out", "x", "--zoom", "a=1", "--zoom", "a=2"}),
                HasSubstr("'a' has two of them"));
    EXPECT_THAT(error_of({"all", "--out", "x", "--model", "a=b", "--model", "a=c"}), HasSubstr("two models"));
    EXPECT_THAT(error_of({"all", "--out", "x", "--seeds", "0"}), HasSubstr("--seeds"));
    EXPECT_THAT(error_of({"all", "--out", "x", "--seed", "-1"}), HasSubstr("--seed"));
}

TEST(PublishedTable1, HasAllRowsOfThePaper) {
    EXPECT_EQ(published("hybrid", "dragon", 64, "speedup"), 43.7);
    EXPECT_EQ(published("sort-first", "hand", 8, "overlap_render"), 66.6);
    EXPECT_EQ(published("model", "buddha", 0, "polygons"), 1'087'716);
    EXPECT_EQ(published("hybrid", "dragon", 64, "overlap_render"), std::nullopt);
    std::size_t speedups = 0;
    for (const Row& row : published_table1()) speedups += row.column == "speedup" ? 1 : 0;
    EXPECT_EQ(speedups, 36u);
}

}  // namespace
}  // namespace swath::sim
