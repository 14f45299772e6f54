#include "server/swap/frame_swap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace swath {

std::ostream& operator<<(std::ostream& out, const SwapAction& action) {
    static constexpr const char* kNames[] = {"draw", "send swath", "composite", "send tile", "finished"};
    return out << kNames[static_cast<int>(action.kind)] << " frame " << action.frame << " server "
               << index(action.peer);
}

namespace {

using Actions = FrameSwap::Actions;
using Kind = SwapAction::Kind;

SwapAction draw(FrameNumber frame) { return {Kind::kDraw, frame, {}}; }
SwapAction send_swath(FrameNumber frame, std::size_t to) { return {Kind::kSendSwath, frame, server_id(to)}; }
SwapAction composite(FrameNumber frame, std::size_t from) {
    return {Kind::kComposite, frame, server_id(from)};
}
SwapAction send_tile(FrameNumber frame) { return {Kind::kSendTile, frame, {}}; }
SwapAction finished(FrameNumber frame) { return {Kind::kFinished, frame, {}}; }

SwapTask task(FrameNumber frame, const std::vector<std::size_t>& to, const std::vector<std::size_t>& from,
              bool has_tile = true) {
    SwapTask made{frame, {}, {}, has_tile};
    for (const std::size_t s : to) made.outgoing.push_back(server_id(s));
    for (const std::size_t s : from) made.incoming.push_back(server_id(s));
    return made;
}

// Feeds events to one server; errors come back as text.
class FrameSwapTest : public testing::Test {
  protected:
    Actions given(const SwapTask& t) { return good(swap_.on_task(t)); }
    Actions drawn(FrameNumber frame) { return swap_.on_drawn(frame); }
    Actions swath(FrameNumber frame, std::size_t from) {
        return good(swap_.on_swath(frame, server_id(from)));
    }
    std::string refused(const Result<Actions>& result) {
        return result ? "not refused" : result.error().message;
    }

    FrameSwap swap_{2};

  private:
    Actions good(const Result<Actions>& result) {
        EXPECT_TRUE(result.has_value()) << result.error().message;
        return result.value_or(Actions{});
    }
};

TEST_F(FrameSwapTest, SendsSwathsWhenDrawnAndTheTileWithTheLastPiece) {
    EXPECT_EQ(given(task(0, {1, 3}, {2, 3})), (Actions{draw(0)}));
    EXPECT_EQ(drawn(0), (Actions{send_swath(0, 1), send_swath(0, 3)}));
    EXPECT_EQ(swath(0, 3), (Actions{composite(0, 3)}));
    EXPECT_EQ(swath(0, 2), (Actions{composite(0, 2), send_tile(0), finished(0)}));
}

TEST_F(FrameSwapTest, SendsItsOwnBeforeItMergesWhatWaits) {
    EXPECT_EQ(swath(0, 2), (Actions{}));  // before the task
    EXPECT_EQ(given(task(0, {1}, {1, 2})), (Actions{draw(0)}));
    EXPECT_EQ(swath(0, 1), (Actions{}));  // before it is drawn
    EXPECT_EQ(drawn(0),
              (Actions{send_swath(0, 1), composite(0, 1), composite(0, 2), send_tile(0), finished(0)}));
}

TEST_F(FrameSwapTest, IsDoneWhenDrawnIfItExchangesNothing) {
    given(task(0, {}, {}));
    EXPECT_EQ(drawn(0), (Actions{send_tile(0), finished(0)}));
}

TEST_F(FrameSwapTest, SendsNoTileIfItOwnsNoPixels) {
    given(task(0, {1}, {}, false));
    EXPECT_EQ(drawn(0), (Actions{send_swath(0, 1), finished(0)}));
}

TEST_F(FrameSwapTest, FinishesFramesInTheOrderTheirPiecesCome) {
    given(task(0, {1}, {1}));
    EXPECT_EQ(given(task(1, {1}, {1})), (Actions{draw(1)}));
    EXPECT_EQ(drawn(0), (Actions{send_swath(0, 1)}));
    EXPECT_EQ(swath(1, 1), (Actions{}));
    EXPECT_EQ(drawn(1), (Actions{send_swath(1, 1), composite(1, 1), send_tile(1), finished(1)}));
    EXPECT_EQ(swath(0, 1), (Actions{composite(0, 1), send_tile(0), finished(0)}));
}

TEST_F(FrameSwapTest, SkipsFramesInWhichItTakesNoPart) {
    given(task(0, {}, {}));
    drawn(0);
    EXPECT_EQ(given(task(9, {}, {4})), (Actions{draw(9)}));
    EXPECT_EQ(swath(9, 4), (Actions{}));
    EXPECT_EQ(drawn(9), (Actions{composite(9, 4), send_tile(9), finished(9)}));
}

TEST_F(FrameSwapTest, RefusesWhatNobodyAwaits) {
    given(task(4, {}, {2}));
    EXPECT_EQ(refused(swap_.on_swath(4, server_id(3))), "pixels for frame 4, which awaits none");
    EXPECT_EQ(refused(swap_.on_swath(3, server_id(2))), "pixels for frame 3, which is over");
    EXPECT_EQ(swath(4, 2), (Actions{}));
    EXPECT_EQ(refused(swap_.on_swath(4, server_id(2))), "pixels for frame 4, which awaits none");
    EXPECT_EQ(drawn(4), (Actions{composite(4, 2), send_tile(4), finished(4)}));
    EXPECT_EQ(refused(swap_.on_swath(4, server_id(2))), "pixels for frame 4, which is over");
}

TEST_F(FrameSwapTest, RefusesTasksOutOfOrderAndTooMany) {
    given(task(4, {}, {1}));
    EXPECT_EQ(refused(swap_.on_task(task(4, {}, {}))), "frame 4 is announced after frame 4");
    EXPECT_EQ(refused(swap_.on_task(task(3, {}, {}))), "frame 3 is announced after frame 4");
    given(task(5, {}, {1}));
    EXPECT_EQ(refused(swap_.on_task(task(6, {}, {}))), "frame 6: more than 2 frames in flight");
}

// A cluster of FrameSwaps. Messages arrive in any order that TCP allows: in order between two machines, in no
// order otherwise.
class RandomCluster {
  public:
    RandomCluster(std::size_t servers, std::mt19937& random)
        : random_(random), swaps_(servers, FrameSwap(kInFlight)), seen_(servers) {}

