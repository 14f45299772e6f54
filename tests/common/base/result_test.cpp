#include "common/base/result.h"

#include <gtest/gtest.h>

#include <memory>

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

}  // namespace
}  // namespace swath
