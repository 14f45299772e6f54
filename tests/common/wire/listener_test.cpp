#include "common/wire/listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/post.hpp>

#include "tests/support/wire_peer.h"

namespace swath {
namespace {

using namespace test;
using boost::asio::ip::tcp;
using std::chrono::milliseconds;
using testing::HasSubstr;

std::string listen_error(Loop& loop, const Address& address) {
    const auto listener = Listener::make(loop.io, address, [](tcp::socket) {});
    return listener ? "it listens" : listener.error().message;
}

// The result of async_connect: its error, or "connected".
std::string outcome(Loop& loop, const Address& address, Nanoseconds patience) {
    std::string said;
    async_connect(loop.io, address, patience, [&](Result<tcp::socket> socket) {
        EXPECT_EQ(said, "");
        said = socket ? "connected" : socket.error().message;
    });
    loop.run_until([&] { return !said.empty(); });
    return said;
}

TEST(Listener, TakesAFreePortAndSaysWhich) {
    Loop loop;
    Door door(loop);
    EXPECT_EQ(door.address().host, "127.0.0.1");
    EXPECT_NE(door.address().port, 0);
    EXPECT_EQ(outcome(loop, door.address(), milliseconds(5000)), "connected");
    EXPECT_TRUE(door.next().is_open());
}

TEST(Listener, NamesTheAddressThatIsTaken) {
    Loop loop;
    Door door(loop);
    EXPECT_EQ(listen_error(loop, door.address()),
              "cannot listen on " + to_string(door.address()) + ": Address already in use");
}

TEST(Listener, NamesTheAddressThatIsNotOurs) {
    Loop loop;
    EXPECT_THAT(listen_error(loop, {"192.0.2.1", 4000}), HasSubstr("cannot listen on 192.0.2.1:4000: "));
}

TEST(Listener, LetsGoOfItsPortWhenItIsDestroyed) {
    Loop loop;
    Address address;
    {
        Door door(loop);
        address = door.address();
    }
    EXPECT_EQ(listen_error(loop, address), "it listens");
}

// Two connections wait: the second is taken off the socket with the first, before the listener is destroyed.
TEST(Listener, TakesNobodyInOnceItIsDestroyed) {
    Loop loop;
    std::unique_ptr<Listener> listener;
    int taken = 0;
    listener = std::move(*Listener::make(loop.io, {"127.0.0.1", 0}, [&](tcp::socket) {
        ++taken;
        boost::asio::post(loop.io, [&] { listener.reset(); });
    }));
    const tcp::socket first = connect(loop, listener->address());
    const tcp::socket second = connect(loop, listener->address());
    loop.run_until([&] { return !listener; });
    loop.io.poll();
    EXPECT_EQ(taken, 1);
}

TEST(Connecting, ToNobodyGivesOneLineWhenPatienceIsOver) {
    Loop loop;
    Address address;
    {
        Door door(loop);
        address = door.address();
    }
    EXPECT_EQ(outcome(loop, address, milliseconds(150)),
              "cannot connect to " + to_string(address) + ": Connection refused (tried for 0.1 s)");
}

TEST(Connecting, WaitsForAProgramThatIsJustStarting) {
    Loop loop;
    Address address;
    {
        Door door(loop);
        address = door.address();
    }
    std::string said;
    async_connect(loop.io, address, milliseconds(8000),
                  [&](Result<tcp::socket> socket) { said = socket ? "connected" : socket.error().message; });
    for (int i = 0; i < 100; ++i) loop.io.poll();
    EXPECT_EQ(said, "");
    const auto listener = Listener::make(loop.io, address, [](tcp::socket) {});
    ASSERT_TRUE(listener.has_value()) << listener.error().message;
    loop.run_until([&] { return !said.empty(); });
    EXPECT_EQ(said, "connected");
}

TEST(LocalAddress, IsOnLoopbackUnlessItSaysOtherwise) {
    EXPECT_EQ(parse_local_address("8080"), (Address{"127.0.0.1", 8080}));
    EXPECT_EQ(parse_local_address("0.0.0.0:80"), (Address{"0.0.0.0", 80}));
    EXPECT_EQ(parse_local_address("[::1]:80"), (Address{"::1", 80}));
    for (const char* text : {"", "web", "8080x", "65536", ":80"})
        EXPECT_FALSE(parse_local_address(text)) << text;
}

TEST(Address, IsAHostAndAPort) {
    EXPECT_EQ(parse_address("localhost:80"), (Address{"localhost", 80}));
    EXPECT_EQ(parse_address("[::1]:65535"), (Address{"::1", 65535}));
    for (const char* const text : {"127.0.0.1:0", "host:1", "[fe80::1]:4000"})
        EXPECT_EQ(to_string(*parse_address(text)), text);
}

TEST(Address, ThatIsNoneIsNamed) {
    for (const char* const text : {"", ":", ":80", "host", "host:", "host:x", "host:65536", "host:-1",
                                   "host:80 ", "::1:80", "host:+1"}) {
        const auto address = parse_address(text);
        ASSERT_FALSE(address.has_value()) << text;
        EXPECT_THAT(address.error().message, HasSubstr(std::string("address '") + text + "': "));
    }
}

}  // namespace
}  // namespace swath
