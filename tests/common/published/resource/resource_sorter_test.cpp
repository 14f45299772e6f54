#include "common/published/resource/resource_sorter.h"

#include <gtest/gtest.h>

#include "tests/common/published/resource/sample.h"

namespace swath {
namespace {

TEST(ResourceSorter, ChoosesByHowManyAreVisible) {
    ThreadTeam team(1, kClock);
    const ResourceSorter few_points(random_keys(100'000, 1000, 1), team);
    EXPECT_EQ(few_points.method_for(44), SortMethod::kRadix);
    EXPECT_EQ(few_points.method_for(5000), SortMethod::kCounting);
    EXPECT_EQ(few_points.method_for(30'000), SortMethod::kRankBitmap);
    EXPECT_EQ(few_points.method_for(100'000), SortMethod::kNone);
    const ResourceSorter many_points(random_keys(100'000, 1 << 30, 1), team);
    EXPECT_EQ(many_points.method_for(44), SortMethod::kRadix);
    EXPECT_EQ(many_points.method_for(5000), SortMethod::kRadix);
    EXPECT_EQ(many_points.method_for(30'000), SortMethod::kRankBitmap);
}

TEST(ResourceSorter, TellsWhatItChose) {
    ThreadTeam team(1, kClock);
    ResourceSorter sorter(random_keys(100'000, 1000, 1), team);
    for (const double share : {0.0001, 0.05, 0.5, 1.0}) {
        const Ids visible = some_ids(100'000, share, 2);
        sorter.sort(visible);
        EXPECT_EQ(sorter.method(), sorter.method_for(visible.size()));
    }
    EXPECT_EQ(name_of(SortMethod::kNone), "none");
    EXPECT_EQ(name_of(SortMethod::kRankBitmap), "bitmap");
    EXPECT_EQ(name_of(SortMethod::kCounting), "counting");
    EXPECT_EQ(name_of(SortMethod::kRadix), "radix");
}

TEST(ResourceSorter, PassesOnWhatIsNumberedByKeyAlready) {
    ThreadTeam team(1, kClock);
    ResourceSorter sorter(Ids{2, 2, 5, 7, 7}, team);
    const Ids visible{0, 2, 4};
    EXPECT_EQ(sorter.sort(visible).data(), visible.data());
    EXPECT_EQ(sorter.method(), SortMethod::kNone);
}

TEST(ResourceSorter, HasNoObjects) {
    ThreadTeam team(3, kClock);
    ResourceSorter sorter({}, team);
    EXPECT_TRUE(sorter.sort({}).empty());
}

}  // namespace
}  // namespace swath
