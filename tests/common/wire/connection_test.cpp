#include "common/wire/connection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/wire_peer.h"

namespace swath {
namespace {

using namespace test;
using boost::asio::ip::tcp;
using std::chrono::milliseconds;
using testing::HasSubstr;

class ShiftedClock final : public Clock {
  public:
    explicit ShiftedClock(Nanoseconds shift) : shift_(shift) {}
    Nanoseconds now() const override { return SteadyClock().now() + shift_; }
    Nanoseconds thread_cpu() const override { return Nanoseconds(0); }

  private:
    Nanoseconds shift_;
};

Buffer noise(std::size_t bytes) {
    Buffer buffer(bytes);
    std::mt19937 random(1);
    for (std::size_t i = 0; i < bytes; ++i) buffer.data()[i] = static_cast<std::uint8_t>(random());
    return buffer;
}

std::string text_of(const Buffer& buffer) { return {buffer.bytes().begin(), buffer.bytes().end()}; }

// Two programs that talk.
class ConnectionTest : public testing::Test {
  protected:
    explicit ConnectionTest(const Connection::Options& options = {}) : ConnectionTest(options, nullptr) {}
    ConnectionTest(const Connection::Options& options, const Clock* second_clock) {
        auto [one, two] = socket_pair(loop_);
        Connection::Options first = options;
        first.hello = hello_of(Role::kClient, 0, 0);
        a_ = std::make_unique<Peer>(loop_, std::move(one), first);
        Connection::Options second = options;
        second.hello = hello_of(Role::kServer, 77, 3);
        b_ = std::make_unique<Peer>(loop_, std::move(two), second, second_clock);
    }

