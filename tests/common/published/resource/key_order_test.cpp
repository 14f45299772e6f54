#include "common/published/resource/key_order.h"

#include <gtest/gtest.h>

#include "tests/common/published/resource/sample.h"

namespace swath {
namespace {

TEST(KeyOrder, RanksObjectsByKeyThenId) {
    ThreadTeam team(1, kClock);
    const KeyOrder order(Ids{30, 7, 30, 4'000'000'000, 7}, team);
    EXPECT_EQ(copy(order.ids()), (Ids{1, 4, 0, 2, 3}));
    EXPECT_EQ(copy(order.ranks()), (Ids{2, 0, 3, 4, 1}));
    EXPECT_FALSE(order.ids_are_ranks());
}

TEST(KeyOrder, NumbersThePointsThatHaveObjects) {
    ThreadTeam team(1, kClock);
    const KeyOrder order(Ids{30, 7, 30, 4'000'000'000, 7}, team);
    EXPECT_EQ(order.points(), 3u);
    EXPECT_EQ(copy(order.point_of()), (Ids{1, 0, 1, 2, 0}));
}

TEST(KeyOrder, SeesThatObjectsAreNumberedInTheOrderOfTheirKeys) {
    ThreadTeam team(1, kClock);
    EXPECT_TRUE(KeyOrder(Ids{3, 3, 8, 9}, team).ids_are_ranks());
    EXPECT_FALSE(KeyOrder(Ids{3, 3, 9, 8}, team).ids_are_ranks());
    EXPECT_TRUE(KeyOrder(Ids{5}, team).ids_are_ranks());
}

TEST(KeyOrder, OfNothingIsEmpty) {
    ThreadTeam team(2, kClock);
    const KeyOrder order({}, team);
    EXPECT_EQ(order.size(), 0u);
    EXPECT_EQ(order.points(), 0u);
    EXPECT_TRUE(order.ids_are_ranks());
}

TEST(KeyOrder, IsWhatAStableSortMakesOfAllObjectsWhateverTheTeam) {
    for (const std::size_t members : {1u, 2u, 5u})
        for (const std::uint64_t points : {1ull, 2ull, 1000ull, 100'000ull, 1ull << 32}) {
            ThreadTeam team(members, kClock);
            const Ids keys = random_keys(50'000, points, 7);
            const KeyOrder order(keys, team);
            ASSERT_EQ(copy(order.ids()), by_key_and_id(keys, all_ids(keys.size())));
            for (std::uint32_t rank = 0; rank < keys.size(); ++rank) {
                const std::uint32_t id = order.ids()[rank];
                ASSERT_EQ(order.ranks()[id], rank);
                if (rank == 0) continue;
                const std::uint32_t before = order.ids()[rank - 1];
                ASSERT_EQ(order.point_of()[id] - order.point_of()[before],
                          keys[id] != keys[before] ? 1u : 0u);
            }
            EXPECT_EQ(order.point_of()[order.ids().back()] + 1, order.points());
        }
}

}  // namespace
}  // namespace swath
