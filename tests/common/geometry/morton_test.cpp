#include "common/geometry/morton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace swath {
namespace {

Box around(const glm::vec3& centre) { return {centre - glm::vec3(0.5f), centre + glm::vec3(0.5f)}; }

TEST(MortonCode, InterleavesTheBitsOfTheCellWithXLowest) {
    const glm::dvec3 min(0);
    const glm::dvec3 size(1 << kMortonDepth);
    EXPECT_EQ(morton_code({0.5, 0.5, 0.5}, min, size), 0u);
    EXPECT_EQ(morton_code({1.5, 0.5, 0.5}, min, size), 1u);
    EXPECT_EQ(morton_code({0.5, 1.5, 0.5}, min, size), 2u);
    EXPECT_EQ(morton_code({0.5, 0.5, 1.5}, min, size), 4u);
    EXPECT_EQ(morton_code({2.5, 3.5, 0.5}, min, size), 0b011'010u);
    EXPECT_EQ(morton_code({1e9, 1e9, 1e9}, min, size), (1u << kMortonBits) - 1);
    EXPECT_EQ(morton_code({-1, -1, -1}, min, size), 0u);
}

TEST(MortonOrder, IsAPermutationByCodeAndThenByPlace) {
    std::mt19937 random(3);
    std::vector<Box> boxes;
    // Few positions, so that many share a code.
    const auto number = [&] { return static_cast<float>(random() % 5); };
    for (int i = 0; i < 3000; ++i) {
        const float x = number();
        const float y = number();
        boxes.push_back(around({x, y, number()}));
    }
    const std::vector<std::uint32_t> order = morton_order(boxes);
    std::vector<std::uint32_t> sorted = order;
    std::ranges::sort(sorted);
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(sorted, all);
    const auto key = [&](std::uint32_t i) {
        const std::uint32_t code =
            morton_code(glm::dvec3(boxes[i].centre()), glm::dvec3(-0.5), glm::dvec3(5));
        return std::pair(code, i);
    };
    EXPECT_TRUE(std::ranges::is_sorted(order, {}, key));
    EXPECT_FALSE(std::ranges::is_sorted(order));
}

TEST(MortonOrder, TakesBoxesThatAreEmptyOrNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<Box> boxes{around({9, 9, 9}), Box{}, around({nan, 0, 0}), around({0, 0, 0}),
                                 Box{glm::vec3(0), glm::vec3(infinity)}};
    EXPECT_THAT(morton_order(boxes), testing::ElementsAre(1, 2, 4, 3, 0));
    EXPECT_TRUE(morton_order({}).empty());
}

}  // namespace
}  // namespace swath