    void run(FrameNumber frames) {
        const std::size_t n = swaps_.size();
        FrameNumber issued = 0;
        while (over_ < frames) {
            if (issued < frames && issued - over_ < kInFlight && random_() % 3 == 0) issue(issued++);
            // A queue from each machine to each. The client is machine n; a server's own drawing is a message
            // to itself.
            const std::size_t from = random_() % (n + 1);
            const std::size_t to = random_() % n;
            auto& queue = queues_[{from, to}];
            if (queue.empty()) continue;
            const Event event = queue.front();
            queue.erase(queue.begin());
            deliver(event, from, to);
        }
        for (const auto& [way, queue] : queues_) EXPECT_TRUE(queue.empty());
    }

  private:
    static constexpr std::size_t kInFlight = 3;
    struct Event {
        FrameNumber frame = 0;
        bool is_task = false;
        SwapTask task;
    };
    struct Seen {
        bool drawn = false;
        std::multiset<ServerId> sent, composited;
        int tiles = 0;
    };

    void issue(FrameNumber frame) {
        const std::size_t n = swaps_.size();
        std::vector<SwapTask> tasks(n);
        for (std::size_t s = 0; s < n; ++s) {
            tasks[s].frame = frame;
            tasks[s].has_tile = random_() % 4 != 0;
        }
        for (std::size_t from = 0; from < n; ++from)
            for (std::size_t to = 0; to < n; ++to)
                if (from != to && random_() % 2 == 0) {
                    tasks[from].outgoing.push_back(server_id(to));
                    tasks[to].incoming.push_back(server_id(from));
                }
        for (std::size_t s = 0; s < n; ++s) queues_[{n, s}].push_back({frame, true, tasks[s]});
        tasks_[frame] = tasks;
    }

    void deliver(const Event& event, std::size_t from, std::size_t to) {
        if (event.is_task)
            act(to, swaps_[to].on_task(event.task));
        else if (from == to)
            act(to, swaps_[to].on_drawn(event.frame));
        else
            act(to, swaps_[to].on_swath(event.frame, server_id(from)));
    }

    void act(std::size_t server, const Result<Actions>& actions) {
        ASSERT_TRUE(actions.has_value()) << actions.error().message;
        for (const SwapAction& a : *actions) {
            ASSERT_EQ(seen_[server].count(a.frame), a.kind == Kind::kDraw ? 0u : 1u);
            Seen& seen = seen_[server][a.frame];
            if (a.kind == Kind::kDraw) {
                queues_[{server, server}].push_back({a.frame, false, {}});
            } else if (a.kind == Kind::kSendSwath) {
                seen.sent.insert(a.peer);
                queues_[{server, index(a.peer)}].push_back({a.frame, false, {}});
            } else if (a.kind == Kind::kComposite) {
                seen.composited.insert(a.peer);
            } else if (a.kind == Kind::kSendTile) {
                ++seen.tiles;
            } else {
                finish(server, a.frame);
            }
        }
    }

    void finish(std::size_t server, FrameNumber frame) {
        const SwapTask& t = tasks_.at(frame)[server];
        const Seen& seen = seen_[server].at(frame);
        EXPECT_EQ(seen.sent, std::multiset<ServerId>(t.outgoing.begin(), t.outgoing.end()));
        EXPECT_EQ(seen.composited, std::multiset<ServerId>(t.incoming.begin(), t.incoming.end()));
        EXPECT_EQ(seen.tiles, t.has_tile ? 1 : 0);
        EXPECT_TRUE(finished_.emplace(frame, server).second) << "finished twice";
        // For the client a frame is over when all have reported; frames end in order.
        const auto done = [&](FrameNumber f) {
            for (std::size_t s = 0; s < swaps_.size(); ++s)
                if (finished_.count({f, s}) == 0) return false;
            return true;
        };
        while (done(over_)) ++over_;
    }

    std::mt19937& random_;
    std::vector<FrameSwap> swaps_;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Event>> queues_;
    std::map<FrameNumber, std::vector<SwapTask>> tasks_;
    std::vector<std::map<FrameNumber, Seen>> seen_;
    std::set<std::pair<FrameNumber, std::size_t>> finished_;
    FrameNumber over_ = 0;
};

TEST(FrameSwaps, FinishEveryFrameOnceAndMergeEveryPieceOnceHoweverEventsInterleave) {
    std::mt19937 random(3);
    for (int round = 0; round < 60; ++round) {
        RandomCluster cluster(1 + random() % 6, random);
        cluster.run(12);
        if (HasFatalFailure() || HasNonfatalFailure()) FAIL() << "round " << round;
    }
}

}  // namespace
}  // namespace swath
