#include "common/published/cull/cost_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/published/cull/published_walk.h"
#include "tests/common/published/cull/frusta.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using test::kClock;

TEST(A2ssbCost, CountsTheNodesThatTheChapterPrints) {
    EXPECT_EQ(nodes_up_to(6), 299'593);     // table 3.10
    EXPECT_EQ(nodes_up_to(8), 19'173'961);  // before equation 28
    EXPECT_EQ(nodes_up_to(-1), 0);
}

TEST(A2ssbCost, TransfersLittleOfALargeTreeAsInEquation28) {
    const A2ssbCost cost{.height = 8, .start_level = 1, .split_level = 4, .processors = 4};
    EXPECT_DOUBLE_EQ(cost.transfer_to_navigation(), 21 / std::sqrt(std::pow(8, 8)));  // equation 27
    EXPECT_NEAR(cost.transfer_to_navigation(), 0.0051, 0.00005);
    EXPECT_DOUBLE_EQ(cost.transfer_to_navigation(), 7 * (4 - 1) * std::pow(8, 4 - 8));  // equation 26
}

TEST(A2ssbCost, GivesTheClosedFormsOfItsSums) {
    for (int h = 1; h <= 8; ++h)
        for (const int p : {1, 3, 4, 8})
            for (int r = 0; r <= 1; ++r)
                for (int d = r; d < h; ++d) {
                    const A2ssbCost cost{h, r, d, p};
                    const double rest = std::pow(8, h + 1) - std::pow(8, r + 1);
                    EXPECT_DOUBLE_EQ(cost.step_one(), (std::pow(8, d + 1) - std::pow(8, r + 1)) / (7 * p));
                    EXPECT_DOUBLE_EQ(cost.transfer(), std::pow(8, d + 1) / p * (p - 1));
                    EXPECT_DOUBLE_EQ(cost.step_two(), (std::pow(8, h + 1) - std::pow(8, d + 1)) / (7 * p));
                    EXPECT_DOUBLE_EQ(cost.total(), rest / (7 * p) + (p - 1) * std::pow(8, d + 1) / p);
                    EXPECT_EQ(cost.subtree_height(), h - d - 1);
                }
    // Equation 29 leaves out small terms: r and the transfer.
    const A2ssbCost large{.height = 8, .start_level = 1, .split_level = 3, .processors = 4};
    EXPECT_NEAR(large.roughly_total() / large.total(), 1, 0.001);
    // Equation 30.
    const A2ssbCost larger{.height = 9, .start_level = 1, .split_level = 3, .processors = 4};
    EXPECT_DOUBLE_EQ(larger.roughly_total(), 8 * large.roughly_total());
}

// The equations agree with the algorithm, but for the nodes of the start level, which they leave out.
TEST(A2ssbCost, IsWhatTheAlgorithmDoesWhenEverythingIsVisible) {
    ThreadTeam team(4, kClock);
    const UniformOctree shape(5);
    const auto walk = make_published_walk(PublishedAlgorithm::kAlgo1, shape, team);
    for (int d = 1; d < 5; ++d) {
        walk->force_split_level(d);
        const A2ssbCost cost{.height = 5, .start_level = 1, .split_level = d, .processors = 4};
        for (const MemberReport& member : walk->walk(everything()).members)
            EXPECT_EQ(static_cast<double>(member.nodes_tested), cost.step_one() + cost.step_two() + 8.0 / 4);
    }
}

}  // namespace
}  // namespace swath
