#include "common/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

namespace swath {
namespace {

Result<int> half(int number) {
    if (number % 2 != 0) return fail("number: {} is odd", number);
    return number / 2;
}

Status check_half(int number) {
    const Result<int> result = half(number);
    if (!result) return fail_in("config.toml", result.error());
    return {};
}

Result<std::string> text_of_half(int number) {
    SWATH_TRY(const int value, half(number));
    return std::to_string(value);
}

// Takes the arguments of a call with commas, and assigns to what is there.
Result<std::pair<int, int>> halves(std::pair<int, int> numbers) {
    std::pair<int, int> values;
    SWATH_TRY(values.first, half(numbers.first));
    SWATH_TRY(values.second, std::pair<int, int>{0, 0} == numbers ? Result<int>(0) : half(numbers.second));
    return values;
}

Status check_both(int one, int other, bool wanted) {
    if (wanted)
        SWATH_TRY_VOID(half(one));
    else
        SWATH_TRY_VOID(check_half(other));
    return {};
}

Result<std::unique_ptr<int>> made(bool good) {
    if (!good) return fail("nothing was made");
    return std::make_unique<int>(7);
}

Result<int> content(bool good) {
    SWATH_TRY(const std::unique_ptr<int> number, made(good));
    return *number;
}

TEST(Result, HoldsTheValue) {
    const Result<int> result = half(8);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(*result, 4);
}

TEST(Result, HoldsTheFormattedError) {
    const Result<int> result = half(3);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error(), Error{"number: 3 is odd"});
}

TEST(Result, PassesAnErrorOnWithThePlace) {
    EXPECT_TRUE(check_half(2).has_value());
    EXPECT_EQ(check_half(5).error().message, "config.toml: number: 5 is odd");
}

TEST(Result, LeavesBracesOfAnErrorAlone) {
    EXPECT_EQ(fail_in("{}", Error{"{broken"}).value().message, "{}: {broken");
}

TEST(Result, CarriesValuesThatOnlyMove) {
    Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
    const std::unique_ptr<int> taken = std::move(*result);
    EXPECT_EQ(*taken, 7);
}

TEST(Result, TryGivesTheValueOrLeavesWithTheError) {
    EXPECT_EQ(text_of_half(8), "4");
    EXPECT_EQ(text_of_half(3).error().message, "number: 3 is odd");
    EXPECT_EQ(halves({2, 4}), std::pair(1, 2));
    EXPECT_EQ(halves({2, 5}).error().message, "number: 5 is odd");
}

TEST(Result, TryMovesTheValue) {
    EXPECT_EQ(content(true), 7);
    EXPECT_EQ(content(false).error().message, "nothing was made");
}

TEST(Result, TryVoidIsOneStatement) {
    EXPECT_TRUE(check_both(2, 3, true).has_value());
    EXPECT_EQ(check_both(3, 2, true).error().message, "number: 3 is odd");
    EXPECT_TRUE(check_both(3, 2, false).has_value());
    EXPECT_EQ(check_both(2, 3, false).error().message, "config.toml: number: 3 is odd");
}

}  // namespace
}  // namespace swath
