#include "sim/scenario/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace swath::sim {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Result<ScenarioOptions> options_of(const std::string& flags, bool many = true) {
    CLI::App app;
    ScenarioFlags scenario;
    scenario.add_to(app, many);
    try {
        app.parse(flags);
    } catch (const CLI::ParseError& error) {
        return fail("{}", error.what());
    }
    return scenario.read();
}

std::string options_error(const std::string& flags, bool many = true) {
    const auto options = options_of(flags, many);
    return options ? "no error" : options.error().message;
}

TEST(ScenarioFlags, HaveThePapersDefaults) {
    const auto options = options_of("--model builtin:knot");
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_THAT(options->models, ElementsAre(ModelName{"knot", "builtin:knot"}));
    EXPECT_THAT(options->algorithms, ElementsAre(Algorithm::kHybrid));
    EXPECT_THAT(options->servers, ElementsAre(8u));
    EXPECT_THAT(options->hardware, ElementsAre("paper-2000"));
    EXPECT_THAT(options->sizes, ElementsAre(PictureSize{1280, 960}));
    ASSERT_EQ(options->granularities.size(), 1u);
    EXPECT_EQ(options->granularities[0].depth, 4);
    EXPECT_EQ(options->path.path, "random");
    EXPECT_EQ(options->path.frames, 50u);
    EXPECT_EQ(options->frames_in_flight, 3u);
    EXPECT_GE(options->threads, 1u);
}

TEST(ScenarioFlags, CutBySahIntoSoManyObjects) {
    const auto few = options_of("--model m --objects-by sah --objects 100,200");
    ASSERT_TRUE(few) << few.error().message;
    ASSERT_EQ(few->granularities.size(), 2u);
    EXPECT_EQ(few->granularities[1].objects, 200u);
    EXPECT_EQ(few->granularities[1].by, ObjectsBy::kSah);
    const auto unsaid = options_of("--model m --objects-by sah");
    ASSERT_TRUE(unsaid) << unsaid.error().message;
    ASSERT_EQ(unsaid->granularities.size(), 1u);
    EXPECT_EQ(unsaid->granularities[0].depth, std::nullopt);
    EXPECT_EQ(unsaid->granularities[0].objects, 1500u);
}

TEST(ScenarioFlags, TakeListsAndEachValueOnce) {
    const auto options = options_of(
        "--model a=x.ply --model b=y.ply --algorithm sort-last,hybrid,sort-last --servers 8,1,8,1024 "
        "--hardware one,two,one --size 64x48,32x24,64x48 --octree-depth 3,4");
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_EQ(options->models.size(), 2u);
    EXPECT_THAT(options->algorithms, ElementsAre(Algorithm::kSortLast, Algorithm::kHybrid));
    EXPECT_THAT(options->servers, ElementsAre(8u, 1u, 1024u));
    EXPECT_THAT(options->hardware, ElementsAre("one", "two"));
    EXPECT_THAT(options->sizes, ElementsAre(PictureSize{64, 48}, PictureSize{32, 24}));
    EXPECT_EQ(options->granularities.size(), 2u);
}

TEST(ScenarioFlags, TakeNumbersInOneNotation) {
    const auto options = options_of("--model m --frames 010 --seed 08 --zoom 1e1");
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_EQ(options->path.frames, 10u);
    EXPECT_EQ(options->path.seed, 8u);
    EXPECT_EQ(options->path.zoom, 10.0);
    for (const std::string flag :
         {"--frames 0x10", "--frames +3", "--frames 1e3", "--frames 0", "--frames 3.0"})
        EXPECT_THAT(options_error("--model m " + flag), HasSubstr("is not a whole number from 1 to 100000"))
            << flag;
    for (const std::string flag : {"--seed=-1", "--seed 18446744073709551616"})
        EXPECT_THAT(options_error("--model m " + flag), HasSubstr("is not a whole number from 0")) << flag;
    for (const std::string flag : {"--zoom nan", "--zoom 0", "--zoom inf", "--zoom 1x"})
        EXPECT_THAT(options_error("--model m " + flag), HasSubstr("is not a number from 0.01 to 100"))
            << flag;
}

TEST(ScenarioFlags, OfASingleRunTakeOneModel) {
    ASSERT_TRUE(options_of("builtin:knot --servers 2,4", false));
    EXPECT_NE(options_error("builtin:knot builtin:town", false), "no error");
    EXPECT_THAT(options_error("", false), HasSubstr("MODEL"));
    EXPECT_THAT(options_error("", true), HasSubstr("--model"));
}

TEST(ScenarioFlags, NameTheServersThatCannotBe) {
    for (const std::string servers : {"0", "1025", "8.5", "x", "8x", "99999999999999999999"})
        EXPECT_EQ(options_error("--model m --servers 2," + servers),
                  "--servers: '" + servers + "': expected a number from 1 to 1024");
}

TEST(ScenarioFlags, ListTheAlgorithmsWhereOneIsUnknown) {
    EXPECT_THAT(options_error("--model m --algorithm hybrid,magic"),
                AllOf(HasSubstr("--algorithm"), HasSubstr("magic"), HasSubstr(name_list<Algorithm>())));
}

TEST(ScenarioFlags, RefuseTwoModelsOfOneName) {
    EXPECT_EQ(options_error("--model a/dragon.ply --model b/dragon.obj"),
              "two models are called 'dragon': name them, as in a=a/dragon.ply b=b/dragon.obj");
    EXPECT_EQ(options_error("--model x=a/dragon.ply --model b/dragon.obj"), "no error");
}

TEST(ScenarioFlags, RefuseNumbersOutOfTheirLimits) {
    for (const std::string flags : {"--zoom nan",
                                    "--zoom inf",
                                    "--zoom 0",
                                    "--zoom 101",
                                    "--size 640",
                                    "--size 0x480",
                                    "--size 64x48,1x99999",
                                    "--frames 0",
                                    "--frames 100001",
                                    "--seeds 0",
                                    "--seeds 10001",
                                    "--seed -1",
                                    "--seed 18446744073709551616",
                                    "--in-flight 0",
                                    "--in-flight 9",
                                    "--octree-depth 11",
                                    "--objects-by kd",
                                    "--objects-by sah --octree-depth 3",
                                    "--octree-depth -1",
                                    "--objects 0",
                                    "--threads 0",
                                    "--threads 1025"})
        EXPECT_THAT(options_error("--model m " + flags), HasSubstr(flags.substr(0, flags.find(' '))))
            << flags;
    EXPECT_NE(options_error("--model m --objects 9 --octree-depth 2"), "no error");
}

TEST(ModelName, IsTheFilesUnlessGiven) {
    EXPECT_EQ(parse_model_name("models/dragon.ply"), (ModelName{"dragon", "models/dragon.ply"}));
    EXPECT_EQ(parse_model_name("builtin:knot:5000"), (ModelName{"knot", "builtin:knot:5000"}));
    EXPECT_EQ(parse_model_name("big=builtin:knot"), (ModelName{"big", "builtin:knot"}));
    for (const std::string text : {"", "=x", "x=", "a\nb=x", "a\nb.ply"})
        EXPECT_FALSE(parse_model_name(text)) << text;
}

}  // namespace
}  // namespace swath::sim
