// Every way to sort returns the same as a stable sort.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "common/base/check.h"
#include "common/published/resource/counting_sort.h"
#include "common/published/resource/key_order.h"
#include "common/published/resource/radix_sort.h"
#include "common/published/resource/rank_bitmap.h"
#include "common/published/resource/resource_array.h"
#include "common/published/resource/resource_sorter.h"
#include "common/published/resource/resource_space.h"
#include "tests/common/published/resource/sample.h"

namespace swath {
namespace {

constexpr std::uint64_t kAllPoints = std::uint64_t{1} << 32;

// All ways to sort the same objects. Those that keep something for each point sit out large spaces.
class Sorters {
  public:
    Sorters(const Ids& keys, std::uint64_t points, std::size_t members)
        : keys_(keys),
          team_(members, kClock),
          order_(keys_, team_),
          radix_(keys_, points, team_, SharingMode::kAlways),
          sorter_(keys_, team_) {
        if (points <= 200'000)
            counting_ = std::make_unique<CountingSort>(keys_, points, team_, SharingMode::kAlways);
        if (points * members <= 1'000'000)
            literal_ = std::make_unique<LiteralSort>(*LiteralSort::make(keys_, points, team_));
        for (const InstructionSet set : instruction_sets())
            bitmaps_.push_back(std::make_unique<RankBitmap>(order_, team_, set, SharingMode::kAlways));
    }

    void expect_order(const Ids& visible) {
        const Ids expected = by_key_and_id(keys_, visible);
        // ASSERT_TRUE, because ASSERT_EQ would print a million numbers.
        ASSERT_TRUE(copy(radix_.sort(visible)) == expected);
        ASSERT_TRUE(!counting_ || copy(counting_->sort(visible)) == expected);
        ASSERT_TRUE(!literal_ || copy(literal_->sort(visible)) == expected);
        for (std::size_t i = 0; i < bitmaps_.size(); ++i)
            ASSERT_TRUE(copy(bitmaps_[i]->sort(visible)) == expected) << name(instruction_sets()[i]);
        ASSERT_TRUE(copy(sorter_.sort(visible)) == expected) << name_of(sorter_.method());
    }

    void expect_order_of_shares(unsigned seed) {
        for (const double share : {0.0, 0.001, 0.05, 0.1, 0.5, 0.97, 1.0}) {
            SCOPED_TRACE("share " + std::to_string(share));
            ASSERT_NO_FATAL_FAILURE(expect_order(some_ids(keys_.size(), share, seed)));
        }
    }

  private:
    Ids keys_;
    ThreadTeam team_;
    KeyOrder order_;
    RadixSort radix_;
    ResourceSorter sorter_;
    std::unique_ptr<CountingSort> counting_;
    std::unique_ptr<LiteralSort> literal_;
    std::vector<std::unique_ptr<RankBitmap>> bitmaps_;
};

TEST(Sorting, IsThatOfAStableSortForAnyNumberOfObjectsAndPoints) {
    for (const std::size_t objects : {0u, 1u, 2u, 63u, 64u, 65u, 127u, 1000u, 5003u})
        for (const std::uint64_t points :
             {1ull, 2ull, 3ull, 2048ull, 2049ull, 131'072ull, 5'000'000ull, 1ull << 32}) {
            SCOPED_TRACE(std::to_string(objects) + " objects, " + std::to_string(points) + " points");
            Sorters sorters(random_keys(objects, points, 3), points, 1);
            ASSERT_NO_FATAL_FAILURE(sorters.expect_order_of_shares(4));
        }
}

TEST(Sorting, IsThatOfAStableSortForTeamsOfAnySize) {
    for (const std::size_t members : {2u, 3u, 6u, 13u, 64u})
        for (const std::uint64_t points : {17ull, 50'000ull, 1ull << 32}) {
            SCOPED_TRACE(std::to_string(members) + " members, " + std::to_string(points) + " points");
            Sorters sorters(random_keys(150'001, points, 5), points, members);
            ASSERT_NO_FATAL_FAILURE(sorters.expect_order_of_shares(6));
        }
}

TEST(Sorting, IsThatOfAStableSortForAMillionObjectsOnManyMembers) {
    Sorters sorters(random_keys(1'200'000, 131'072, 8), 131'072, 64);
    sorters.expect_order_of_shares(9);
}

TEST(Sorting, KeepsTheOrderOfObjectsThatShareOneKey) {
    for (const std::size_t members : {1u, 4u}) {
        Sorters first(Ids(70'000, 0), 1, members);
        ASSERT_NO_FATAL_FAILURE(first.expect_order_of_shares(1));
        Sorters last(Ids(70'000, 0xffffffff), kAllPoints, members);
        ASSERT_NO_FATAL_FAILURE(last.expect_order_of_shares(2));
    }
}

TEST(Sorting, TurnsRoundObjectsWhoseKeysDescendAndAreAllDistinct) {
    Ids keys(100'003);
    for (std::size_t id = 0; id < keys.size(); ++id)
        keys[id] = static_cast<std::uint32_t>(keys.size() - 1 - id);
    for (const std::size_t members : {1u, 3u}) {
        Sorters sorters(keys, keys.size(), members);
        ASSERT_NO_FATAL_FAILURE(sorters.expect_order_of_shares(3));
    }
}

TEST(Sorting, OrdersByTheDimensionsOneAfterTheOther) {
    std::mt19937 random(11);
    for (std::size_t dimensions = 1; dimensions <= 5; ++dimensions) {
        std::vector<std::uint64_t> sizes;
        for (std::size_t i = 0; i < dimensions; ++i) sizes.push_back(1 + random() % 12);
        const ResourceSpace space = *ResourceSpace::make(sizes);
        std::vector<std::vector<std::uint32_t>> resources(3000);
        Ids keys;
        for (auto& coordinates : resources) {
            for (const std::uint64_t size : sizes)
                coordinates.push_back(static_cast<std::uint32_t>(random() % size));
            keys.push_back(*space.key(coordinates));
        }
        Sorters sorters(keys, space.points(), 2);
        ASSERT_NO_FATAL_FAILURE(sorters.expect_order_of_shares(12));
        ThreadTeam team(1, kClock);
        ResourceSorter sorter(keys, team);
        const Ids visible = some_ids(keys.size(), 0.5, 13);
        const std::span<const std::uint32_t> sorted = sorter.sort(visible);
        for (std::size_t i = 1; i < sorted.size(); ++i)
            ASSERT_LE(resources[sorted[i - 1]], resources[sorted[i]]);
    }
}

TEST(Sorting, ForgetsTheFrameBefore) {
    Sorters sorters(random_keys(200'000, 131'072, 14), 131'072, 4);
    for (unsigned frame = 0; frame < 12; ++frame) {
        const double share = frame % 3 == 0 ? 0.9 : frame % 3 == 1 ? 0.0002 : 0.2;
        ASSERT_NO_FATAL_FAILURE(sorters.expect_order(some_ids(200'000, share, frame)));
    }
}

TEST(RadixDigits, AreAsFewAndAsEqualAsTheyCanBe) {
    const auto digits = [](std::uint64_t points) {
        const RadixDigits found = radix_digits(points);
        return std::vector<int>(found.bits.begin(), found.bits.begin() + found.count);
    };
    EXPECT_EQ(digits(0), (std::vector<int>{}));
    EXPECT_EQ(digits(1), (std::vector<int>{}));
    EXPECT_EQ(digits(2), (std::vector<int>{1}));
    EXPECT_EQ(digits(2048), (std::vector<int>{11}));
    EXPECT_EQ(digits(2049), (std::vector<int>{6, 6}));
    EXPECT_EQ(digits(131'072), (std::vector<int>{9, 8}));
    EXPECT_EQ(digits(1 << 22), (std::vector<int>{11, 11}));
    EXPECT_EQ(digits(kAllPoints), (std::vector<int>{11, 11, 10}));
    EXPECT_THROW(radix_digits(kAllPoints + 1), CheckFailed);
}

TEST(Sorting, RefusesAKeyThatIsNoPoint) {
    ThreadTeam team(1, kClock);
    const Ids keys{3, 10};
    EXPECT_THROW(RadixSort(keys, 10, team), CheckFailed);
    EXPECT_THROW(CountingSort(keys, 10, team), CheckFailed);
    EXPECT_THROW((void)LiteralSort::make(keys, 10, team), CheckFailed);
}

}  // namespace
}  // namespace swath
