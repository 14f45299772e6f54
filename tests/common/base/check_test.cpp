#include "common/base/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "common/base/ids.h"

namespace swath {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// The message of a failing CHECK, or nothing.
template <class Code>
std::string complaint(Code&& code) {
    try {
        code();
    } catch (const CheckFailed& failed) {
        return failed.what();
    }
    return {};
}

TEST(Check, SaysNothingWhenItHolds) {
    const int three = 3;
    EXPECT_EQ(complaint([&] {
                  CHECK(three == 3);
                  CHECK(three != 4);
                  CHECK(three < 4);
                  CHECK(three <= 3);
                  CHECK(three > 2);
                  CHECK(three >= 3);
                  CHECK(three);
                  CHECK(three + 1 == 4);
                  CHECK(three << 1 == 6);
              }),
              "");
}

TEST(Check, NamesExpressionPlaceAndBothValues) {
    const int sent = 3;
    const int received = 5;
    EXPECT_THAT(complaint([&] { CHECK(sent == received); }),
                AllOf(HasSubstr("check_test.cpp:"), HasSubstr("CHECK(sent == received) failed: 3 == 5")));
}

TEST(Check, FailsForEveryComparison) {
    const int a = 1;
    const int b = 2;
    EXPECT_THAT(complaint([&] { CHECK(a == b); }), HasSubstr("failed: 1 == 2"));
    EXPECT_THAT(complaint([&] { CHECK(a != a); }), HasSubstr("failed: 1 != 1"));
    EXPECT_THAT(complaint([&] { CHECK(b < a); }), HasSubstr("failed: 2 < 1"));
    EXPECT_THAT(complaint([&] { CHECK(b <= a); }), HasSubstr("failed: 2 <= 1"));
    EXPECT_THAT(complaint([&] { CHECK(a > b); }), HasSubstr("failed: 1 > 2"));
    EXPECT_THAT(complaint([&] { CHECK(a >= b); }), HasSubstr("failed: 1 >= 2"));
}

TEST(Check, ASingleValueFailsWhenItIsFalse) {
    const bool no = false;
    EXPECT_THAT(complaint([&] { CHECK(no); }), HasSubstr("CHECK(no) failed: false"));
    const std::unique_ptr<int> nothing;
    EXPECT_THAT(complaint([&] { CHECK(nothing); }), HasSubstr("failed: false"));
}

TEST(Check, PrintsBytesBoolsAndIdsAsWhatTheyMean) {
    const std::uint8_t byte = 65;
    EXPECT_THAT(complaint([&] { CHECK(byte == 66); }), HasSubstr("failed: 65 == 66"));
    const bool yes = true;
    EXPECT_THAT(complaint([&] { CHECK(yes == false); }), HasSubstr("failed: true == false"));
    const ServerId four = server_id(4);
    EXPECT_THAT(complaint([&] { CHECK(four == server_id(5)); }), HasSubstr("failed: 4 == 5"));
}

TEST(Check, AsksForNothingThatAValueCannotDo) {
    struct Mute {
        bool operator==(const Mute&) const { return false; }
    };
    EXPECT_THAT(complaint([&] { CHECK(Mute{} == Mute{}); }), HasSubstr("failed: ? == ?"));
}

TEST(Check, EvaluatesItsExpressionOnce) {
    int calls = 0;
    const auto next = [&] { return ++calls; };
    CHECK(next() == 1);
    EXPECT_EQ(calls, 1);
    complaint([&] { CHECK(next() == 1); });
    EXPECT_EQ(calls, 2);
}

TEST(Check, IsOneStatement) {
    const bool skip = true;
    if (skip)
        SUCCEED();
    else
        CHECK(skip);
}

TEST(DebugCheck, IsACheckInDebugAndSanitizerBuildsAndNothingInOthers) {
    int calls = 0;
    const std::string message = complaint([&] { DCHECK(++calls == 2); });
#ifdef SWATH_DCHECK
    EXPECT_THAT(message, HasSubstr("failed: 1 == 2"));
    EXPECT_EQ(calls, 1);
#else
    EXPECT_EQ(message, "");
    EXPECT_EQ(calls, 0);
#endif
}

}  // namespace
}  // namespace swath
