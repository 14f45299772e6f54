#include "client/machines/setup_change.h"

#include <gtest/gtest.h>

namespace swath {
namespace {

using Next = SetupChange::Next;

TEST(SetupChange, IsDoneWhenAllServersHaveChanged) {
    SetupChange change;
    EXPECT_FALSE(change.under_way());
    change.begin(3);
    EXPECT_EQ(change.on_answer(""), Next::kWait);
    EXPECT_EQ(change.on_answer(""), Next::kWait);
    EXPECT_TRUE(change.under_way());
    EXPECT_EQ(change.on_answer(""), Next::kDone);
    EXPECT_FALSE(change.under_way());
}

TEST(SetupChange, GoesBackEverywhereWhenOneServerRefuses) {
    SetupChange change;
    change.begin(3);
    change.on_answer("");
    EXPECT_EQ(change.on_answer("no EGL"), Next::kWait);
    EXPECT_FALSE(change.going_back());
    EXPECT_EQ(change.on_answer("no EGL here either"), Next::kGoBack);
    EXPECT_TRUE(change.going_back());
    EXPECT_EQ(change.on_answer(""), Next::kWait);
    EXPECT_EQ(change.on_answer(""), Next::kWait);
    EXPECT_EQ(change.on_answer(""), Next::kUndone);
    EXPECT_EQ(change.why(), "no EGL");
    EXPECT_FALSE(change.under_way());
}

TEST(SetupChange, IsStuckWhenAServerCannotGoBack) {
    SetupChange change;
    change.begin(1);
    EXPECT_EQ(change.on_answer("no"), Next::kGoBack);
    EXPECT_EQ(change.on_answer("no more"), Next::kStuck);
}

TEST(SetupChange, ForgetsTheLastOne) {
    SetupChange change;
    change.begin(1);
    change.on_answer("no");
    change.on_answer("");
    change.begin(1);
    EXPECT_FALSE(change.going_back());
    EXPECT_EQ(change.on_answer(""), Next::kDone);
}

}  // namespace
}  // namespace swath
