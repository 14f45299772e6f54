#include "common/base/names.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace swath {
namespace {

enum class TestColour { kRed = 1, kGreen, kBlue };

}  // namespace

template <>
inline constexpr auto kNames<TestColour> = names_of<TestColour>(
    "colour", {{TestColour::kRed, "red"}, {TestColour::kGreen, "light green"}, {TestColour::kBlue, "blue"}});

namespace {

static_assert(NamedEnum<TestColour>);
static_assert(!NamedEnum<int>);
static_assert(kAll<TestColour>.size() == 3);

TEST(Names, AreReadBack) {
    for (const TestColour colour : kAll<TestColour>) EXPECT_EQ(parse<TestColour>(name_of(colour)), colour);
    EXPECT_EQ(name_of(TestColour::kGreen), "light green");
}

TEST(Names, ThatAreUnknownAreAnErrorThatListsTheKnownOnes) {
    EXPECT_EQ(parse<TestColour>("pink").error().message,
              "colour 'pink' is not known; there are: red, light green, blue");
    EXPECT_FALSE(parse<TestColour>("").has_value());
}

TEST(Names, OfNumbersThatAreNoValueAreNone) {
    EXPECT_EQ(value_of<TestColour>(3), TestColour::kBlue);
    EXPECT_EQ(value_of<TestColour>(0), std::nullopt);
    EXPECT_EQ(value_of<TestColour>(std::uint64_t{1} << 32 | 1), std::nullopt);
}

TEST(Names, BelongToEveryValue) { EXPECT_THROW(name_of(static_cast<TestColour>(9)), CheckFailed); }

}  // namespace
}  // namespace swath
