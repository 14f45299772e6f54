#include "client/partition/object_costs.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace swath {
namespace {

using Costs = std::vector<std::uint32_t>;
using Group = std::vector<ObjectId>;

// Four objects of 100, 200, 300 and 400 triangles.
class ObjectCostsTest : public testing::Test {
  protected:
    static std::vector<Object> objects() {
        std::vector<Object> made(4);
        for (std::uint32_t i = 0; i < 4; ++i) made[i].triangle_count = 100 * (i + 1);
        return made;
    }
    Costs costs() const { return {costs_.costs().begin(), costs_.costs().end()}; }
    // Issues a frame with the groups of servers 0, 1 and so on.
    void issue(FrameNumber frame, const std::vector<Group>& groups) {
        std::map<ServerId, Group> by_server;
        for (std::size_t i = 0; i < groups.size(); ++i) by_server[server_id(i)] = groups[i];
        costs_.on_issued(frame, std::move(by_server));
    }
    // "" if it is accepted.
    std::string report(FrameNumber frame, std::size_t server, const Costs& visible) {
        const Status status = costs_.on_report(frame, server_id(server), visible);
        return status ? "" : status.error().message;
    }

    ObjectCosts costs_{objects()};
    const Costs all_{100, 200, 300, 400};
};

TEST_F(ObjectCostsTest, AreAllTrianglesUntilAFrameIsOver) {
    EXPECT_EQ(costs(), all_);
    issue(0, {{0, 1}, {2, 3}});
    EXPECT_EQ(report(0, 0, {10, 20}), "");
    EXPECT_EQ(costs(), all_);
    EXPECT_EQ(report(0, 1, {30, 40}), "");
    EXPECT_EQ(costs(), (Costs{10, 20, 30, 40}));
}

TEST_F(ObjectCostsTest, AddUpWhatSeveralServersSawButNoMoreThanThereIs) {
    issue(0, {{0, 1, 3}, {1, 2, 3}, {3}});
    EXPECT_EQ(report(0, 2, {400}), "");
    EXPECT_EQ(report(0, 0, {10, 50, 300}), "");
    EXPECT_EQ(report(0, 1, {60, 300, 1}), "");
    EXPECT_EQ(costs(), (Costs{10, 110, 300, 400}));
}

TEST_F(ObjectCostsTest, AreAllTrianglesOfWhatNobodySaw) {
    issue(0, {{0, 1}, {1, 2}});
    EXPECT_EQ(report(0, 0, {10, 0}), "");
    EXPECT_EQ(report(0, 1, {0, 7}), "");
    EXPECT_EQ(costs(), (Costs{10, 200, 7, 400}));  // 3 was in no group
    issue(1, {});
    EXPECT_EQ(costs(), all_);
}

TEST_F(ObjectCostsTest, AreAllTrianglesOfAServerThatDoesNotSay) {
    issue(0, {{0, 1}, {1, 3}});
    EXPECT_EQ(report(0, 0, {}), "");
    EXPECT_EQ(report(0, 1, {5, 6}), "");
    EXPECT_EQ(costs(), (Costs{100, 200, 300, 6}));
}

TEST_F(ObjectCostsTest, FollowTheNewestFrameThatIsOver) {
    issue(4, {{0}});
    issue(5, {{0}});
    issue(6, {{0}});
    EXPECT_EQ(report(5, 0, {55}), "");
    EXPECT_EQ(costs()[0], 55u);
    EXPECT_EQ(report(4, 0, {44}), "");
    EXPECT_EQ(costs()[0], 55u);
    EXPECT_EQ(report(6, 0, {66}), "");
    EXPECT_EQ(costs()[0], 66u);
}

TEST_F(ObjectCostsTest, RefuseWhatDoesNotFitTheGroup) {
    issue(3, {{0, 1}, {2}});
    EXPECT_EQ(report(3, 0, {1}), "visible: 1 counts for a group of 2 objects");
    EXPECT_EQ(report(3, 1, {1, 2}), "visible: 2 counts for a group of 1 objects");
    EXPECT_EQ(report(3, 0, {1, 201}), "visible: 201 triangles of object 1, which has 200");
    EXPECT_EQ(report(3, 2, {1}), "a report for frame 3 that is not awaited");
    EXPECT_EQ(report(2, 0, {1, 2}), "a report for frame 2, which is not open");
    EXPECT_EQ(report(3, 1, {9}), "");
    EXPECT_EQ(report(3, 1, {9}), "a report for frame 3 that is not awaited");
}

TEST_F(ObjectCostsTest, OfAnObjectThatIsNotThereAreOurOwnMistake) {
    EXPECT_THROW(issue(0, {{3, 4}}), CheckFailed);
}

}  // namespace
}  // namespace swath
