#include "common/wire/session_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/wire_peer.h"

namespace swath {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

// A session that logs all calls.
class FakeSession final : public Session {
  public:
    FakeSession(std::vector<std::string>& log, std::shared_ptr<Connection> client)
        : log_(log), client_(std::move(client)) {
        log_.emplace_back("begin");
    }
    std::uint64_t id() const override { return 42; }
    ServerId server() const override { return server_id(3); }
    Status on_peer(const std::shared_ptr<Connection>& connection, const Hello& hello) override {
        if (hello.server == server_id(9)) return fail("server 9 is not expected here");
        peers_.push_back(connection);
        log_.push_back(fmt::format("server {}", index(hello.server)));
        return {};
    }
    Status on_message(const std::shared_ptr<Connection>& from, Message&& message, Buffer&&) override {
        if (std::holds_alternative<Ready>(message)) return fail("not now");
        log_.push_back(fmt::format("{} from {}", name(message), from == client_ ? "client" : "server"));
        return {};
    }
    bool on_closed(const std::shared_ptr<Connection>& connection, const Status& why) override {
        const bool is_client = connection == client_;
        log_.push_back(
            fmt::format("{} left: {}", is_client ? "client" : "server", why ? "Bye" : why.error().message));
        return is_client;
    }
    void leave() override { log_.emplace_back("leave"); }
    void stop() override {
        client_->finish();
        for (const auto& peer : peers_) peer->finish();
        log_.emplace_back("stop");
    }

  private:
    std::vector<std::string>& log_;
    std::shared_ptr<Connection> client_;
    std::vector<std::shared_ptr<Connection>> peers_;
};

class SessionHostTest : public testing::Test {
  protected:
    SessionHostTest() {
        auto host = SessionHost::make(loop_.io, {Role::kServer, {"127.0.0.1", 0}, {}}, loop_.clock,
                                      [this](std::shared_ptr<Connection> client) {
                                          return std::make_shared<FakeSession>(log_, std::move(client));
                                      });
        host_ = std::move(*host);
    }
    std::unique_ptr<Peer> come(const Hello& hello) {
        return std::make_unique<Peer>(loop_, connect(loop_, host_->address()), hello);
    }
    std::unique_ptr<Peer> client() {
        auto peer = come(hello_of(Role::kClient));
        const std::size_t before = log_.size();
        loop_.run_until([&] { return (log_.size() > before && peer->hello) || peer->closed; });
        return peer;
    }
    void run_until_log(const std::string& line) {
        loop_.run_until([&] { return !log_.empty() && log_.back() == line; });
    }

    Loop loop_;
    std::vector<std::string> log_;
    std::unique_ptr<SessionHost> host_;
};

TEST_F(SessionHostTest, GivesAClientASessionUntilItSaysBye) {
    const auto one = client();
    EXPECT_EQ(one->hello->role, Role::kServer);
    EXPECT_EQ(one->hello->session, 0u);
    one->send(Connect{});
    run_until_log("Connect from client");
    one->connection->finish();
    run_until_log("stop");
    EXPECT_THAT(log_, ElementsAre("begin", "Connect from client", "client left: Bye", "stop"));
}

TEST_F(SessionHostTest, TellsASecondClientThatItIsBusy) {
    const auto one = client();
    const auto two = come(hello_of(Role::kClient));
    EXPECT_EQ(two->ending(), "this server is busy with another client");
    one->send(Connect{});
    run_until_log("Connect from client");
    EXPECT_THAT(log_, ElementsAre("begin", "Connect from client"));
}

TEST_F(SessionHostTest, TakesTheNextClientWhenOneHasVanished) {
    { const auto one = client(); }
    run_until_log("stop");
    const auto two = client();
    two->send(Connect{});
    run_until_log("Connect from client");
    EXPECT_EQ(std::count(log_.begin(), log_.end(), "begin"), 2);
}

TEST_F(SessionHostTest, IntroducesServersToTheSession) {
    const auto one = client();
    const auto peer = come(hello_of(Role::kServer, 42, 5));
    run_until_log("server 5");
    loop_.run_until([&] { return peer->hello.has_value(); });
    EXPECT_EQ(peer->hello->session, 42u);
    EXPECT_EQ(peer->hello->server, server_id(3));
    peer->send(Connected{});
    run_until_log("Connected from server");
    peer->connection->finish();
    run_until_log("server left: Bye");
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(SessionHostTest, TurnsAwayServersThatItsSessionDoesNotExpect) {
    const auto lost = come(hello_of(Role::kServer, 42, 5));
    EXPECT_EQ(lost->ending(), "this server is in no session");
    const auto one = client();
    const auto wrong = come(hello_of(Role::kServer, 42, 9));
    EXPECT_EQ(wrong->ending(), "server 9 is not expected here");
    const auto display = come(hello_of(Role::kDisplay));
    EXPECT_EQ(display->ending(), "a server takes no connection from a display");
    EXPECT_THAT(log_, ElementsAre("begin"));
}

TEST_F(SessionHostTest, EndsOnlyTheConnectionThatSendsGarbage) {
    const auto one = client();
    RawPeer stranger(loop_, connect(loop_, host_->address()));
    stranger.send("\x16\x03\x01\x02\x01\x01\xfc\x03\x03 a TLS hello, say");
    EXPECT_THAT(stranger.read_to_end(), HasSubstr("not a Swath message"));
    RawPeer mute(loop_, connect(loop_, host_->address()));
    mute.close();
    one->send(Connect{});
    run_until_log("Connect from client");
    EXPECT_THAT(log_, ElementsAre("begin", "Connect from client"));
}

TEST_F(SessionHostTest, EndsTheSessionOfAClientThatErrs) {
    const auto one = client();
    one->send(Ready{});
    EXPECT_EQ(one->ending(), "not now");
    run_until_log("stop");
    EXPECT_THAT(log_, ElementsAre("begin", "client left: not now", "stop"));
    client();
    EXPECT_EQ(log_.back(), "begin");
}

TEST_F(SessionHostTest, SaysByeToItsClientWhenItIsDestroyed) {
    const auto one = client();
    const auto newcomer = std::make_unique<RawPeer>(loop_, connect(loop_, host_->address()));
    newcomer->read(1);
    host_.reset();
    EXPECT_EQ(one->ending(), "");
    newcomer->read_to_end();
    EXPECT_THAT(log_, ElementsAre("begin", "stop"));
}

TEST_F(SessionHostTest, NamesTheAddressThatIsTaken) {
    const auto second = SessionHost::make(loop_.io, {Role::kDisplay, host_->address(), {}}, loop_.clock,
                                          [](auto) { return std::shared_ptr<Session>(); });
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error().message,
              "cannot listen on " + to_string(host_->address()) + ": Address already in use");
}

}  // namespace
}  // namespace swath
