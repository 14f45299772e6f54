#include "client/machines/roster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swath {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class RosterTest : public testing::Test {
  protected:
    ServerId ready() {
        const ServerId server = roster_.add();
        roster_.on_ready(server, true);
        return server;
    }
    ServerId member() {
        const ServerId server = ready();
        for (const Roster::Link& link : roster_.link()) EXPECT_TRUE(roster_.on_linked(link.server));
        EXPECT_TRUE(roster_.is_member(server));
        return server;
    }
    std::map<std::size_t, std::vector<ServerId>> batch() {
        std::map<std::size_t, std::vector<ServerId>> all;
        for (const Roster::Link& link : roster_.link()) all[index(link.server)] = link.peers;
        return all;
    }
    static ServerId id(std::size_t i) { return server_id(i); }

    Roster roster_;
};

TEST_F(RosterTest, LinksTheFirstServersToEachOther) {
    ready();
    ready();
    const ServerId late = roster_.add();
    EXPECT_THAT(batch(), ElementsAre(testing::Pair(0, IsEmpty()), testing::Pair(1, ElementsAre(id(0)))));
    EXPECT_THAT(roster_.members(), IsEmpty());
    EXPECT_TRUE(roster_.on_linked(id(1)));
    EXPECT_THAT(roster_.members(), ElementsAre(id(1)));
    EXPECT_FALSE(roster_.is_member(late));
}

TEST_F(RosterTest, LinksTheNextBatchWhenTheLastOneIsLinked) {
    ready();
    const ServerId slow = ready();
    batch();
    const ServerId newcomer = ready();
    EXPECT_THAT(roster_.link(), IsEmpty());
    EXPECT_TRUE(roster_.on_linked(id(0)));
    EXPECT_THAT(roster_.link(), IsEmpty());
    roster_.remove(slow);  // it was lost meanwhile
    EXPECT_THAT(batch(), ElementsAre(testing::Pair(index(newcomer), ElementsAre(id(0)))));
}

TEST_F(RosterTest, RefusesALinkThatNobodyAskedFor) {
    const ServerId server = ready();
    EXPECT_FALSE(roster_.on_linked(server));
    batch();
    EXPECT_TRUE(roster_.on_linked(server));
    EXPECT_FALSE(roster_.on_linked(server));
}

TEST_F(RosterTest, AMemberHasTheModelAsItIsDrawn) {
    const ServerId server = member();
    roster_.on_ready(server, false);
    EXPECT_THAT(roster_.members(), IsEmpty());
    // It is linked already, and newcomers are linked to it.
    const ServerId newcomer = ready();
    EXPECT_THAT(batch(), ElementsAre(testing::Pair(index(newcomer), ElementsAre(server))));
    roster_.on_ready(server, true);
    EXPECT_THAT(roster_.members(), ElementsAre(server));
}

TEST_F(RosterTest, LetsGoOfAServerWhenItsFramesAreOver) {
    const ServerId stays = member();
    const ServerId leaves = member();
    roster_.on_issued({stays, leaves});
    roster_.on_issued({stays, leaves});
    roster_.on_leave(leaves);
    roster_.on_leave(leaves);
    EXPECT_THAT(roster_.members(), ElementsAre(stays));
    EXPECT_THAT(roster_.released(), IsEmpty());
    roster_.on_over({stays, leaves});
    EXPECT_THAT(roster_.released(), IsEmpty());
    roster_.on_over({stays, leaves});
    EXPECT_THAT(roster_.released(), ElementsAre(leaves));
    EXPECT_TRUE(roster_.has_open_frames(stays) == false);
    // No newcomer is linked to it any more.
    const ServerId newcomer = ready();
    EXPECT_THAT(batch(), ElementsAre(testing::Pair(index(newcomer), ElementsAre(stays))));
}

TEST_F(RosterTest, LetsGoAtOnceOfWhoHasNotBegun) {
    const ServerId server = roster_.add();
    roster_.on_leave(server);
    EXPECT_THAT(roster_.released(), ElementsAre(server));
    roster_.on_ready(server, true);
    EXPECT_THAT(roster_.link(), IsEmpty());
}

TEST_F(RosterTest, NumbersAreUsedAgainAndNeverShared) {
    for (std::size_t i = 0; i < kMaxServers; ++i) EXPECT_EQ(index(roster_.add()), i);
    EXPECT_TRUE(roster_.full());
    roster_.remove(id(500));
    roster_.remove(id(7));
    EXPECT_EQ(roster_.add(), id(7));
    EXPECT_EQ(roster_.add(), id(500));
    EXPECT_TRUE(roster_.full());
}

TEST_F(RosterTest, LinksToAllPeersInOrderOfTheirNumbers) {
    const ServerId gone = roster_.add();
    const ServerId member = this->member();
    roster_.remove(gone);
    EXPECT_EQ(ready(), gone);
    ready();
    EXPECT_THAT(batch(), ElementsAre(testing::Pair(0, ElementsAre(member)),
                                     testing::Pair(2, ElementsAre(id(0), member))));
}

}  // namespace
}  // namespace swath