    Loop loop_;
    std::unique_ptr<Peer> a_, b_;
};

TEST_F(ConnectionTest, StartsWithTheHelloOfBothEnds) {
    loop_.run_until([&] { return a_->hello && b_->hello; });
    EXPECT_EQ(b_->hello, hello_of(Role::kClient));
    EXPECT_EQ(a_->hello, hello_of(Role::kServer, 77, 3));
}

TEST_F(ConnectionTest, BringsMessagesInOrderWithTheirBodies) {
    a_->send(Connect{});
    a_->send(ModelPart{5}, noise(1000));
    b_->send(NeedModel{9});
    b_->expect<Connect>();
    EXPECT_EQ(b_->expect<ModelPart>(), ModelPart{5});
    EXPECT_EQ(text_of(b_->body), text_of(noise(1000)));
    EXPECT_EQ(a_->expect<NeedModel>(), NeedModel{9});
    EXPECT_EQ(a_->body.size(), 0u);
}

TEST_F(ConnectionTest, BringsABodyOf64MebibytesIntact) {
    a_->send(ModelPart{0}, noise(std::size_t{64} << 20));
    b_->expect<ModelPart>();
    EXPECT_TRUE(text_of(b_->body) == text_of(noise(std::size_t{64} << 20)));
}

TEST_F(ConnectionTest, SaysHowManyBytesItAddsToABody) {
    loop_.run_until([&] { return a_->hello.has_value(); });
    const auto sent = a_->connection->offer(ModelPart{1}, noise(100));
    ASSERT_TRUE(sent.has_value());
    EXPECT_EQ(*sent, wire_bytes(ModelPart{1}).size());
}

TEST_F(ConnectionTest, EndsCleanlyWithBye) {
    a_->send(ModelPart{0}, noise(std::size_t{8} << 20));
    a_->connection->finish();
    b_->expect<ModelPart>();
    EXPECT_EQ(b_->ending(), "");
    EXPECT_FALSE(a_->closed.has_value());  // its owner asked for it
}

TEST_F(ConnectionTest, TellsTheOtherEndWhatFailed) {
    a_->connection->fail_with({"the model has moved"});
    EXPECT_EQ(b_->ending(), "the model has moved");
    EXPECT_EQ(a_->ending(), "the model has moved");
}

TEST_F(ConnectionTest, TellsTheOtherEndWhatItDidWrong) {
    b_->answer = [](const Message& m) { return Status(fail("{} comes too early", name(m))); };
    a_->send(Connect{});
    EXPECT_EQ(a_->ending(), "Connect comes too early");
    EXPECT_EQ(b_->ending(), "Connect comes too early");
}

// The other end has more to send than the sockets' buffers hold: it must read on to learn why.
TEST_F(ConnectionTest, TellsAnEndThatKeepsSendingWhatFailed) {
    for (int round = 0; round < 20; ++round) {
        auto [one, two] = socket_pair(loop_);
        Peer sender(loop_, std::move(one), hello_of(Role::kClient));
        Peer receiver(loop_, std::move(two), hello_of(Role::kServer));
        receiver.answer = [](const Message&) { return Status(fail("enough of this")); };
        sender.send(Connect{});
        for (std::uint64_t i = 0; i < 16; ++i) sender.send(ModelPart{i}, Buffer(std::size_t{1} << 20));
        EXPECT_EQ(sender.ending(), "enough of this");
        EXPECT_EQ(receiver.ending(), "enough of this");
    }
}

TEST_F(ConnectionTest, SaysByeToAnEndThatKeepsSending) {
    loop_.run_until([&] { return a_->hello && b_->hello; });
    for (std::uint64_t i = 0; i < 16; ++i) b_->send(ModelPart{i}, Buffer(std::size_t{1} << 20));
    a_->connection->finish();
    EXPECT_EQ(b_->ending(), "");
}

TEST_F(ConnectionTest, ClosesAtOnceWithoutACallback) {
    loop_.run_until([&] { return a_->hello && b_->hello; });
    a_->connection->close();
    EXPECT_EQ(b_->ending(), "closed the connection");
    EXPECT_FALSE(a_->closed.has_value());
    EXPECT_EQ(a_->connection->offer(Connect{}), 0u);  // it goes nowhere, and its owner knows
}

TEST_F(ConnectionTest, RefusesToSendMoreThanTheOtherEndAccepts) {
    const auto before_hello = a_->connection->offer(ModelPart{0}, noise(1));
    ASSERT_FALSE(before_hello.has_value());
    EXPECT_EQ(before_hello.error().message, "a ModelPart of 2 and 1 bytes, its limits are 1024 and 0");
}

class ClocksTest : public ConnectionTest {
  protected:
    ClocksTest() : ConnectionTest({}, &shifted()) {}
    // It is made before the connections and outlives them.
    static const ShiftedClock& shifted() {
        static const ShiftedClock clock(std::chrono::seconds(1000));
        return clock;
    }
};

TEST_F(ClocksTest, EstimateTheirOffsetFromPingAndPong) {
    EXPECT_FALSE(a_->connection->has_clock_offset());
    EXPECT_EQ(a_->connection->clock_offset(), Nanoseconds(0));
    loop_.run_until([&] { return a_->connection->has_clock_offset() && b_->connection->has_clock_offset(); });
    EXPECT_NEAR(std::chrono::duration<double>(a_->connection->clock_offset()).count(), -1000, 0.5);
    EXPECT_NEAR(std::chrono::duration<double>(b_->connection->clock_offset()).count(), 1000, 0.5);
}

TEST_F(ConnectionTest, OfOneMachineHasAClockOffsetNearZero) {
    loop_.run_until([&] { return a_->connection->has_clock_offset(); });
    EXPECT_NEAR(std::chrono::duration<double>(a_->connection->clock_offset()).count(), 0, 0.5);
}

// A program of ours, and a stranger that connects to it.
class StrangerTest : public testing::Test {
  protected:
    StrangerTest() : StrangerTest(Connection::Options()) {}
    explicit StrangerTest(const Connection::Options& options) {
        auto [one, two] = socket_pair(loop_);
        stranger_ = std::make_unique<RawPeer>(loop_, std::move(one));
        Connection::Options ours = options;
        ours.hello = hello_of(Role::kServer);
        us_ = std::make_unique<Peer>(loop_, std::move(two), ours);
    }
    static std::string hello() { return wire_bytes(hello_of(Role::kClient)); }
    // Both ends get the line.
    void expect_refusal(const std::string& line) {
        EXPECT_EQ(us_->ending(), line);
        EXPECT_THAT(stranger_->read_to_end(), HasSubstr(line));
    }

