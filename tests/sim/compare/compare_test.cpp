#include "sim/compare/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "common/timeline/export.h"
#include "sim/table/table.h"
#include "tests/common/timeline/sample.h"

namespace swath::sim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

const std::string kHeader = "algorithm,model,servers,column,value\n";
const std::string kPublished = SWATH_SOURCE_DIR "/sim/published/table1.csv";

// Files are in a folder of the test's own.
class Compare : public testing::Test {
  protected:
    Compare() { fs::create_directories(folder_); }
    ~Compare() override { fs::remove_all(folder_); }

    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    // The timeline of a run of two frames in so many milliseconds.
    std::string timeline(const std::string& name, std::size_t servers, int ms_in_all) const {
        std::vector<FrameTimeline> frames{
            frame(0, {machine("client", {span(Phase::kPartition, 0, 1)})}),
            frame(1, {machine("display", {span(Phase::kAssemble, 1, ms_in_all)})})};
        for (std::size_t i = 0; i < servers; ++i)
            frames[i % 2].machines.push_back(machine(server_name(ServerId(i)), {span(Phase::kRender, 0, 1)}));
        return file(name, to_csv(frames));
    }
    std::string error_of(const std::vector<std::string>& inputs) const {
        const auto curves = read_curves(inputs);
        if (curves) return "no error";
        std::string message = curves.error().message;
        const std::string prefix = folder_.string() + "/";
        for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
        return message;
    }
    std::vector<Curve> curves_of(const std::vector<std::string>& inputs) const {
        auto curves = read_curves(inputs);
        EXPECT_TRUE(curves) << curves.error().message;
        return curves ? *curves : std::vector<Curve>{};
    }

    const fs::path folder_ =
        fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Compare, ReadsACurveForEachAlgorithmAndModelOfATable) {
    const std::vector<Curve> curves = curves_of({kPublished});
    ASSERT_EQ(curves.size(), 9u);
    EXPECT_EQ(curves[2].label, "table1");
    EXPECT_EQ(curves[2].name, "hybrid, buddha");
    EXPECT_THAT(curves[2].points, ElementsAre(Pair(8, 7.4), Pair(16, 14.2), Pair(32, 26.3), Pair(64, 46.5)));
}

TEST_F(Compare, OrdersPointsByServersAndLeavesOutOtherColumns) {
    const auto curves = curves_of({"ours=" + file("t.csv", kHeader + "a,m,64,speedup,40\na,m,8,speedup,7\n"
                                                                     "a,m,8,server_total,9\n")});
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(curves[0], (Curve{"ours", "a, m", {{8, 7}, {64, 40}}}));
}

TEST_F(Compare, TellsFullModeFromThePapers) {
    const auto curves = curves_of({"ours=" + file("t.csv", kHeader + "a,m,8,speedup,7\na,m,8,full_speedup,6\n"
                                                                     "a,m,1,full_speedup,1\n")});
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_EQ(curves[0], (Curve{"ours", "a, m", {{8, 7}}}));
    EXPECT_EQ(curves[1], (Curve{"ours", "a, m, full mode", {{1, 1}, {8, 6}}}));
}

TEST_F(Compare, DividesFramesASecondOfTimelinesByThatOfOneServer) {
    const auto curves =
        curves_of({"real=" + timeline("four.csv", 4, 300), "real=" + timeline("one.csv", 1, 1000),
                   "real=" + timeline("two.csv", 2, 500)});
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(curves[0].label, "real");
    ASSERT_EQ(curves[0].points.size(), 3u);
    EXPECT_THAT(curves[0].points[0], Pair(1, 1.0));
    EXPECT_THAT(curves[0].points[1], Pair(2, testing::DoubleEq(2.0)));
    EXPECT_THAT(curves[0].points[2], Pair(4, testing::DoubleEq(1000.0 / 300)));
}

TEST_F(Compare, TakesTheSingleProcessForOneServer) {
    const std::string single = file(
        "single.csv", to_csv(std::vector{frame(0, {machine("single", {span(Phase::kRender, 0, 100)})})}));
    const auto curves = curves_of({"r=" + single, "r=" + timeline("two.csv", 2, 100)});
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_THAT(curves[0].points, ElementsAre(Pair(1, 1.0), Pair(2, testing::DoubleEq(2.0))));
}

TEST_F(Compare, KeepsTheOrderOfInputsAndTellsLabelsApart) {
    const auto curves =
        curves_of({"x=" + timeline("one.csv", 1, 100), kPublished, "y=" + timeline("one2.csv", 1, 100)});
    ASSERT_EQ(curves.size(), 11u);
    EXPECT_EQ(curves.front().label, "x");
    EXPECT_EQ(curves.back().label, "y");
}

TEST_F(Compare, TakesAFileWhoseNameHasAnEqualsSign) {
    const auto curves = curves_of({file("n=8.csv", kHeader + "a,m,8,speedup,7\n")});
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(curves[0].label, "n=8");
}

