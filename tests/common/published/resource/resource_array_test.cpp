#include "common/published/resource/resource_array.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "tests/common/published/resource/sample.h"

namespace swath {
namespace {

std::vector<ResourceArray> arrays_of(std::size_t members, std::uint64_t points) {
    return std::vector<ResourceArray>(members, *ResourceArray::make(points));
}

TEST(ResourceArray, CountsAndListsTheObjectsOfAPoint) {
    ResourceArray array = *ResourceArray::make(3);
    array.add(2, 7);
    array.add(0, 5);
    array.add(2, 6);
    EXPECT_EQ(array.count(0), 1u);
    EXPECT_EQ(array.count(1), 0u);
    EXPECT_EQ(array.count(2), 2u);
    EXPECT_EQ(copy(array.list(2)), (Ids{7, 6}));
    array.clear();
    EXPECT_EQ(array.count(2), 0u);
    EXPECT_TRUE(array.list(2).empty());
}

// The papers' figure 8, with fewer points: four processors.
TEST(ResourceArray, MergesByAddingCountsAndJoiningListsInTheOrderOfMembers) {
    ThreadTeam team(4, kClock);
    std::vector<ResourceArray> arrays = arrays_of(4, 3);
    arrays[0].add(1, 10);
    arrays[2].add(1, 3);
    arrays[2].add(1, 4);
    arrays[3].add(1, 2);
    arrays[3].add(2, 1);
    ResourceArray merged = *ResourceArray::make(3);
    merged.add(0, 99);
    merge(arrays, team, merged);
    EXPECT_EQ(merged.count(0), 0u);
    EXPECT_TRUE(merged.list(0).empty());
    EXPECT_EQ(merged.count(1), 4u);
    EXPECT_EQ(copy(merged.list(1)), (Ids{10, 3, 4, 2}));
    EXPECT_EQ(copy(merged.list(2)), (Ids{1}));
    for (const ResourceArray& array : arrays)
        for (std::uint32_t point = 0; point < 3; ++point) {
            EXPECT_EQ(array.count(point), 0u);
            EXPECT_TRUE(array.list(point).empty());
        }
}

TEST(ResourceArray, MergesTheSameWhateverTheTeamFrameAfterFrame) {
    const std::uint64_t points = 97;
    for (const std::size_t size : {1u, 2u, 3u, 7u, 64u}) {
        ThreadTeam team(size, kClock);
        std::vector<ResourceArray> arrays = arrays_of(5, points);
        ResourceArray merged = *ResourceArray::make(points);
        for (unsigned frame = 0; frame < 4; ++frame) {
            const Ids keys = random_keys(500 * frame, points, frame);
            std::vector<Ids> expected(points);
            for (std::size_t member = 0; member < 5; ++member)
                for (std::size_t id = member; id < keys.size(); id += 5) {
                    arrays[member].add(keys[id], static_cast<std::uint32_t>(id));
                    expected[keys[id]].push_back(static_cast<std::uint32_t>(id));
                }
            merge(arrays, team, merged);
            for (std::uint32_t point = 0; point < points; ++point) {
                ASSERT_EQ(copy(merged.list(point)), expected[point]);
                ASSERT_EQ(merged.count(point), expected[point].size());
            }
        }
    }
}

TEST(ResourceArray, RefusesASpaceThatIsTooLargeAndArraysOfAnother) {
    EXPECT_EQ(ResourceArray::make(16'777'217).error().message,
              "resource array: 16777217 points, of which it can have 16777216");
    ThreadTeam team(1, kClock);
    EXPECT_FALSE(LiteralSort::make({}, 16'777'217, team));
    std::vector<ResourceArray> arrays = arrays_of(2, 3);
    ResourceArray merged = *ResourceArray::make(4);
    EXPECT_THROW(merge(arrays, team, merged), CheckFailed);
}

TEST(LiteralSort, ShowsTheMergedArray) {
    ThreadTeam team(2, kClock);
    const Ids keys{1, 0, 1, 1};
    LiteralSort sort = *LiteralSort::make(keys, 2, team);
    EXPECT_EQ(copy(sort.sort(Ids{0, 1, 3})), (Ids{1, 0, 3}));
    EXPECT_EQ(sort.merged().count(1), 2u);
    EXPECT_EQ(copy(sort.merged().list(1)), (Ids{0, 3}));
}

}  // namespace
}  // namespace swath
