#include <gmock/gmock.h>

#include "tests/server/server_fixture.h"

// Sessions: the model, the connections, and peers that come and go.

namespace swath::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST_F(ServerTest, AsksForAModelThatItLacks) {
    const auto client = ready_client(setup());
    EXPECT_GT(objects_, 1u);
    EXPECT_FALSE(client->closed.has_value());
}

TEST_F(ServerTest, AsksForTheModelPartByPart) {
    const auto one = client();
    one->send(setup());
    const std::size_t half = blob_.size() / 2;
    EXPECT_EQ(one->expect<NeedModel>(), NeedModel{0});
    Buffer first, second;
    first.append(blob_.data(), half);
    second.append(blob_.data() + half, blob_.size() - half);
    one->send(ModelPart{0}, std::move(first));
    EXPECT_EQ(one->expect<NeedModel>(), NeedModel{half});
    one->send(ModelPart{half}, std::move(second));
    const Ready ready = one->expect<Ready>();
    EXPECT_EQ(ready.triangles, 12u);
    EXPECT_EQ(ready.description, "a fake");
}

TEST_F(ServerTest, KeepsAModelForTheNextClient) {
    ready_client(setup())->connection->finish();
    const auto two = client();
    two->send(setup());
    two->expect<Ready>();  // without asking
}

TEST_F(ServerTest, RefusesAModelWithAnotherDigest) {
    ServerSetup wrong = setup();
    wrong.digest[7] ^= 1;
    const auto one = client();
    one->send(wrong);
    one->expect<NeedModel>();
    one->send(ModelPart{0}, model_bytes());
    EXPECT_EQ(one->ending(), "the model that arrived does not have the announced SHA-256");
    EXPECT_FALSE(std::filesystem::exists(options_.cache));
}

TEST_F(ServerTest, RefusesAModelThatIsNone) {
    Buffer garbage(100);
    std::fill(garbage.data(), garbage.data() + 100, std::uint8_t{'x'});
    ServerSetup wrong = setup();
    wrong.digest = digest(garbage.bytes());
    wrong.blob_bytes = 100;
    const auto one = client();
    one->send(wrong);
    one->expect<NeedModel>();
    one->send(ModelPart{0}, std::move(garbage));
    EXPECT_EQ(one->ending(), "model blob: does not start with SWMB");
}

TEST_F(ServerTest, RefusesAModelAboveItsLimit) {
    ServerSetup large = setup();
    large.blob_bytes = (1 << 20) + 1;
    const auto one = client();
    one->send(large);
    EXPECT_THAT(one->ending(), HasSubstr("1048577 bytes, this server's limit is 1048576"));
}

TEST_F(ServerTest, RefusesPartsThatDoNotFit) {
    const auto ending_after = [&](std::uint64_t offset, std::size_t bytes) {
        const auto one = client();
        one->send(setup());
        one->expect<NeedModel>();
        one->send(ModelPart{offset}, Buffer(bytes));
        return one->ending();
    };
    const std::string size = std::to_string(blob_.size());
    EXPECT_EQ(ending_after(1, 10), "ModelPart: offset 1 where 0 was asked for");
    EXPECT_EQ(ending_after(0, 0), "ModelPart: 0 bytes where " + size + " are missing");
    EXPECT_EQ(ending_after(0, blob_.size() + 1),
              "ModelPart: " + std::to_string(blob_.size() + 1) + " bytes where " + size + " are missing");
}

TEST_F(ServerTest, RefusesPartsThatItDidNotAskFor) {
    const auto early = client();
    early->send(ModelPart{0}, model_bytes());
    EXPECT_EQ(early->ending(), "ModelPart is not expected now");
    const auto late = ready_client(setup());
    late->send(ModelPart{0}, model_bytes());
    EXPECT_EQ(late->ending(), "ModelPart is not expected now");
}

TEST_F(ServerTest, RefusesPartsWhileItLoadsTheModel) {
    std::atomic<bool> loading = false;
    std::promise<void> go_on;
    before_renderer_ = [&] {
        loading = true;
        go_on.get_future().wait();
        return Status();
    };
    const auto one = client();
    one->send(setup());
    one->expect<NeedModel>();
    one->send(ModelPart{0}, model_bytes());
    loop_.run_until([&] { return loading.load(); });
    one->send(ModelPart{0}, model_bytes());
    go_on.set_value();  // before the loop runs: the session's end waits for the renderer in this thread
    EXPECT_EQ(one->ending(), "ModelPart is not expected now");
}

