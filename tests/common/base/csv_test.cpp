#include "common/base/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swath {
namespace {

using testing::ElementsAre;

std::string csv_error(std::string_view text) {
    const auto records = parse_csv(text, "a,b", "t.csv");
    return records ? "no error" : records.error().message;
}

TEST(ParseCsv, GivesTheFieldsOfEveryLineAndItsNumber) {
    const auto records = parse_csv("a,b\n1,\n,2\n", "a,b", "t.csv");
    ASSERT_TRUE(records) << records.error().message;
    EXPECT_THAT(*records,
                ElementsAre(CsvRecord{1, {"a", "b"}}, CsvRecord{2, {"1", ""}}, CsvRecord{3, {"", "2"}}));
}

TEST(ParseCsv, ReadsQuotedFieldsWithCommasQuotesAndLineEnds) {
    const auto records = parse_csv("a,b\n\"x,\"\"y\"\"\",\"1\n2\"\n3,4\n", "a,b", "t.csv");
    ASSERT_TRUE(records) << records.error().message;
    EXPECT_THAT(*records, ElementsAre(CsvRecord{1, {"a", "b"}}, CsvRecord{2, {"x,\"y\"", "1\n2"}},
                                      CsvRecord{4, {"3", "4"}}));
}

TEST(ParseCsv, ReadsLinesThatEndAsOnWindows) {
    const auto records = parse_csv("a,b\r\n1,\"2\"\r\n", "a,b", "t.csv");
    ASSERT_TRUE(records) << records.error().message;
    EXPECT_EQ(records->back(), (CsvRecord{2, {"1", "2"}}));
}

TEST(ParseCsv, ReadsBackWhatCsvFieldWrote) {
    for (const std::string text : {"", "plain", "a,b", "\"", "\"\"", "two\nlines", "\r\n", "\r", " x "}) {
        const auto records = parse_csv("a,b\n" + csv_field(text) + ",\n", "a,b", "t.csv");
        ASSERT_TRUE(records) << text << ": " << records.error().message;
        EXPECT_EQ(records->at(1).fields[0], text);
    }
}

TEST(ParseCsv, NamesTheLineOfWhatIsWrong) {
    EXPECT_EQ(csv_error(""), "t.csv:1: the header is '', expected 'a,b'");
    EXPECT_EQ(csv_error("a,c\n"), "t.csv:1: the header is 'a,c', expected 'a,b'");
    EXPECT_EQ(csv_error("a,b"), "t.csv:1: cut off: the last line has no end");
    EXPECT_EQ(csv_error("a,b\n1,2\n3,4"), "t.csv:3: cut off: the last line has no end");
    EXPECT_EQ(csv_error("a,b\n1,\"2\n\n"), "t.csv:4: cut off: a quoted field has no end");
    EXPECT_EQ(csv_error("a,b\n1,2,3\n"), "t.csv:2: 3 fields, the header has 2");
    EXPECT_EQ(csv_error("a,b\n\n"), "t.csv:2: 1 fields, the header has 2");
    EXPECT_EQ(csv_error("a,b\n1,2\"3\n"), "t.csv:2: a quote inside of a field without quotes");
    EXPECT_EQ(csv_error("a,b\n1,\"2\"3\n"), "t.csv:2: text after a closing quote");
}

TEST(ParseCsv, NeverFailsOtherwiseOnAnyPrefixOfATable) {
    const std::string text = "a,b\n\"x,\"\"y\"\"\",\"1\n2\"\r\n3,4\n";
    for (std::size_t size = 0; size < text.size(); ++size) {
        const std::string_view prefix = std::string_view(text).substr(0, size);
        EXPECT_EQ(parse_csv(prefix, "a,b", "t").has_value(), size == 4 || size == 21) << prefix;
    }
}

}  // namespace
}  // namespace swath
