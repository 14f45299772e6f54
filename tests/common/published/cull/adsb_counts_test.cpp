// The node counts that the ADSB paper prints in tables 2 and 3: the nodes of a tree of 9 levels that each of
// four processors tests, at split levels 0 to 4.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "common/published/cull/published_walk.h"
#include "tests/common/published/cull/frusta.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using Counts = std::array<std::uint64_t, 4>;

using test::kClock;
const UniformOctree kNineLevels(8);

class AdsbCounts : public testing::Test {
  protected:
    Counts counts_at(int split_level, const Frustum& frustum) {
        walk_->force_split_level(split_level);
        const WalkReport& report = walk_->walk(frustum);
        EXPECT_EQ(report.split_level, split_level);
        Counts counts{};
        for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = report.members.at(i).nodes_tested;
        return counts;
    }

    ThreadTeam team_{4, kClock};
    std::unique_ptr<PublishedWalk> walk_ = make_published_walk(PublishedAlgorithm::kAdsb, kNineLevels, team_);
};

TEST_F(AdsbCounts, AreThoseOfTable2AtTheCentre) {
    const Frustum centre = adsb_frustum({128, 115.5f, 128});
    EXPECT_EQ(counts_at(0, centre), (Counts{2019, 482, 482, 2018}));
    EXPECT_EQ(counts_at(1, centre), (Counts{2025, 480, 480, 2016}));
    EXPECT_EQ(counts_at(2, centre), (Counts{2073, 464, 464, 2000}));
    EXPECT_EQ(counts_at(3, centre), (Counts{897, 1880, 1880, 344}));
    EXPECT_EQ(counts_at(4, centre), (Counts{4761, 80, 80, 80}));
}

TEST_F(AdsbCounts, AreThoseOfTable3InTheCorner) {
    const Frustum corner = adsb_frustum({224, 213.75f, 224});
    EXPECT_EQ(counts_at(0, corner), (Counts{4435, 2, 2, 2}));
    EXPECT_EQ(counts_at(1, corner), (Counts{4435, 2, 2, 2}));
    EXPECT_EQ(counts_at(2, corner), (Counts{1945, 1888, 304, 304}));
    EXPECT_EQ(counts_at(3, corner), (Counts{1033, 2512, 448, 448}));
    EXPECT_EQ(counts_at(4, corner), (Counts{4441, 0, 0, 0}));
}

}  // namespace
}  // namespace swath
