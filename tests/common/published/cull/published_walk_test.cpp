#include "common/published/cull/published_walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/published/cull/split_level.h"
#include "tests/common/published/cull/frusta.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using Codes = std::vector<std::uint32_t>;

using test::kClock;
constexpr std::array kAlgorithms{PublishedAlgorithm::kAdsb,       PublishedAlgorithm::kAlgo1,
                                 PublishedAlgorithm::kAlgo2,      PublishedAlgorithm::kAlgo3,
                                 PublishedAlgorithm::kAlgo4,      PublishedAlgorithm::kAlgo5,
                                 PublishedAlgorithm::kAlgo1Lanes, PublishedAlgorithm::kAlgo4Lanes};

// True for A2SSB, which goes in two steps from the start level.
bool has_two_steps(PublishedAlgorithm algorithm) {
    return algorithm == PublishedAlgorithm::kAlgo1 || algorithm == PublishedAlgorithm::kAlgo2 ||
           algorithm == PublishedAlgorithm::kAlgo3 || algorithm == PublishedAlgorithm::kAlgo1Lanes;
}

Codes brute_force(const UniformOctree& tree, const Frustum& frustum) {
    Codes codes;
    for (std::uint32_t code = 0; code < tree.leaf_count(); ++code)
        if (!outside(frustum, tree.box_of(tree.height(), code))) codes.push_back(code);
    return codes;
}

// The leaves of all members; a leaf that was found twice is there twice.
Codes sorted_leaves(const WalkReport& report) {
    Codes codes;
    for (const MemberReport& member : report.members)
        codes.insert(codes.end(), member.leaves.begin(), member.leaves.end());
    std::ranges::sort(codes);
    return codes;
}

std::uint64_t nodes_tested(const WalkReport& report) {
    std::uint64_t sum = 0;
    for (const MemberReport& member : report.members) sum += member.nodes_tested;
    return sum;
}

TEST(PublishedWalk, FindsTheLeavesThatBruteForceFindsForAnyTeamTreeAndView) {
    for (int height = 0; height <= 5; ++height) {
        const UniformOctree shape(height);
        const PointerOctree stored(shape, AllocationOrder::kDepthFirst);
        const std::vector<Frustum> frusta =
            all_sorts_of_frusta(shape.edge(), 3, 7u + static_cast<unsigned>(height));
        std::vector<Codes> expected;
        for (const Frustum& frustum : frusta) expected.push_back(brute_force(shape, frustum));
        for (const std::size_t members : {1u, 3u, 5u, 6u, 7u, 8u, 31u, 64u}) {
            ThreadTeam team(members, kClock);
            for (const PublishedAlgorithm algorithm : kAlgorithms) {
                const auto over_stored = make_published_walk(algorithm, stored, team);
                const auto over_computed = make_published_walk(algorithm, shape, team);
                for (std::size_t i = 0; i < frusta.size(); ++i) {
                    ASSERT_EQ(sorted_leaves(over_stored->walk(frusta[i])), expected[i])
                        << name_of(algorithm) << " stored, height " << height << ", " << members
                        << " members, frustum " << i;
                    ASSERT_EQ(sorted_leaves(over_computed->walk(frusta[i])), expected[i])
                        << name_of(algorithm) << " computed, height " << height << ", " << members
                        << " members, frustum " << i;
                }
            }
        }
    }
}

// As printed, algorithm 5 loses N mod p of the N nodes at the split level.
TEST(PublishedWalk, FindsThemAtEverySplitLevelForEveryNumberOfMembers) {
    const UniformOctree shape(3);
    const PointerOctree stored(shape, AllocationOrder::kBreadthFirst);
    const Frustum frustum = all_sorts_of_frusta(shape.edge(), 1, 3)[0];
    const Codes expected = brute_force(shape, frustum);
    EXPECT_GT(expected.size(), 10u);
    EXPECT_LT(expected.size(), shape.leaf_count());
    for (std::size_t members = 1; members <= 64; ++members) {
        ThreadTeam team(members, kClock);
        for (const PublishedAlgorithm algorithm : kAlgorithms) {
            if (algorithm != PublishedAlgorithm::kAdsb && !has_two_steps(algorithm)) continue;
            const auto walk = make_published_walk(algorithm, stored, team);
            for (int level = -1; level <= 4; ++level) {
                walk->force_split_level(level);
                const WalkReport& report = walk->walk(frustum);
                ASSERT_EQ(sorted_leaves(report), expected)
                    << name_of(algorithm) << " at level " << level << ", " << members << " members";
                const int first = algorithm == PublishedAlgorithm::kAdsb ? 0 : start_level(members);
                ASSERT_EQ(report.split_level, std::clamp(level, first, 3));
                ASSERT_EQ(report.members.size(), members);
            }
        }
    }
}

