#include "client/cost/client_time.h"

#include <gtest/gtest.h>

namespace swath {
namespace {

TEST(ClientTime, GrowsWithServersUnlessGroupsAreStatic) {
    Hardware hardware;
    hardware.client = {1, 10, 1000};
    EXPECT_EQ(client_s(3, 8, Algorithm::kHybrid, hardware), 3 * (1 + 80 + 3000));
    EXPECT_EQ(client_s(3, 8, Algorithm::kSortLast, hardware), 3);
}

}  // namespace
}  // namespace swath
