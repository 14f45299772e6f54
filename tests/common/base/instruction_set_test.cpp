#include "common/base/instruction_set.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace swath {
namespace {

TEST(InstructionSet, BeginsWithWhatEveryProcessorHasAndEndsWithTheBest) {
    const auto sets = instruction_sets();
    ASSERT_FALSE(sets.empty());
    EXPECT_EQ(sets.front(), InstructionSet::kPortable);
    EXPECT_TRUE(std::is_sorted(sets.begin(), sets.end()));
    EXPECT_EQ(best_instruction_set(), sets.back());
    EXPECT_EQ(name(InstructionSet::kAvx512), "avx512");
}

}  // namespace
}  // namespace swath