    Loop loop_;
    std::unique_ptr<RawPeer> stranger_;
    std::unique_ptr<Peer> us_;
};

TEST_F(StrangerTest, OfAnotherVersionIsToldBothVersions) {
    std::string other = hello();
    other[4] = 1;
    stranger_->send(other);
    expect_refusal("speaks version 1 of the protocol, this program speaks 6");
}

TEST_F(StrangerTest, WhoSpeaksAnotherProtocolIsRefused) {
    stranger_->send("GET / HTTP/1.1\r\n\r\n");
    expect_refusal("not a Swath message");
}

TEST_F(StrangerTest, MustSayHelloFirst) {
    stranger_->send(wire_bytes(Connect{}));
    expect_refusal("sent Connect before Hello");
}

TEST_F(StrangerTest, MustSayHelloOnce) {
    stranger_->send(hello() + hello());
    expect_refusal("sent Hello twice");
}

TEST_F(StrangerTest, MayNotAnnounceALongHelloHead) {
    stranger_->send(prefix_bytes(1025, 0));
    expect_refusal("a message head of 1025 bytes, the limit is 1024");
}

TEST_F(StrangerTest, MayNotAnnounceABodyWithHello) {
    stranger_->send(prefix_bytes(10, 1));
    expect_refusal("a message body of 1 bytes, the limit is 0");
}

TEST_F(StrangerTest, MayNotAnnounceMoreThanOurHelloAllows) {
    stranger_->send(hello() + prefix_bytes(10, (512u << 20) + 1));
    expect_refusal("a message body of 536870913 bytes, the limit is 536870912");
}

TEST_F(StrangerTest, MayNotAnnounceALongerHeadThanOurHelloAllows) {
    stranger_->send(hello() + prefix_bytes(0xffffffff, 0));
    expect_refusal("a message head of 4294967295 bytes, the limit is 4194304");
}

TEST_F(StrangerTest, WhoseHeadIsGarbledIsRefused) {
    stranger_->send(hello() + prefix_bytes(5, 0) + "\xff\xff\xff\xff\xff");
    expect_refusal("a garbled message head");
}

TEST_F(StrangerTest, MayNotNameATimeThatWouldOverflow) {
    std::string pong = wire_bytes(Pong{Nanoseconds(1), Nanoseconds(2)});
    pong.replace(pong.size() - 8, 8, std::string(7, '\xff') + '\x7f');
    stranger_->send(hello() + pong);
    expect_refusal("a garbled pong message: peer_ns: outside of 0 to 2305843009213693952");
}

TEST_F(StrangerTest, WhoClosesBetweenMessagesHasClosed) {
    stranger_->send(hello());
    loop_.run_until([&] { return us_->hello.has_value(); });
    stranger_->read(100);  // unread bytes would turn the close into a reset
    stranger_->close();
    EXPECT_EQ(us_->ending(), "closed the connection");
}

TEST_F(StrangerTest, WhoDiesWithinAMessageIsFoundOut) {
    for (const std::string& part :
         {hello().substr(0, 7), hello().substr(0, 20), hello() + prefix_bytes(5, 9) + "abc"}) {
        auto [one, two] = socket_pair(loop_);
        Peer us(loop_, std::move(two), hello_of(Role::kServer));
        RawPeer stranger(loop_, std::move(one));
        stranger.read(wire_bytes(hello_of(Role::kServer)).size() + wire_bytes(Ping{Nanoseconds(1)}).size());
        stranger.send(part);
        stranger.close();
        EXPECT_EQ(us.ending(), "closed the connection within a message");
    }
}

class ImpatientTest : public StrangerTest {
  protected:
    ImpatientTest() : StrangerTest(options()) {}
    static Connection::Options options() {
        Connection::Options made;
        made.timing = {milliseconds(20), milliseconds(150)};
        return made;
    }
};

TEST_F(ImpatientTest, EndsAPeerThatSaysNothing) { EXPECT_THAT(us_->ending(), HasSubstr("silent for 0.")); }

TEST_F(ImpatientTest, EndsAPeerThatFallsSilentAfterHello) {
    stranger_->send(hello());
    EXPECT_THAT(us_->ending(), HasSubstr("silent for 0."));
}

TEST_F(ImpatientTest, EndsAPeerThatFallsSilentWithinAMessage) {
    stranger_->send(hello() + prefix_bytes(10, 1000) + "abc");
    EXPECT_THAT(us_->ending(), HasSubstr("silent for 0."));
}

// The peer knows why and does not react: the connection does not wait for ever.
TEST_F(ImpatientTest, LetsGoOfAPeerThatDoesNotHangUp) {
    auto [one, two] = socket_pair(loop_);
    RawPeer deaf(loop_, std::move(one));
    auto connection = std::make_shared<Connection>(std::move(two), options(), loop_.clock);
    std::string ending;
    connection->start({[](const Hello&) { return Status(); }, [](Message&&, Buffer&&) { return Status(); },
                       [&](const Status& why) { ending = why.error().message; }});
    deaf.send("GET / HTTP/1.1\r\n\r\n");
    loop_.run_until([&] { return !ending.empty(); });
    EXPECT_EQ(ending, "not a Swath message");
    const std::weak_ptr<Connection> gone = connection;
    connection.reset();
    EXPECT_FALSE(gone.expired());  // the peer may still be reading
    loop_.run_until([&] { return gone.expired(); });
}

class HeartbeatTest : public StrangerTest {
  protected:
    HeartbeatTest() : StrangerTest(options()) {}
    static Connection::Options options() {
        Connection::Options made;
        made.timing = {milliseconds(10), std::chrono::seconds(20)};
        return made;
    }
};

TEST_F(HeartbeatTest, PingsWhenItHasNothingElseToSay) {
    stranger_->send(hello());
    const std::size_t ping = wire_bytes(Ping{Nanoseconds(1)}).size();
    stranger_->read(wire_bytes(hello_of(Role::kServer)).size() + 5 * ping);
    EXPECT_FALSE(us_->closed.has_value());
}

class SmallQueueTest : public StrangerTest {
  protected:
    SmallQueueTest() : StrangerTest(options()) {}
    static Connection::Options options() {
        Connection::Options made;
        made.max_queued_bytes = 1 << 20;
        made.timing.silence_limit = std::chrono::seconds(20);  // the stranger only reads
        return made;
    }
};

TEST_F(SmallQueueTest, IsFullWhenAPeerDoesNotRead) {
    stranger_->send(hello());
    loop_.run_until([&] { return us_->hello.has_value(); });
    Result<std::size_t> sent = 0;
    // The sockets' buffers take some megabytes before the queue fills.
    for (std::size_t i = 0; i < 10'000 && sent; ++i) {
        sent = us_->connection->offer(ModelPart{i}, Buffer(64 << 10));
        loop_.io.poll();
    }
    ASSERT_FALSE(sent.has_value());
    EXPECT_EQ(sent.error().message, "does not read: its send queue is full");
}

TEST_F(SmallQueueTest, EmptiesWhenThePeerReads) {
    stranger_->send(hello());
    loop_.run_until([&] { return us_->hello.has_value(); });
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto sent = us_->connection->offer(ModelPart{i}, Buffer(512 << 10));
        ASSERT_TRUE(sent.has_value()) << sent.error().message;
        bytes += *sent + (512 << 10);
        stranger_->read(bytes);
    }
}

}  // namespace
}  // namespace swath
