#include "common/timeline/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/timeline/export.h"
#include "tests/common/timeline/sample.h"

namespace swath {
namespace {

const std::string kHeader = "frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value\n";

std::string import_error(const std::string& rows) {
    const auto frames = parse_timeline(kHeader + rows, "t.csv");
    return frames ? "no error" : frames.error().message;
}

TEST(ParseTimeline, GivesBackWhatWasExported) {
    std::vector<FrameTimeline> frames{
        frame(3, {machine("client", {span(Phase::kPartition, 0, 2, 1)}),
                  machine("server 0", {span(Phase::kPixelRead, 3, 20), span(Phase::kWait, 2, 3)})}),
        frame(9, {machine("a, \"b\"\nc", {{Phase::kEncode, Nanoseconds(1), ms(80000001), ms(7)}})}),
        frame(10, {})};
    frames[0].machines[1][Counter::kReceivedPixels] = ~std::uint64_t{0};
    frames[0].machines[1][Counter::kTriangles] = 1;
    frames[1].overlap_factor = 1.25;
    const auto read = parse_timeline(to_csv(frames), "t.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(*read == frames);
}

TEST(ParseTimeline, OfNoFramesIsNoFrames) {
    const auto read = parse_timeline(to_csv({}), "t.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->empty());
}

TEST(ParseTimeline, NamesTheLineAndTheFieldOfWhatIsWrong) {
    const std::string frame = "0,,frame,overlap_factor,,,,1\n";
    EXPECT_EQ(import_error("x,,frame,overlap_factor,,,,1\n"), "t.csv:2: frame: 'x' is not a number");
    EXPECT_EQ(import_error("-1,,frame,overlap_factor,,,,1\n"), "t.csv:2: frame: '-1' is not a number");
    EXPECT_EQ(import_error("0,,frame,overlap,,,,1\n"), "t.csv:2: name: 'overlap' is not overlap_factor");
    EXPECT_EQ(import_error("0,,frame,overlap_factor,,,,nan\n"),
              "t.csv:2: value: 'nan' is not an overlap factor");
    EXPECT_EQ(import_error("0,,frame,overlap_factor,1,,,1\n"),
              "t.csv:2: '1' where a row of kind frame has nothing");
    EXPECT_EQ(import_error(frame + frame), "t.csv:3: frame: 0 comes after 0");
    EXPECT_EQ(import_error("0,client,span,wait,0,1,0,\n"),
              "t.csv:2: frame: 0 has not begun with a row of kind frame");
    EXPECT_EQ(import_error(frame + "1,client,span,wait,0,1,0,\n"),
              "t.csv:3: frame: 1 has not begun with a row of kind frame");
    EXPECT_EQ(import_error(frame + "0,client,lunch,wait,0,1,0,\n"),
              "t.csv:3: kind: 'lunch' is not frame, span or counter");
    EXPECT_EQ(import_error(frame + "0,,span,wait,0,1,0,\n"), "t.csv:3: machine is empty");
    EXPECT_EQ(import_error(frame + "0,client,span,lunch,0,1,0,\n"), "t.csv:3: name: 'lunch' is not a phase");
    EXPECT_EQ(import_error(frame + "0,client,span,wait,,1,0,\n"),
              "t.csv:3: begin_ms: '' is not a time in ms");
    EXPECT_EQ(import_error(frame + "0,client,span,wait,0,inf,0,\n"),
              "t.csv:3: end_ms: 'inf' is not a time in ms");
    EXPECT_EQ(import_error(frame + "0,client,span,wait,0,1e300,0,\n"),
              "t.csv:3: end_ms: '1e300' is not a time in ms");
    EXPECT_EQ(import_error(frame + "0,client,span,wait,0,1,x,\n"),
              "t.csv:3: cpu_ms: 'x' is not a time in ms");
    EXPECT_EQ(import_error(frame + "0,client,span,wait,0,1,0,5\n"),
              "t.csv:3: '5' where a row of kind span has nothing");
    EXPECT_EQ(import_error(frame + "0,client,counter,lunches,,,,5\n"),
              "t.csv:3: name: 'lunches' is not a counter");
    EXPECT_EQ(import_error(frame + "0,client,counter,objects,,,,-5\n"),
              "t.csv:3: value: '-5' is not a count");
    EXPECT_EQ(import_error(frame + "0,client,span,wait,0,1,0,\n0,display,span,wait,0,1,0,\n"
                                   "0,client,counter,objects,,,,5\n"),
              "t.csv:5: machine: 'client' is there twice in a frame");
    EXPECT_EQ(import_error(frame + "0,client,span,wa"), "t.csv:3: cut off: the last line has no end");
    EXPECT_EQ(parse_timeline("{}", "t.json").error().message,
              "t.json:1: the header is '{}', expected "
              "'frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value'");
}

}  // namespace
}  // namespace swath