TEST_F(ServerTest, SaysWhyItHasNoRenderer) {
    before_renderer_ = [] { return Status(fail("EGL: no surfaceless platform")); };
    const auto one = client();
    one->send(setup());
    one->expect<NeedModel>();
    one->send(ModelPart{0}, model_bytes());
    EXPECT_EQ(one->ending(), "EGL: no surfaceless platform");
}

TEST_F(ServerTest, RefusesMessagesOutOfTurn) {
    const auto ending_after = [&](const Message& message) {
        const auto one = client();
        one->send(message);
        return one->ending();
    };
    EXPECT_EQ(ending_after(Connect{}), "Connect is not expected now");
    EXPECT_EQ(ending_after(DisplaySetup{}), "DisplaySetup is not expected from a client");
    objects_ = 1;
    EXPECT_EQ(ending_after(task(0)), "RenderFrame before Connected");
    const auto twice = ready_client(setup());
    twice->send(setup());
    EXPECT_EQ(twice->ending(), "ServerSetup came twice");
}

TEST_F(ServerTest, ConnectsToTheDisplayAndTheServersThatWereThereBefore) {
    const auto one = connected_client(1, 3);
    EXPECT_EQ(display_->hello, hello_of(Role::kServer, kSession, 1));
    EXPECT_EQ(others_[0]->hello, hello_of(Role::kServer, kSession, 1));
    EXPECT_EQ(others_[2]->hello, hello_of(Role::kServer, kSession, 1));
    one->send(connect_to());
    EXPECT_EQ(one->ending(), "Connect is not expected now");
}

// An open connection takes no pixels yet.
TEST_F(ServerTest, IsNotConnectedBeforeAllHaveReadItsHello) {
    const auto one = ready_client(setup(1));
    one->send(connect_to(1));
    const Peer other(loop_, doors_[0]->next(), hello_of(Role::kServer, kSession, 0));
    loop_.run_until([&] { return other.connection->has_clock_offset(); });
    RawPeer display(loop_, display_door_.next());
    // It says Hello, but not that it has read ours.
    display.send(wire_bytes(hello_of(Role::kDisplay, kSession)));
    display.read(1);
    one->send(task(0));
    EXPECT_EQ(one->ending(), "RenderFrame before Connected");
}

TEST_F(ServerTest, SaysWhereItCannotConnect) {
    const auto one = ready_client(setup());
    one->send(Connect{"nowhere", {}});
    EXPECT_EQ(one->ending(), "address 'nowhere': expected HOST:PORT");

    Loop other;
    const std::string closed = to_string(Door(other).address());
    const auto two = ready_client(setup());
    two->send(Connect{closed, {}});
    EXPECT_EQ(two->ending(), "cannot connect to " + closed + ": Connection refused (tried for 0.2 s)");
}

TEST_F(ServerTest, SaysWhoAnswersInsteadOfTheDisplay) {
    const auto ending_with = [&](const Hello& hello) {
        const auto one = ready_client(setup());
        one->send(connect_to());
        const Peer wrong(loop_, display_door_.next(), hello);
        return one->ending();
    };
    EXPECT_THAT(ending_with(hello_of(Role::kServer, kSession)),
                testing::AllOf(StartsWith("lost the display at "),
                               HasSubstr(": a server answers where a display is expected")));
    EXPECT_THAT(ending_with(hello_of(Role::kDisplay, 41)), HasSubstr(": this display is in another session"));
}

