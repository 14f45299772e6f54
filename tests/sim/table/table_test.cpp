#include "sim/table/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <locale>

#include "common/base/check.h"

namespace swath::sim {
namespace {

using testing::ElementsAre;

const std::string kHeader = "algorithm,model,servers,column,value\n";

std::string table_error(const std::string& lines) {
    const auto rows = parse_table(kHeader + lines, "t.csv");
    return rows ? "no error" : rows.error().message;
}

std::string value_text(double value) {
    const std::string csv = to_csv(std::vector{Row{"a", "m", 1, "c", value}});
    return csv.substr(kHeader.size() + 8);
}

TEST(Table, WritesALineARow) {
    EXPECT_EQ(to_csv(std::vector<Row>{{"hybrid", "dragon", 8, "pixel_read", 2.5}, {"a", "b", 0, "c", 12}}),
              kHeader + "hybrid,dragon,8,pixel_read,2.5\na,b,0,c,12\n");
    EXPECT_EQ(to_csv({}), kHeader);
}

TEST(Table, WritesAtMostFourDecimalsAndNoTrailingZero) {
    EXPECT_EQ(value_text(1.0 / 3), "0.3333\n");
    EXPECT_EQ(value_text(0.5), "0.5\n");
    EXPECT_EQ(value_text(100), "100\n");
    EXPECT_EQ(value_text(0), "0\n");
    EXPECT_EQ(value_text(-0.00001), "0\n");
    EXPECT_EQ(value_text(-1.25), "-1.25\n");
    EXPECT_EQ(value_text(1e15), "1000000000000000\n");
}

TEST(Table, RefusesToWriteWhatItWouldNotRead) {
    EXPECT_THROW(value_text(std::numeric_limits<double>::quiet_NaN()), CheckFailed);
    EXPECT_THROW(value_text(std::numeric_limits<double>::infinity()), CheckFailed);
}

TEST(Table, ReadsBackWhatItWroteWhateverTheNames) {
    const std::vector<Row> rows{{"hybrid", "dragon", 64, "speedup", 43.7},
                                {"a,b", "the \"hand\"", 0, "two\nlines", -0.25},
                                {" x ", "\xc3\xa9", 1000000, "c", 0}};
    const auto read = parse_table(to_csv(rows), "t.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, rows);
}

TEST(Table, ReadsRowsOfAModelAndOfOneMachine) {
    const auto rows =
        parse_table(kHeader + "model,hand,0,objects,643\nuniprocessor,hand,1,server_total,872.9\n", "t.csv");
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_THAT(*rows, ElementsAre(Row{"model", "hand", 0, "objects", 643},
                                   Row{"uniprocessor", "hand", 1, "server_total", 872.9}));
}

TEST(Table, NamesTheLineAndTheFieldOfWhatIsWrong) {
    EXPECT_EQ(table_error(",m,1,c,2\n"), "t.csv:2: algorithm is empty");
    EXPECT_EQ(table_error("a,,1,c,2\n"), "t.csv:2: model is empty");
    EXPECT_EQ(table_error("a,m,1,,2\n"), "t.csv:2: column is empty");
    EXPECT_EQ(table_error("a,m,1,c,2\na,m,-1,c,2\n"),
              "t.csv:3: servers: '-1' is not a whole number of 0 to 1000000");
    EXPECT_EQ(table_error("a,m,8.5,c,2\n"), "t.csv:2: servers: '8.5' is not a whole number of 0 to 1000000");
    EXPECT_EQ(table_error("a,m,1000001,c,2\n"),
              "t.csv:2: servers: '1000001' is not a whole number of 0 to 1000000");
    EXPECT_EQ(table_error("a,m,99999999999999999999,c,2\n"),
              "t.csv:2: servers: '99999999999999999999' is not a whole number of 0 to 1000000");
    for (const std::string value : {"", "x", "nan", "inf", "-inf", "1e999", "1,5", "1.5ms", " 1", "0x10"}) {
        const std::string quoted = value == "1,5" ? "\"1,5\"" : value;
        EXPECT_EQ(table_error("a,m,1,c," + quoted + "\n"), "t.csv:2: value: '" + value + "' is not a number");
    }
    EXPECT_EQ(table_error("a,m,1,c\n"), "t.csv:2: 4 fields, the header has 5");
    EXPECT_EQ(table_error("a,m,1,c,2"), "t.csv:2: cut off: the last line has no end");
    EXPECT_EQ(parse_table("frame,machine\n", "t.csv").error().message,
              "t.csv:1: the header is 'frame,machine', expected 'algorithm,model,servers,column,value'");
}

TEST(Table, WithinAFileHasLinesOfTheFile) {
    const auto rows = parse_table(kHeader + "a,m,1,c,2\na,m,1,c,x\n", "t.csv", 10);
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().message, "t.csv:12: value: 'x' is not a number");
    EXPECT_EQ(parse_table(kHeader + "a,m,1,c\n", "t.csv", 10).error().message,
              "t.csv:11: 4 fields, the header has 5");
}

TEST(Table, ReadsThePublishedTable) {
    const auto rows = read_table(SWATH_SOURCE_DIR "/sim/published/table1.csv");
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_THAT(*rows, testing::Contains(Row{"hybrid", "buddha", 64, "speedup", 46.5}));
    EXPECT_THAT(*rows, testing::Contains(Row{"model", "dragon", 0, "polygons", 871414}));
}

TEST(Table, NamesAFileThatIsNotThere) {
    EXPECT_EQ(read_table("/no/such.csv").error().message, "/no/such.csv: No such file or directory");
}

TEST(Table, IsTheSameInALocaleWithDecimalCommas) {
    struct Commas : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        std::string do_grouping() const override { return "\3"; }
        char do_thousands_sep() const override { return '.'; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
    const std::string text = value_text(1234.5);
    const std::string error = table_error("a,m,1000,c,1234.5\n");
    std::locale::global(before);
    EXPECT_EQ(text, "1234.5\n");
    EXPECT_EQ(error, "no error");
}

}  // namespace
}  // namespace swath::sim
