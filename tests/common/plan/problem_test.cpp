#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "common/plan/frame_plan.h"

namespace swath {
namespace {

using testing::HasSubstr;
using testing::Optional;

// Two servers side by side on 10 by 4 pixels, five objects.
FramePlan good_plan() {
    FramePlan plan;
    plan.view.width = 10;
    plan.view.height = 4;
    plan.servers.resize(2);
    plan.servers[0] = {{0, 2, 3}, {{0, 0, 6, 4}}, {0, 0, 7, 4}};
    plan.servers[1] = {{1, 4}, {{6, 0, 10, 2}, {6, 2, 10, 4}}, {5, 1, 10, 3}};
    return plan;
}

auto problem_of(const FramePlan& plan) { return problem(plan, 5, Grouping::kExactlyOnce); }

TEST(PlanProblem, IsNothingForAGoodPlan) { EXPECT_EQ(problem_of(good_plan()), std::nullopt); }

TEST(PlanProblem, AllowsEmptyTilesGroupsAndContents) {
    FramePlan plan = good_plan();
    plan.servers.push_back({});
    plan.servers.push_back({{}, {Rect{3, 3, 3, 9}}, Rect{9, 9, 2, 2}});
    EXPECT_EQ(problem_of(plan), std::nullopt);
}

TEST(PlanProblem, NamesAViewportWithoutPixels) {
    FramePlan plan = good_plan();
    plan.view.height = 0;
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("viewport")));
    plan.view.height = -4;
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("viewport")));
}

TEST(PlanProblem, NamesMissingServers) {
    FramePlan plan = good_plan();
    plan.servers.clear();
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("servers")));
}

TEST(PlanProblem, NamesATileThatLeavesTheViewport) {
    FramePlan plan = good_plan();
    plan.servers[1].tile[0].x1 = 11;
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("tile of server 1")));
    constexpr int kMin = std::numeric_limits<int>::min();
    constexpr int kMax = std::numeric_limits<int>::max();
    plan.servers[1].tile[0] = {kMin, kMin, kMax, kMax};
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("tile of server 1")));
}

TEST(PlanProblem, NamesPixelsThatNobodyOwns) {
    FramePlan plan = good_plan();
    plan.servers[1].tile.pop_back();
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("cover 32 of 40 pixels")));
}

TEST(PlanProblem, NamesPixelsThatTwoServersOwn) {
    FramePlan plan = good_plan();
    plan.servers[1].tile[0].x0 = 5;
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("overlap")));
}

TEST(PlanProblem, NamesAnOverlapThatAHoleOfTheSameAreaHides) {
    FramePlan plan = good_plan();
    plan.servers[1].tile[1] = {6, 1, 10, 3};
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("overlap")));
}

TEST(PlanProblem, NamesAContentThatLeavesTheViewport) {
    FramePlan plan = good_plan();
    plan.servers[0].content.y0 = -1;
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("content of server 0")));
}

TEST(PlanProblem, NamesAnObjectThatDoesNotExist) {
    FramePlan plan = good_plan();
    plan.servers[1].group.push_back(5);
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("object 5 of 5")));
}

TEST(PlanProblem, NamesAGroupThatIsNotAscending) {
    FramePlan plan = good_plan();
    plan.servers[0].group = {0, 3, 2};
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("not ascending")));
    plan.servers[0].group = {0, 2, 2, 3};
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("not ascending")));
}

TEST(PlanProblem, NamesAnObjectThatNobodyDraws) {
    FramePlan plan = good_plan();
    plan.servers[0].group = {0, 3};
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("the first is 2")));
    EXPECT_NE(problem(plan, 5, Grouping::kAtLeastOnce), std::nullopt);
}

TEST(PlanProblem, NamesAnObjectInTwoGroupsUnlessThatIsAllowed) {
    FramePlan plan = good_plan();
    plan.servers[1].group = {1, 3, 4};
    EXPECT_THAT(problem_of(plan), Optional(HasSubstr("object 3")));
    EXPECT_EQ(problem(plan, 5, Grouping::kAtLeastOnce), std::nullopt);
}

// Splits a small screen, then moves one rectangle: counting pixels says what is right.
TEST(PlanProblem, AgreesWithCountingPixelsForRandomTiles) {
    std::mt19937 random(3);
    int good = 0;
    int bad = 0;
    for (int round = 0; round < 5000; ++round) {
        FramePlan plan;
        plan.view.width = 1 + static_cast<int>(random() % 9);
        plan.view.height = 1 + static_cast<int>(random() % 9);
        plan.servers.resize(1 + random() % 4);
        std::vector<Rect> rects{plan.view.viewport()};
        for (int split = 0; split < 5; ++split) {
            Rect& r = rects[random() % rects.size()];
            Rect rest = r;
            if (random() % 2 == 0)
                r.x1 = rest.x0 = r.x0 + static_cast<int>(random() % static_cast<unsigned>(r.x1 - r.x0 + 1));
            else
                r.y1 = rest.y0 = r.y0 + static_cast<int>(random() % static_cast<unsigned>(r.y1 - r.y0 + 1));
            rects.push_back(rest);
        }
        if (round % 2 == 1) {
            Rect& r = rects[random() % rects.size()];
            const int by = random() % 2 == 0 ? 1 : -1;
            r = {r.x0 + by, r.y0, r.x1 + by, r.y1};
        }
        std::vector<int> owners(static_cast<std::size_t>(plan.view.viewport().area()), 0);
        bool leaves = false;
        for (const Rect& r : rects) {
            plan.servers[random() % plan.servers.size()].tile.push_back(r);
            leaves = leaves || !plan.view.viewport().contains(r);
            const Rect inside = intersect(r, plan.view.viewport());
            for (int y = inside.y0; y < inside.y1; ++y)
                for (int x = inside.x0; x < inside.x1; ++x)
                    ++owners[static_cast<std::size_t>(y * plan.view.width + x)];
        }
        const bool once =
            !leaves && std::all_of(owners.begin(), owners.end(), [](int count) { return count == 1; });
        ASSERT_EQ(problem(plan, 0, Grouping::kExactlyOnce) == std::nullopt, once);
        (once ? good : bad) += 1;
    }
    EXPECT_GT(good, 1000);
    EXPECT_GT(bad, 1000);
}

}  // namespace
}  // namespace swath
