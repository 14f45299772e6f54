#include "common/base/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <string>

#include "common/base/check.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using test::kClock;

TEST(ThreadTeam, GivesEveryMemberItsOwnTask) {
    for (const std::size_t size : {1u, 2u, 3u, 7u, 64u}) {
        ThreadTeam team(size, kClock);
        std::vector<int> done(size, 0);
        for (std::size_t i = 0; i < size; ++i) {
            team.set_task(i, [&done, i] { done[i] += static_cast<int>(i) + 1; });
            team.start(i);
        }
        team.wait();
        for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(done[i], static_cast<int>(i) + 1);
    }
}

TEST(ThreadTeam, ShowsTheCallerWhatTasksWroteRoundAfterRound) {
    ThreadTeam team(4, kClock);
    std::vector<std::uint64_t> sums(team.size());
    for (std::uint64_t round = 1; round <= 20'000; ++round) {
        team.run([&](std::size_t member) { sums[member] += round * (member + 1); });
        if (round % 1'000 == 0) {
            const std::uint64_t sum = round * (round + 1) / 2;
            EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), sum * 10);
        }
    }
}

// Members fall asleep between rounds, some of them just when they are started: a lost wake-up would hang.
TEST(ThreadTeam, WakesMembersThatSleep) {
    ThreadTeam team(3, kClock);
    std::atomic<int> done{0};
    for (int round = 0; round < 3'000; ++round) {
        const Nanoseconds until = kClock.now() + Nanoseconds(50 * (round % 1'000));
        while (kClock.now() < until) {
        }
        team.run([&](std::size_t) { ++done; });
    }
    EXPECT_EQ(done, 9'000);
}

TEST(ThreadTeam, StartsOnlyWhomItIsToldTo) {
    ThreadTeam team(3, kClock);
    std::atomic<int> done{0};
    for (std::size_t i = 0; i < 3; ++i) team.set_task(i, [&, i] { done += 1 << i; });
    team.start(1);
    team.wait();
    EXPECT_EQ(done, 2);
    team.start(0);
    team.start(2);
    team.wait();
    EXPECT_EQ(done, 7);
}

TEST(ThreadTeam, RunsTheFirstMembersOnly) {
    ThreadTeam team(4, kClock);
    std::atomic<int> done{0};
    team.run(2, [&](std::size_t member) { done += 1 << member; });
    EXPECT_EQ(done, 3);
    EXPECT_THROW(team.run(5, [](std::size_t) {}), CheckFailed);
}

TEST(ThreadTeam, KnowsWhenEachMemberBeganAndEnded) {
    ThreadTeam team(5, kClock);
    const Nanoseconds before = kClock.now();
    team.run([](std::size_t) {});
    const Nanoseconds after = kClock.now();
    for (std::size_t i = 0; i < team.size(); ++i) {
        EXPECT_LE(before, team.start_time(i));
        EXPECT_LE(team.start_time(i), team.end_time(i));
        EXPECT_LE(team.end_time(i), after);
    }
}

TEST(ThreadTeam, LetsTheCallerDoWhatNobodyHasBegun) {
    ThreadTeam team(64, kClock);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> by_caller{0};
    for (int round = 0; round < 100; ++round)
        team.run([&](std::size_t) { by_caller += std::this_thread::get_id() == caller; });
    // Member 0's own task and some of the others': 63 threads do not wake in the time of one task.
    EXPECT_GT(by_caller, 100);
}

TEST(ThreadTeam, ThrowsWhatTheFirstMemberThrewWhenAllAreDoneAndForgetsIt) {
    ThreadTeam team(4, kClock);
    for (int round = 0; round < 200; ++round) {
        std::atomic<int> done{0};
        std::string thrown;
        try {
            team.run([&](std::size_t member) {
                ++done;
                if (member == 1 || member == 3) throw std::runtime_error(std::to_string(member));
            });
        } catch (const std::runtime_error& error) {
            thrown = error.what();
        }
        EXPECT_EQ(thrown, "1");
        EXPECT_EQ(done, 4);
        team.run([&](std::size_t) { ++done; });
        EXPECT_EQ(done, 8);
    }
}

TEST(ThreadTeam, RefusesAMemberThatItDoesNotHaveOrThatIsAtWorkAndATeamOfNobody) {
    ThreadTeam team(2, kClock);
    EXPECT_THROW(team.set_task(2, [] {}), CheckFailed);
    EXPECT_THROW(team.start(2), CheckFailed);
    EXPECT_THROW(team.start(1), CheckFailed);
    team.set_task(0, [] {});
    team.start(0);
    EXPECT_THROW(team.start(0), CheckFailed);
    EXPECT_THROW(team.set_task(0, [] {}), CheckFailed);
    team.wait();
    EXPECT_THROW(ThreadTeam(0, kClock), CheckFailed);
}

}  // namespace
}  // namespace swath
