#include "sim/sweep/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swath::sim {
namespace {

using testing::StartsWith;

const std::vector<Row> kLabels{
    {"hybrid", "knot", 2, "", 0}, {"hybrid", "knot", 4, "", 0}, {"sort-last", "a \"b\", c", 2, "", 0}};

std::string rows_of(std::size_t experiment) {
    Row first = kLabels[experiment];
    first.column = "speedup";
    first.value = 1.25 + static_cast<double>(experiment);
    Row second = first;
    second.column = "full_frame";
    second.value = 39.0021;
    return lines_of(std::vector{first, second});
}

const std::string kHead =
    journal_head(std::vector<std::string>{"path random", "", "model knot: 300 polygons"});

Result<JournalContents> read(std::string_view text, std::string_view head = kHead) {
    return read_journal(text, head, kLabels, "j");
}

std::string journal_error(std::string_view text, std::string_view head = kHead) {
    const auto contents = read(text, head);
    return contents ? "no error" : contents.error().message;
}

// The head has 5 lines, an entry 3.
TEST(Journal, ReadsWhatItWrote) {
    const auto empty = read(kHead);
    ASSERT_TRUE(empty) << empty.error().message;
    EXPECT_EQ(empty->rows, std::vector<std::string>(3));
    EXPECT_EQ(empty->intact_bytes, kHead.size());

    const std::string text = kHead + journal_entry(rows_of(2)) + journal_entry(rows_of(0));
    const auto contents = read(text);
    ASSERT_TRUE(contents) << contents.error().message;
    EXPECT_EQ(contents->rows, (std::vector<std::string>{rows_of(0), "", rows_of(2)}));
    EXPECT_EQ(contents->intact_bytes, text.size());
}

TEST(Journal, IsATableWithNotes) {
    std::string table;
    const std::string text = kHead + journal_entry(rows_of(2)) + journal_entry(rows_of(1));
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        if (text[at] != '#') table += text.substr(at, text.find('\n', at) + 1 - at);
    const auto rows = parse_table(table, "t");
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_EQ(rows->size(), 4u);
}

TEST(Journal, CutOffAnywhereKeepsTheEntriesThatAreWhole) {
    const std::string one = kHead + journal_entry(rows_of(2));
    const std::string two = one + journal_entry(rows_of(0));
    for (std::size_t size = 0; size <= two.size(); ++size) {
        const auto contents = read(std::string_view(two).substr(0, size));
        ASSERT_TRUE(contents) << size << ": " << contents.error().message;
        EXPECT_EQ(contents->intact_bytes, size == two.size()     ? size
                                          : size >= one.size()   ? one.size()
                                          : size >= kHead.size() ? kHead.size()
                                                                 : 0u)
            << size;
        EXPECT_EQ(!contents->rows[2].empty(), size >= one.size()) << size;
        EXPECT_EQ(!contents->rows[0].empty(), size == two.size()) << size;
    }
}

TEST(Journal, ZerosAtTheEndWereNeverWritten) {
    const std::string one = kHead + journal_entry(rows_of(2));
    const std::string two = one + journal_entry(rows_of(0));
    for (std::size_t size = 0; size < two.size(); ++size) {
        const auto contents = read(two.substr(0, size) + std::string(100, '\0'));
        ASSERT_TRUE(contents) << size << ": " << contents.error().message;
        EXPECT_EQ(contents->intact_bytes, read(two.substr(0, size))->intact_bytes) << size;
    }
    EXPECT_NE(journal_error(kHead + std::string(5, '\0') + journal_entry(rows_of(2))), "no error");
}

TEST(Journal, AnyOtherByteInItIsNoticed) {
    const std::string text = kHead + journal_entry(rows_of(2)) + journal_entry(rows_of(0));
    for (std::size_t at = 0; at + 1 < text.size(); ++at) {
        for (const char other : {'x', '7', '#', ',', '\n', '"', ' '}) {
            std::string changed = text;
            if (changed[at] == other) continue;
            changed[at] = other;
            const std::string error = journal_error(changed);
            EXPECT_THAT(error, StartsWith("j:")) << at << " " << other;
            EXPECT_EQ(error.find('\n'), error.npos) << error;
        }
        std::string shorter = text;
        shorter.erase(at, 1);
        EXPECT_NE(journal_error(shorter), "no error") << at;
    }
}

TEST(Journal, OfOtherSettingsIsAnErrorThatNamesTheFirstDifference) {
    const auto head = [](std::vector<std::string> settings) { return journal_head(settings); };
    const std::string entry = journal_entry(rows_of(0));
    EXPECT_EQ(journal_error(head({"path orbit", "", "model x"}) + entry),
              "j:2: the journal of another sweep: it has '# path orbit', this one '# path random'");
    EXPECT_EQ(
        journal_error(head({"path random", "", "model knot: 400 polygons", "more"}) + entry),
        "j:4: the journal of another sweep: it has '# model knot: 400 polygons', this one '# model knot: 300 "
        "polygons'");
    EXPECT_EQ(journal_error(head({"path random", "", "model knot: 300 polygons", "more"}) + entry),
              "j:5: the journal of another sweep: it has '# more', this one "
              "'algorithm,model,servers,column,value'");
    EXPECT_EQ(
        journal_error(head({"path random", ""}) + entry),
        "j:4: the journal of another sweep: it has 'algorithm,model,servers,column,value', this one '# model "
        "knot: 300 polygons'");
    EXPECT_EQ(journal_error("letter to a friend\n"), "j:1: not the journal of a sweep");
    EXPECT_EQ(journal_error("algorithm,model,servers,column,value\nhybrid,knot,2,speedup,1\n"),
              "j:1: not the journal of a sweep");
}

TEST(Journal, RowsOfNoExperimentAreAnError) {
    EXPECT_EQ(journal_error(kHead + journal_entry(rows_of(0) + "hybrid,knot,3,speedup,1\n")),
              "j:8: no experiment of this sweep: hybrid, knot, 3 servers");
    EXPECT_EQ(journal_error(kHead + "mahd,knot,2,speedup,1\n"),
              "j:6: no experiment of this sweep: mahd, knot, 2 servers");
    EXPECT_EQ(journal_error(kHead + journal_entry(rows_of(0) + rows_of(1))),
              "j:8: a row of another experiment than those before: hybrid, knot, 4 servers");
    EXPECT_EQ(journal_error(kHead + journal_entry("")), "j:6: an end without rows");
}

TEST(Journal, AnExperimentTwiceIsAnError) {
    const std::string once = kHead + journal_entry(rows_of(0)) + journal_entry(rows_of(1));
    const std::string error = "j:12: an experiment for the second time: hybrid, knot, 2 servers";
    EXPECT_EQ(journal_error(once + journal_entry(rows_of(0))), error);
    EXPECT_EQ(journal_error(once + rows_of(0)), error) << "also one that is cut off";
}

TEST(Journal, NumbersThatAreNoneAreAnError) {
    EXPECT_EQ(journal_error(kHead + journal_entry("hybrid,knot,2,speedup,fast\n")),
              "j:6: value: 'fast' is not a number");
    EXPECT_EQ(journal_error(kHead + journal_entry(rows_of(0) + "hybrid,knot,2,full_frame,nan\n")),
              "j:8: value: 'nan' is not a number");
    EXPECT_EQ(journal_error(kHead + "hybrid,knot,-2,speedup,1\n"),
              "j:6: servers: '-2' is not a whole number of 0 to 1000000");
}

TEST(Journal, GarbageIsAnError) {
    const std::string entry = journal_entry(rows_of(0));
    EXPECT_EQ(journal_error(kHead + "garbage\n" + entry), "j:6: 1 fields, the header has 5");
    EXPECT_EQ(journal_error(kHead + entry + "garbage\n"), "j:9: 1 fields, the header has 5");
    EXPECT_EQ(journal_error(kHead + "# note\n" + entry), "j:6: neither a row nor '# complete '");
    EXPECT_EQ(journal_error(kHead + rows_of(0) + "# complete 0123456789abcdef\n"),
              "j:8: the rows before are not as they were written");
}

}  // namespace
}  // namespace swath::sim
