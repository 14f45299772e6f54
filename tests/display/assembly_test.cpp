#include "display/assemble/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace swath {

std::ostream& operator<<(std::ostream& out, const AssemblyAction& action) {
    return out << (action.kind == AssemblyAction::Kind::kAssemble ? "assemble" : "complete") << " frame "
               << action.frame << " server " << index(action.server);
}

namespace {

using Actions = Assembly::Actions;
using Kind = AssemblyAction::Kind;

AssemblyAction assemble(FrameNumber frame, std::size_t server) {
    return {Kind::kAssemble, frame, server_id(server)};
}
AssemblyAction complete(FrameNumber frame) { return {Kind::kComplete, frame, {}}; }

class AssemblyTest : public testing::Test {
  protected:
    Actions task(FrameNumber frame, const std::vector<std::size_t>& servers) {
        return good(assembly_.on_task(frame, ids(servers)));
    }
    Actions tile(FrameNumber frame, std::size_t from) {
        return good(assembly_.on_tile(frame, server_id(from)));
    }
    std::string refused(const Result<Actions>& result) {
        return result ? "not refused" : result.error().message;
    }

    Assembly assembly_{2};

  private:
    static std::vector<ServerId> ids(const std::vector<std::size_t>& servers) {
        std::vector<ServerId> made;
        for (const std::size_t s : servers) made.push_back(server_id(s));
        return made;
    }
    Actions good(const Result<Actions>& result) {
        EXPECT_TRUE(result.has_value()) << result.error().message;
        return result.value_or(Actions{});
    }
};

TEST_F(AssemblyTest, MergesTilesAsTheyComeAndCompletesWithTheLast) {
    EXPECT_EQ(task(0, {0, 1, 4}), (Actions{}));
    EXPECT_EQ(tile(0, 4), (Actions{assemble(0, 4)}));
    EXPECT_EQ(tile(0, 0), (Actions{assemble(0, 0)}));
    EXPECT_EQ(tile(0, 1), (Actions{assemble(0, 1), complete(0)}));
}

TEST_F(AssemblyTest, MergesTilesThatCameBeforeTheTask) {
    EXPECT_EQ(tile(0, 1), (Actions{}));
    EXPECT_EQ(tile(1, 1), (Actions{}));
    EXPECT_EQ(tile(0, 0), (Actions{}));
    EXPECT_EQ(task(0, {0, 1}), (Actions{assemble(0, 0), assemble(0, 1), complete(0)}));
    EXPECT_EQ(task(1, {0, 1}), (Actions{assemble(1, 1)}));
}

TEST_F(AssemblyTest, CompletesAnEmptyPictureAtOnce) { EXPECT_EQ(task(0, {}), (Actions{complete(0)})); }

TEST_F(AssemblyTest, MayCompleteALaterFrameFirst) {
    task(0, {0, 1});
    task(1, {0});
    EXPECT_EQ(tile(1, 0), (Actions{assemble(1, 0), complete(1)}));
    EXPECT_EQ(task(2, {}), (Actions{complete(2)}));
    EXPECT_EQ(tile(0, 1), (Actions{assemble(0, 1)}));
    EXPECT_EQ(tile(0, 0), (Actions{assemble(0, 0), complete(0)}));
}

TEST_F(AssemblyTest, RefusesTilesThatNobodyAwaits) {
    task(3, {0, 1});
    EXPECT_EQ(tile(3, 0), (Actions{assemble(3, 0)}));
    EXPECT_EQ(refused(assembly_.on_tile(3, server_id(0))), "pixels for frame 3, which awaits none");
    EXPECT_EQ(refused(assembly_.on_tile(3, server_id(2))), "pixels for frame 3, which awaits none");
    EXPECT_EQ(refused(assembly_.on_tile(2, server_id(0))), "pixels for frame 2, which is over");
    EXPECT_EQ(tile(3, 1), (Actions{assemble(3, 1), complete(3)}));
    EXPECT_EQ(refused(assembly_.on_tile(3, server_id(1))), "pixels for frame 3, which is over");
    tile(4, 0);
    EXPECT_EQ(refused(assembly_.on_tile(4, server_id(0))), "pixels for frame 4 twice");
    tile(5, 0);
    EXPECT_EQ(refused(assembly_.on_tile(6, server_id(0))), "pixels for frame 6, more than 2 frames ahead");
}

TEST_F(AssemblyTest, RefusesTasksOutOfOrderAndTooMany) {
    task(3, {0});
    EXPECT_EQ(refused(assembly_.on_task(3, {})), "frame 3 is announced after frame 3");
    task(4, {0});
    EXPECT_EQ(refused(assembly_.on_task(5, {})), "frame 5: more than 2 frames in flight");
}

TEST(Assemblies, CompleteEveryFrameOnceWithEveryTileOnceHoweverEventsInterleave) {
    std::mt19937 random(4);
    for (int round = 0; round < 200; ++round) {
        constexpr std::size_t kFrames = 10;
        const std::size_t servers = 1 + random() % 6;
        std::vector<std::vector<ServerId>> wanted(kFrames);
        for (auto& frame : wanted)
            for (std::size_t s = 0; s < servers; ++s)
                if (random() % 2 == 0) frame.push_back(server_id(s));
        Assembly assembly(2);
        std::map<FrameNumber, std::multiset<ServerId>> assembled;
        std::set<FrameNumber> over;
        FrameNumber told = 0;                       // frames whose task the display has
        std::vector<FrameNumber> sent(servers, 0);  // frames that each server is done with
        while (over.size() < kFrames) {
            Result<Actions> actions;
            const std::size_t s = random() % (servers + 1);
            FrameNumber& next = s == servers ? told : sent[s];
            // At most two frames are not over.
            if (next >= kFrames || next >= over.size() + 2) continue;
            if (s == servers)
                actions = assembly.on_task(next, wanted[next]);
            else if (std::count(wanted[next].begin(), wanted[next].end(), server_id(s)) > 0)
                actions = assembly.on_tile(next, server_id(s));
            ++next;
            ASSERT_TRUE(actions.has_value()) << actions.error().message;
            for (const AssemblyAction& a : *actions) {
                ASSERT_EQ(over.count(a.frame), 0u);
                if (a.kind == Kind::kAssemble) {
                    assembled[a.frame].insert(a.server);
                    continue;
                }
                over.insert(a.frame);
                ASSERT_EQ(assembled[a.frame],
                          std::multiset<ServerId>(wanted[a.frame].begin(), wanted[a.frame].end()));
            }
        }
    }
}

}  // namespace
}  // namespace swath