TEST_F(Compare, NamesTheFileAndWhatIsWrongWithIt) {
    EXPECT_EQ(error_of({}), "nothing to compare: name at least one file");
    EXPECT_EQ(error_of({"/no/such.csv"}), "/no/such.csv: No such file or directory");
    EXPECT_EQ(error_of({"a=/no/such.csv"}), "/no/such.csv: No such file or directory");
    EXPECT_EQ(error_of({"=x.csv"}), "'=x.csv' is not LABEL=FILE: one of them is empty");
    EXPECT_EQ(error_of({"x="}), "'x=' is not LABEL=FILE: one of them is empty");
    EXPECT_THAT(
        error_of({file("trace.json", "{\"displayTimeUnit\":\"ms\"}\n")}),
        StartsWith("trace.json:1: the header is '{\"displayTimeUnit\":\"ms\"}', expected 'algorithm,"));
    EXPECT_EQ(error_of({file("bad.csv", kHeader + "a,m,8,speedup,fast\n")}),
              "bad.csv:2: value: 'fast' is not a number");
    EXPECT_EQ(error_of({file("other.csv", kHeader + "a,m,8,server_total,9\n")}),
              "other.csv: no row has the column speedup");
    EXPECT_EQ(error_of({file("twice.csv", kHeader + "a,m,8,speedup,7\na,m,8,speedup,7\n")}),
              "twice.csv: a second speed-up of a, m with 8 servers");
    EXPECT_EQ(error_of({file("none.csv", kHeader + "a,m,0,speedup,7\n")}),
              "none.csv: a, m has a speed-up of 7 with 0 servers");
    EXPECT_EQ(error_of({file("minus.csv", kHeader + "a,m,8,speedup,-7\n")}),
              "minus.csv: a, m has a speed-up of -7 with 8 servers");
    EXPECT_EQ(error_of({"r=" + timeline("two.csv", 2, 100)}),
              "r: no timeline of one server (or --single) to compare with; label it r=FILE");
    EXPECT_EQ(error_of({"r=" + timeline("one.csv", 1, 100), "r=" + timeline("uno.csv", 1, 90)}),
              "uno.csv: a second speed-up of r with 1 server");
    EXPECT_EQ(error_of({file("empty.csv", to_csv(std::span<const FrameTimeline>{}))}),
              "empty.csv: the timeline names no server");
    EXPECT_EQ(
        error_of({file("still.csv",
                       to_csv(std::vector{frame(0, {machine("server 0", {span(Phase::kWait, 5, 5)})})}))}),
        "still.csv: the timeline takes no time");
    EXPECT_EQ(error_of({kPublished, "table1=" + file("more.csv", kHeader + "a,m,8,speedup,7\n")}),
              "more.csv: another input is called table1 too; label it LABEL=FILE");
    EXPECT_EQ(error_of({kPublished, "table1=" + timeline("one.csv", 1, 100)}),
              "one.csv: another input is called table1 too; label it LABEL=FILE");
}

TEST_F(Compare, DrawsAllCurvesWhereNothingWasMeasured) {
    const auto curves = curves_of({kPublished});
    EXPECT_EQ(worth_drawing(curves), curves);
}

TEST_F(Compare, DrawsBesideARunWhatIsLikeItAndNear) {
    std::string table = kHeader;
    for (int speed = 1; speed <= 9; ++speed)
        table += fmt::format("a,m{0},2,speedup,2\na,m{0},2,full_speedup,1.{0}\na,m{0},64,full_speedup,40\n",
                             speed);
    const auto curves =
        curves_of({"sim=" + file("t.csv", table), kPublished, "real=" + timeline("one.csv", 1, 300),
                   "real=" + timeline("two.csv", 2, 200)});
    ASSERT_EQ(curves.size(), 9u * 2 + 9 + 1);
    const auto drawn = worth_drawing(curves);
    std::vector<std::string> names;
    for (const Curve& curve : drawn) names.push_back(curve.name);
    // Nearest to 1.5, in full mode; what is published begins at 8 servers, where nothing was measured.
    EXPECT_THAT(names, ElementsAre("a, m3, full mode", "a, m4, full mode", "a, m5, full mode",
                                   "a, m6, full mode", "a, m7, full mode", "a, m8, full mode", "real"));
    EXPECT_THAT(drawn[2].points, ElementsAre(Pair(2, 1.5)));
    EXPECT_TRUE(drawn.back().measured);

    const std::string text = to_text(curves);
    EXPECT_THAT(text, StartsWith("speed-up, servers:          1       2\n"
                                 "sim: a, m3, full mode       -    1.30\n"));
    EXPECT_THAT(text, HasSubstr("\nreal                     1.00    1.50  measured\n"
                                "21 more are in compare.csv only\n"));
}

TEST_F(Compare, WritesATableThatItCanReadAndBothPictures) {
    const auto curves =
        curves_of({kPublished, "real=" + timeline("one.csv", 1, 100), "real=" + timeline("four.csv", 4, 40)});
    const fs::path out = folder_ / "new" / "out";
    const Status written = write_comparison(curves, out);
    ASSERT_TRUE(written) << written.error().message;
    const auto rows = read_table(out / "compare.csv");
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_EQ(rows->size(), 9u * 4 + 2);
    EXPECT_EQ(rows->back(), (Row{"real", "real", 4, "speedup", 2.5}));
    EXPECT_EQ(curves_of({(out / "compare.csv").string()}).size(), curves.size());
    EXPECT_GT(fs::file_size(out / "compare.png"), 10000u);
    std::ifstream in(out / "compare.svg");
    EXPECT_THAT(std::string(std::istreambuf_iterator<char>(in), {}), HasSubstr("table1: hybrid, buddha"));
}

}  // namespace
}  // namespace swath::sim
