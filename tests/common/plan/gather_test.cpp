#include "common/plan/gather.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace swath {
namespace {

constexpr ServerId kA = server_id(1);
constexpr ServerId kB = server_id(2);
constexpr ServerId kC = server_id(5);
using Servers = std::vector<ServerId>;

std::string error_of(const Status& status) { return status ? "no error" : status.error().message; }
std::string error_of(const Result<bool>& result) { return result ? "no error" : result.error().message; }

TEST(Gather, KeepsPiecesThatComeBeforeTheFrameIsReady) {
    Gather gather(2);
    EXPECT_EQ(gather.arrive(7, kB), false);
    ASSERT_TRUE(gather.open(7, {kA, kB, kC}).has_value());
    EXPECT_EQ(gather.arrive(7, kA), false);
    EXPECT_EQ(gather.ready(7), (Servers{kA, kB}));
    EXPECT_FALSE(gather.complete(7));
    EXPECT_EQ(gather.arrive(7, kC), true);
    EXPECT_TRUE(gather.complete(7));
}

TEST(Gather, IsNotCompleteBeforeTheFrameIsReady) {
    Gather gather(1);
    EXPECT_FALSE(gather.complete(0));
    ASSERT_TRUE(gather.open(0, {kA}).has_value());
    EXPECT_EQ(gather.arrive(0, kA), false);
    EXPECT_FALSE(gather.complete(0));
    EXPECT_EQ(gather.ready(0), (Servers{kA}));
    EXPECT_TRUE(gather.complete(0));
}

TEST(Gather, OfAFrameThatAwaitsNothingIsCompleteWhenReady) {
    Gather gather(1);
    ASSERT_TRUE(gather.open(0, {}).has_value());
    EXPECT_TRUE(gather.ready(0).empty());
    EXPECT_TRUE(gather.complete(0));
    gather.close(0);
    EXPECT_EQ(gather.size(), 0u);
}

TEST(Gather, KeepsFramesApart) {
    Gather gather(2);
    ASSERT_TRUE(gather.open(0, {kA}).has_value());
    ASSERT_TRUE(gather.open(1, {kA}).has_value());
    EXPECT_TRUE(gather.ready(1).empty());
    EXPECT_EQ(gather.arrive(1, kA), true);
    EXPECT_TRUE(gather.complete(1));
    EXPECT_EQ(gather.arrive(0, kA), false);
    EXPECT_EQ(gather.ready(0), (Servers{kA}));
    EXPECT_TRUE(gather.complete(0));
}

TEST(Gather, RefusesAPieceThatComesTwice) {
    Gather early(2);
    EXPECT_EQ(early.arrive(3, kA), false);
    EXPECT_EQ(error_of(early.arrive(3, kA)), "pixels for frame 3 twice");
    Gather open(2);
    ASSERT_TRUE(open.open(3, {kA, kB}).has_value());
    EXPECT_EQ(open.arrive(3, kA), false);
    EXPECT_EQ(error_of(open.arrive(3, kA)), "pixels for frame 3, which awaits none");
}

TEST(Gather, RefusesAPieceFromAServerThatIsNotAwaited) {
    Gather gather(2);
    ASSERT_TRUE(gather.open(3, {kA}).has_value());
    EXPECT_EQ(error_of(gather.arrive(3, kB)), "pixels for frame 3, which awaits none");
    EXPECT_EQ(gather.arrive(4, kC), false);
    EXPECT_EQ(error_of(gather.open(4, {kA, kB})),
              "server 5 sent pixels for frame 4, which awaits none from it");
}

TEST(Gather, RefusesAPieceForAFrameThatIsOver) {
    Gather gather(2);
    ASSERT_TRUE(gather.open(3, {kA}).has_value());
    gather.ready(3);
    EXPECT_EQ(gather.arrive(3, kA), true);
    gather.close(3);
    EXPECT_EQ(error_of(gather.arrive(3, kA)), "pixels for frame 3, which is over");
    // Frames in which this machine took no part are over, too.
    EXPECT_EQ(error_of(gather.arrive(2, kA)), "pixels for frame 2, which is over");
}

TEST(Gather, RefusesPiecesForTooManyFramesAhead) {
    Gather gather(2);
    EXPECT_EQ(gather.arrive(10, kA), false);
    EXPECT_EQ(gather.arrive(11, kA), false);
    EXPECT_EQ(gather.arrive(11, kB), false);
    EXPECT_EQ(error_of(gather.arrive(12, kA)), "pixels for frame 12, more than 2 frames ahead");
    EXPECT_EQ(gather.size(), 2u);
}

TEST(Gather, RefusesFramesThatDoNotAscend) {
    Gather gather(3);
    ASSERT_TRUE(gather.open(5, {}).has_value());
    EXPECT_EQ(error_of(gather.open(5, {})), "frame 5 is announced after frame 5");
    EXPECT_EQ(error_of(gather.open(4, {})), "frame 4 is announced after frame 5");
}

TEST(Gather, RefusesMoreFramesThanMayBeInFlight) {
    Gather gather(2);
    ASSERT_TRUE(gather.open(0, {kA}).has_value());
    ASSERT_TRUE(gather.open(1, {kA}).has_value());
    EXPECT_EQ(error_of(gather.open(2, {kA})), "frame 2: more than 2 frames in flight");
}

TEST(Gather, RefusesAFrameAfterPiecesOfOneThatIsSkipped) {
    Gather gather(2);
    EXPECT_EQ(gather.arrive(3, kA), false);
    EXPECT_EQ(error_of(gather.open(4, {kA})), "pixels came for frame 3, which was never announced");
}

TEST(Gather, TakesItsOwnerAtItsWord) {
    Gather gather(2);
    EXPECT_THROW(gather.ready(0), CheckFailed);
    EXPECT_EQ(gather.arrive(0, kA), false);
    EXPECT_THROW(gather.ready(0), CheckFailed);
    ASSERT_TRUE(gather.open(0, {kA}).has_value());
    gather.ready(0);
    EXPECT_THROW(gather.ready(0), CheckFailed);
}

}  // namespace
}  // namespace swath