TEST_F(ServerTest, TurnsAwayServersOfOtherSessionsAndStrangers) {
    const auto one = connected_client(1, 3);
    const auto turned_away = [&](std::uint64_t session, std::size_t server) {
        return come(hello_of(Role::kServer, session, server))->ending();
    };
    EXPECT_EQ(turned_away(41, 2), "this server is in another session");
    EXPECT_EQ(turned_away(kSession, 2), "server 2 is not expected here");  // it is there already
    EXPECT_EQ(turned_away(kSession, 0), "server 0 is not expected here");  // we connect to that one
    EXPECT_EQ(turned_away(kSession, 1), "server 1 is not expected here");  // that is ourselves
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(ServerTest, TellsTheClientWhichPeerIsLostAndGoesOn) {
    for (const std::size_t lost : {0u, 2u}) {
        const auto one = connected_client(1, 3);
        loop_.run_until([&] { return others_[lost]->connection->has_clock_offset(); });
        others_[lost]->connection->close();
        EXPECT_EQ(one->expect<Lost>(), (Lost{server_id(lost), "closed the connection"}));
        one->send(task(0));
        one->expect<ServerReport>();
        one->connection->finish();
        EXPECT_EQ(display_->ending(), "");
    }
}

TEST_F(ServerTest, RefusesToConnectToWhomItKnows) {
    const auto ending_after = [&](std::size_t server) {
        const auto one = ready_client(setup(1));
        const auto known = come(hello_of(Role::kServer, kSession, 2));
        loop_.run_until([&] { return known->connection->has_clock_offset(); });
        Connect connect = connect_to();
        connect.peers.push_back({server_id(server), "127.0.0.1:1"});
        one->send(connect);
        return one->ending();
    };
    EXPECT_EQ(ending_after(1), "Connect: server 1 is not expected");
    EXPECT_EQ(ending_after(2), "Connect: server 2 is not expected");
}

TEST_F(ServerTest, TakesServersThatJoinLaterAndForgetsThoseThatLeave) {
    const auto one = connected_client(0, 2);
    const auto newcomer = come(hello_of(Role::kServer, kSession, 7));
    loop_.run_until([&] { return newcomer->connection->has_clock_offset(); });
    RenderFrame swap = task(0);
    swap.final_region = {{0, 0, 4, 4}};
    swap.outgoing = {{server_id(7), {{4, 0, 8, 4}}}};
    one->send(swap);
    EXPECT_EQ(newcomer->expect<SwathPixels>().frame, 0u);
    display_->expect<TilePixels>();
    one->expect<ServerReport>();

    newcomer->connection->finish();
    others_[1]->connection->finish();
    const auto again = come(hello_of(Role::kServer, kSession, 7));  // another server with that number
    loop_.run_until([&] { return again->connection->has_clock_offset(); });
    one->send(task(1));
    display_->expect<TilePixels>();
    one->expect<ServerReport>();
    swap.frame = 2;
    swap.outgoing[0].server = server_id(1);
    one->send(swap);
    EXPECT_EQ(one->ending(), "RenderFrame: an exchange with server 1");
}

TEST_F(ServerTest, TakesLeaveWhenItIsToldToStop) {
    const auto one = connected_client(0, 2);
    one->send(task(0));
    bool left = false;
    server_->leave([&] { left = true; });
    one->expect<Leave>();
    display_->expect<TilePixels>();
    one->expect<ServerReport>();
    EXPECT_EQ(client()->ending(), "this server is being stopped");
    EXPECT_FALSE(left);
    one->connection->finish();
    EXPECT_EQ(others_[1]->ending(), "");
    EXPECT_EQ(display_->ending(), "");
    EXPECT_TRUE(loop_.run_until([&] { return left; }));
}

TEST_F(ServerTest, LeavesAtOnceWithoutAClient) {
    bool left = false;
    server_->leave([&] { left = true; });
    EXPECT_TRUE(left);
}

TEST_F(ServerTest, AnswersAProbe) {
    const auto probe = come(hello_of(Role::kProbe));
    loop_.run_until([&] { return probe->connection->has_clock_offset(); });
    EXPECT_EQ(probe->hello, hello_of(Role::kServer));
    const auto one = connected_client();
    probe->connection->finish();
    one->send(task(0));
    one->expect<ServerReport>();
}

TEST_F(ServerTest, TakesNoSwathsFromAProbe) {
    const auto one = connected_client();
    const auto probe = come(hello_of(Role::kProbe));
    probe->send(SwathPixels{});
    EXPECT_THAT(probe->ending(), HasSubstr("SwathPixels is not expected"));
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(ServerTest, TellsTheClientThatTheDisplayIsLost) {
    const auto one = connected_client();
    display_->connection->fail_with({"out of paper"});
    EXPECT_THAT(one->ending(), testing::MatchesRegex("lost the display at .*: out of paper"));
}

TEST_F(ServerTest, ServesTheNextClientAfterOneThatVanished) {
    {
        const auto one = connected_client(0, 2);
        one->send(task(0));
    }
    EXPECT_EQ(display_->ending(), "");  // a Bye
    EXPECT_EQ(others_[1]->ending(), "");
    const auto two = connected_client();
    two->send(task(0));
    display_->expect<TilePixels>();
    two->expect<ServerReport>();
}

// Cutting, drawing and culling anew.

TEST_F(ServerTest, CutsTheModelAnewBetweenFrames) {
    const auto one = connected_client();
    Drawing drawing = setup().drawing;
    drawing.cut.depth = 0;
    drawing.cull = CullAlgorithm::kNone;
    one->send(Reconfigure{drawing});
    const Ready ready = one->expect<Ready>();
    EXPECT_EQ(ready.objects, 1u);
    EXPECT_EQ(ready.triangles, 12u);
    EXPECT_EQ(ready.refused, "");
    one->send(task(0));  // names objects that are gone
    EXPECT_THAT(one->ending(), HasSubstr("this model has 1"));
}

TEST_F(ServerTest, MakesARayCasterAsItIsTold) {
    const auto one = connected_client();
    Drawing drawing = setup().drawing;
    const RendererSetup before = asked_;
    drawing.renderers = {RendererKind::kRaycast};
    drawing.flags.shadows = true;
    one->send(Reconfigure{drawing});
    EXPECT_EQ(one->expect<Ready>().refused, "");
    EXPECT_EQ(asked_, (RendererSetup{RendererKind::kRaycast, {true, false}, options_.threads}));
    drawing.flags = {.dynamic = true};
    one->send(Reconfigure{drawing});
    EXPECT_EQ(one->expect<Ready>().refused, "");
    EXPECT_EQ(asked_, (RendererSetup{RendererKind::kRaycast, {false, true}, options_.threads}));
    EXPECT_EQ(before, (RendererSetup{RendererKind::kOsmesa, {false, false}, options_.threads}));
}

TEST_F(ServerTest, MakesTheRendererThatItsNumberIsDealt) {
    ServerSetup second = setup(1);
    second.drawing.renderers = {RendererKind::kOsmesa, RendererKind::kRaycast};
    const auto one = ready_client(second);
    EXPECT_EQ(asked_.kind, RendererKind::kRaycast);
}

TEST_F(ServerTest, GoesOnAsBeforeWhenItCannotDrawDifferently) {
    const auto one = connected_client();
    int made = 0;
    before_renderer_ = [&] { return made++ == 0 ? Status(fail("EGL: no surfaceless platform")) : Status(); };
    one->send(Reconfigure{{{{RendererKind::kEgl}, CullAlgorithm::kWide, {}}, {}}});
    const Ready ready = one->expect<Ready>();
    EXPECT_EQ(ready.refused, "EGL: no surfaceless platform");
    EXPECT_EQ(ready.objects, objects_);
    one->send(task(0));
    display_->expect<TilePixels>();
    EXPECT_EQ(one->expect<ServerReport>().visible.size(), objects_);
}

TEST_F(ServerTest, EndsTheSessionWhenItCannotGoBackEither) {
    const auto one = connected_client();
    before_renderer_ = [] { return Status(fail("no more memory")); };
    one->send(Reconfigure{{{{RendererKind::kEgl}, CullAlgorithm::kWide, {}}, {}}});
    EXPECT_EQ(one->ending(), "no more memory");
}

TEST_F(ServerTest, RefusesToChangeOutOfTurn) {
    const auto early = client();
    early->send(Reconfigure{});
    EXPECT_EQ(early->ending(), "Reconfigure is not expected now");
    // The renderer takes long enough for a message that is already on its way. The session's end waits for
    // it, in this thread.
    const auto slow = std::make_shared<std::atomic<bool>>(false);
    before_renderer_ = [slow] {
        if (slow->exchange(false)) std::promise<void>().get_future().wait_for(std::chrono::seconds(1));
        return Status();
    };
    const auto ending_while_changing = [&](const Message& message) {
        const auto one = connected_client();
        *slow = true;
        one->send(Reconfigure{{{{RendererKind::kEgl}, CullAlgorithm::kWide, {}}, {.depth = 2}}});
        one->send(message);
        return one->ending();
    };
    EXPECT_EQ(ending_while_changing(Reconfigure{}), "Reconfigure is not expected now");
    EXPECT_EQ(ending_while_changing(task(0)), "RenderFrame before Ready");
}

}  // namespace
}  // namespace swath::test
