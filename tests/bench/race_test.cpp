#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bench/race.h"

namespace swath::bench {
namespace {

using Ids = Race::Ids;

Status check(const Ids& first, const Ids& second, Race::Order order = Race::Order::kAny) {
    Race race("a race", "scene");
    race.add("one", [&] { return std::span(first); });
    race.add("two", [&] { return std::span(second); });
    return race.check(order);
}

TEST(Race, TakesTheSameSetInAnyOrderUnlessOrderCounts) {
    EXPECT_TRUE(check({1, 2, 3}, {3, 1, 2}));
    EXPECT_TRUE(check({}, {}));
    EXPECT_FALSE(check({1, 2, 3}, {3, 1, 2}, Race::Order::kSame));
    EXPECT_TRUE(check({3, 1, 2}, {3, 1, 2}, Race::Order::kSame));
}

TEST(Race, NamesWhoFoundSomethingElse) {
    const Status status = check({1, 2, 3}, {1, 2, 4, 5});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "a race: 'two' leaves 4 ids, 'one' 3; in one only are 3, the first 3");
    EXPECT_FALSE(check({1, 2}, {1, 2, 2})) << "an id twice";
}

TEST(Race, MeasuresEachInTurn) {
    std::vector<int> turns;
    const Ids none;
    Race race("a race", "scene");
    for (const int runner : {1, 2})
        race.add(std::to_string(runner), [&, runner] {
            turns.push_back(runner);
            return std::span(none);
        });
    race.run(2, 2);
    EXPECT_THAT(turns, testing::ElementsAre(1, 1, 2, 2, 1, 1, 2, 2));
    EXPECT_EQ(race.ratios("1", "2").size(), 2u);
}

TEST(Race, PreparesWorkBeforeEveryFrame) {
    std::string steps;
    Race race("a race", "scene");
    race.add_work(
        "work", [&] { steps += 'p'; }, [&] { steps += 'f'; });
    EXPECT_TRUE(race.check());
    EXPECT_EQ(steps, "");
    race.run(2, 2);
    EXPECT_EQ(steps, "pfpfpfpf");
}

}  // namespace
}  // namespace swath::bench