TEST(PublishedWalk, TestsEveryNodeOnceWhenEverythingIsVisible) {
    const UniformOctree shape(6);
    const PointerOctree stored(shape, AllocationOrder::kRandom, 5);
    ThreadTeam team(4, kClock);
    for (const PublishedAlgorithm algorithm : kAlgorithms) {
        const auto walk = make_published_walk(algorithm, stored, team);
        const WalkReport& report = walk->walk(everything());
        // A2SSB begins below the root, at the start level 1.
        EXPECT_EQ(nodes_tested(report), has_two_steps(algorithm) ? 299'592u : 299'593u) << name_of(algorithm);
        EXPECT_EQ(sorted_leaves(report).size(), 262'144u);
    }
}

TEST(PublishedWalk, TestsOneNodeWhenTheRootIsOutside) {
    const UniformOctree shape(6);
    ThreadTeam team(3, kClock);
    for (const PublishedAlgorithm algorithm : {PublishedAlgorithm::kAdsb, PublishedAlgorithm::kAlgo4,
                                               PublishedAlgorithm::kAlgo5, PublishedAlgorithm::kAlgo4Lanes})
        EXPECT_EQ(nodes_tested(make_published_walk(algorithm, shape, team)->walk(nothing())), 1u);
    // These are the eight nodes of its start level.
    EXPECT_EQ(nodes_tested(make_published_walk(PublishedAlgorithm::kAlgo1, shape, team)->walk(nothing())),
              8u);
}

TEST(PublishedWalk, DealsOutStepTwoEquallyAtAForcedSplitLevel) {
    const UniformOctree shape(5);
    ThreadTeam team(8, kClock);
    const auto walk = make_published_walk(PublishedAlgorithm::kAlgo1, shape, team);
    walk->force_split_level(2);
    for (const MemberReport& member : walk->walk(everything()).members)
        EXPECT_EQ(member.nodes_tested, (UniformOctree(5).node_count() - 1) / 8);
}

TEST(PublishedWalk, GivesEachMemberItsLeavesAsTheLastPartOfItsWork) {
    const UniformOctree shape(4);
    for (const std::size_t members : {1u, 3u, 8u}) {
        ThreadTeam team(members, kClock);
        for (const PublishedAlgorithm algorithm : kAlgorithms)
            for (int level = 0; level <= 4; ++level) {
                std::vector<Codes> given(members);
                const auto walk = make_published_walk(algorithm, shape, team);
                walk->set_leaf_task([&](std::size_t member, std::span<const std::uint32_t> leaves) {
                    given[member].insert(given[member].end(), leaves.begin(), leaves.end());
                });
                walk->force_split_level(level);
                const WalkReport& report = walk->walk(all_sorts_of_frusta(shape.edge(), 1, 9)[0]);
                for (std::size_t k = 0; k < report.members.size(); ++k)
                    EXPECT_THAT(given[k], testing::ElementsAreArray(report.members[k].leaves));
            }
    }
}

TEST(PublishedWalk, SaysHowLongItsMembersWorkedAndWaited) {
    ThreadTeam team(4, kClock);
    const UniformOctree shape(5);
    for (const PublishedAlgorithm algorithm : {PublishedAlgorithm::kAdsb, PublishedAlgorithm::kAlgo1}) {
        const auto walk = make_published_walk(algorithm, shape, team);
        const Nanoseconds before = kClock.now();
        const WalkReport& report = walk->walk(everything());
        const Nanoseconds took = kClock.now() - before;
        for (const MemberReport& member : report.members) EXPECT_LE(member.busy, took);
        EXPECT_GT(report.members[0].busy.count(), 0);
        EXPECT_LE(report.total_idle, 4 * took);
    }
}

TEST(PublishedWalk, MovesItsSplitLevelFromFrameToFrame) {
    ThreadTeam team(4, kClock);
    const UniformOctree shape(4);
    for (const auto& [algorithm, first] :
         {std::pair{PublishedAlgorithm::kAdsb, 0}, std::pair{PublishedAlgorithm::kAlgo1, 1}}) {
        const auto walk = make_published_walk(algorithm, shape, team);
        EXPECT_EQ(walk->walk(everything()).split_level, first);
        EXPECT_EQ(walk->walk(everything()).split_level, first + 1);
    }
}

TEST(PublishedWalk, HasNoMembersButOneInTheAlgorithmsForOneProcessor) {
    ThreadTeam team(4, kClock);
    const UniformOctree shape(3);
    for (const PublishedAlgorithm algorithm : {PublishedAlgorithm::kAlgo4, PublishedAlgorithm::kAlgo5}) {
        const auto walk = make_published_walk(algorithm, shape, team);
        const WalkReport& report = walk->walk(everything());
        EXPECT_EQ(report.members.size(), 1u);
        EXPECT_EQ(report.total_idle.count(), 0);
    }
}

}  // namespace
}  // namespace swath
