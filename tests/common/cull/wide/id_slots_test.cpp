#include "common/cull/wide/id_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace swath {
namespace {

TEST(IdSlots, BringTogetherWhatPartsFoundInTheOrderOfTheParts) {
    const SteadyClock clock;
    constexpr std::size_t kIds = 1000;
    for (const std::size_t members : {1u, 2u, 3u, 64u}) {
        ThreadTeam team(members, clock);
        IdSlots slots(kIds);
        // Part i may find up to 100 ids, and finds every (i + 1)th.
        std::vector<std::size_t> begins;
        std::vector<std::uint32_t> expected;
        for (std::size_t begin = 0; begin < kIds; begin += 100) begins.push_back(begin);
        for (std::size_t i = 0; i < begins.size(); ++i)
            for (std::size_t id = begins[i]; id < begins[i] + 100; id += i + 1)
                expected.push_back(static_cast<std::uint32_t>(id));
        for (int round = 0; round < 200; ++round) {
            const auto found = slots.share(team, members, begins, [&](std::size_t i) {
                std::uint32_t* out = slots.data() + begins[i];
                for (std::size_t id = begins[i]; id < begins[i] + 100; id += i + 1)
                    *out++ = static_cast<std::uint32_t>(id);
                return static_cast<std::size_t>(out - slots.data()) - begins[i];
            });
            ASSERT_TRUE(std::ranges::equal(found, expected));
        }
    }
}

TEST(IdSlots, LeaveEverythingWhereItIsWhenEverythingWasFound) {
    const SteadyClock clock;
    ThreadTeam team(2, clock);
    IdSlots slots(64);
    std::iota(slots.data(), slots.data() + 64, 0u);
    const std::vector<std::size_t> begins{0, 16, 48};
    const std::vector<std::size_t> counts{16, 32, 16};
    const auto found = slots.share(team, 2, begins, [&](std::size_t i) { return counts[i]; });
    EXPECT_EQ(found.data(), slots.data());
    EXPECT_EQ(found.size(), 64u);
    EXPECT_TRUE(slots.share(team, 2, {}, [](std::size_t) { return std::size_t{1}; }).empty());
}

}  // namespace
}  // namespace swath
