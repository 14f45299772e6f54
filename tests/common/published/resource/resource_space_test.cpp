#include "common/published/resource/resource_space.h"

#include <gtest/gtest.h>

#include <random>

#include "common/base/check.h"

namespace swath {
namespace {

using Sizes = std::vector<std::uint64_t>;
using Coordinates = std::vector<std::uint32_t>;

std::string problem_of(const Sizes& sizes) {
    const Result<ResourceSpace> space = ResourceSpace::make(sizes);
    return space ? "none" : space.error().message;
}

TEST(ResourceSpace, NumbersPointsWithTheFirstDimensionMostSignificant) {
    const ResourceSpace space = *ResourceSpace::make(Sizes{8, 256, 64});
    EXPECT_EQ(space.points(), 131'072u);
    EXPECT_EQ(space.dimensions(), 3u);
    EXPECT_EQ(*space.key(Coordinates{0, 0, 0}), 0u);
    EXPECT_EQ(*space.key(Coordinates{0, 0, 1}), 1u);
    EXPECT_EQ(*space.key(Coordinates{0, 1, 0}), 64u);
    EXPECT_EQ(*space.key(Coordinates{1, 0, 0}), 16'384u);
    EXPECT_EQ(*space.key(Coordinates{7, 255, 63}), 131'071u);
    EXPECT_EQ(space.coordinates(16'384 + 2 * 64 + 3), (Coordinates{1, 2, 3}));
}

TEST(ResourceSpace, FindsEveryPointAgainInAnyNumberOfDimensions) {
    std::mt19937 random(1);
    for (std::size_t dimensions = 1; dimensions <= 5; ++dimensions) {
        Sizes sizes;
        for (std::size_t i = 0; i < dimensions; ++i) sizes.push_back(1 + random() % 9);
        const ResourceSpace space = *ResourceSpace::make(sizes);
        Coordinates last;
        for (std::uint32_t key = 0; key < space.points(); ++key) {
            const Coordinates coordinates = space.coordinates(key);
            ASSERT_EQ(*space.key(coordinates), key);
            ASSERT_TRUE(key == 0 || last < coordinates);
            last = coordinates;
        }
    }
}

TEST(ResourceSpace, HasRoomForAsManyPointsAsThereAreKeys) {
    const ResourceSpace space = *ResourceSpace::make(Sizes{65'536, 1, 65'536});
    EXPECT_EQ(space.points(), std::uint64_t{1} << 32);
    EXPECT_EQ(*space.key(Coordinates{65'535, 0, 65'535}), 0xffffffffu);
    EXPECT_EQ(space.coordinates(0xffffffffu), (Coordinates{65'535, 0, 65'535}));
    EXPECT_EQ(ResourceSpace::make(Sizes{std::uint64_t{1} << 32})->points(), std::uint64_t{1} << 32);
}

TEST(ResourceSpace, SaysWhatIsWrongWithSizes) {
    EXPECT_EQ(problem_of({}), "resource space: there must be at least one dimension");
    EXPECT_EQ(problem_of({8, 0, 64}), "resource space: dimension 1 has no resources; at least 1 is needed");
    EXPECT_EQ(problem_of({65'536, 65'536, 2}),
              "resource space: with dimension 2 (of 2) there are more than 4294967296 points");
    // This product overflows 64 bits to something small.
    EXPECT_EQ(
        problem_of({4, std::uint64_t{1} << 62}),
        "resource space: with dimension 1 (of 4611686018427387904) there are more than 4294967296 points");
}

TEST(ResourceSpace, SaysWhatIsWrongWithCoordinates) {
    const ResourceSpace space = *ResourceSpace::make(Sizes{8, 256});
    EXPECT_EQ(space.key(Coordinates{1}).error().message, "resource space: 1 coordinates for 2 dimensions");
    EXPECT_EQ(space.key(Coordinates{1, 256}).error().message,
              "resource space: coordinate 256 in dimension 1, which has 256 resources");
    EXPECT_THROW(space.coordinates(2048), CheckFailed);
}

}  // namespace
}  // namespace swath
