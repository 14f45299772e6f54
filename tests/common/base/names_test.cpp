#include "common/base/names.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace swath {
namespace {

enum class Colour { kRed = 1, kGreen, kBlue };

}  // namespace

template <>
inline constexpr auto kNames<Colour> = names_of<Colour>("colour", {{Colour::kRed, "red"},
                                                                   {Colour::kGreen, "light green"},
                                                                   {Colour::kBlue, "blue"}});

namespace {

static_assert(NamedEnum<Colour>);
static_assert(!NamedEnum<int>);
static_assert(kAll<Colour>.size() == 3);

TEST(Names, AreReadBack) {
    for (const Colour colour : kAll<Colour>) EXPECT_EQ(parse<Colour>(name_of(colour)), colour);
    EXPECT_EQ(name_of(Colour::kGreen), "light green");
}

TEST(Names, ThatAreUnknownAreAnErrorThatListsTheKnownOnes) {
    EXPECT_EQ(parse<Colour>("pink").error().message,
              "colour 'pink' is not known; there are: red, light green, blue");
    EXPECT_FALSE(parse<Colour>("").has_value());
}

TEST(Names, OfNumbersThatAreNoValueAreNone) {
    EXPECT_EQ(value_of<Colour>(3), Colour::kBlue);
    EXPECT_EQ(value_of<Colour>(0), std::nullopt);
    EXPECT_EQ(value_of<Colour>(std::uint64_t{1} << 32 | 1), std::nullopt);
}

TEST(Names, BelongToEveryValue) { EXPECT_THROW(name_of(static_cast<Colour>(9)), CheckFailed); }

}  // namespace
}  // namespace swath
