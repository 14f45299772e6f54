#include "tests/support/wire_peer.h"

#include <gtest/gtest.h>

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <vector>

namespace swath::test {
namespace asio = boost::asio;
using asio::ip::tcp;

bool Loop::run_until(const std::function<bool()>& happened) {
    const Nanoseconds deadline = clock.now() + std::chrono::seconds(10);
    while (!happened()) {
        if (clock.now() > deadline) {
            ADD_FAILURE() << "it did not happen within 10 s";
            return false;
        }
        io.restart();
        io.run_one_for(std::chrono::milliseconds(100));
    }
    return true;
}

Door::Door(Loop& loop) : loop_(loop) {
    listener_ = std::move(*Listener::make(loop.io, {"127.0.0.1", 0},
                                          [this](tcp::socket s) { sockets_.push_back(std::move(s)); }));
}

tcp::socket Door::next() {
    if (!loop_.run_until([this] { return !sockets_.empty(); })) return tcp::socket(loop_.io);
    tcp::socket socket = std::move(sockets_.front());
    sockets_.pop_front();
    return socket;
}

tcp::socket connect(Loop& loop, const Address& address) {
    tcp::socket socket(loop.io);
    socket.connect({asio::ip::make_address(address.host), address.port});
    return socket;
}

std::pair<tcp::socket, tcp::socket> socket_pair(Loop& loop) {
    Door door(loop);
    tcp::socket one = connect(loop, door.address());
    return {std::move(one), door.next()};
}

Peer::Peer(Loop& loop, tcp::socket socket, const Connection::Options& options, const Clock* clock)
    : connection(
          std::make_shared<Connection>(std::move(socket), options, clock != nullptr ? *clock : loop.clock)),
      loop_(loop) {
    connection->start({[this](const Hello& theirs) {
                           hello = theirs;
                           return Status();
                       },
                       [this](Message&& message, Buffer&& bytes) {
                           inbox.emplace_back(std::move(message), std::move(bytes));
                           return answer(inbox.back().first);
                       },
                       [this](const Status& why) { closed = why; }});
}

Peer::Peer(Loop& loop, tcp::socket socket, const Hello& hello_to_say)
    : Peer(loop, std::move(socket), [&] {
          Connection::Options options;
          options.hello = hello_to_say;
          return options;
      }()) {}

void Peer::send(const Message& message, Buffer bytes) {
    // The other end's Hello says what it may send.
    loop_.run_until([this] { return hello || closed; });
    const auto sent = connection->offer(message, std::move(bytes));
    EXPECT_TRUE(sent.has_value()) << sent.error().message;
}

std::optional<Message> Peer::next() {
    if (!loop_.run_until([this] { return !inbox.empty() || closed; })) return std::nullopt;
    if (inbox.empty()) {
        ADD_FAILURE() << "the connection ended: " << (*closed ? "Bye" : closed->error().message);
        return std::nullopt;
    }
    Message message = std::move(inbox.front().first);
    body = std::move(inbox.front().second);
    inbox.pop_front();
    return message;
}

void Peer::wrong_kind(const Message& got, const Message& wanted) {
    ADD_FAILURE() << name(got) << " came where " << name(wanted) << " was expected";
}

std::string Peer::ending() {
    if (!loop_.run_until([this] { return closed.has_value(); })) return "it did not end";
    return *closed ? "" : closed->error().message;
}

void RawPeer::send(std::string_view bytes) { asio::write(socket_, asio::buffer(bytes.data(), bytes.size())); }

const std::string& RawPeer::read(std::size_t count) {
    std::vector<char> some(std::size_t{256} << 10);
    while (!ended_ && received_.size() < count) {
        bool came = false;
        socket_.async_read_some(asio::buffer(some),
                                [&](const boost::system::error_code& error, std::size_t got) {
                                    received_.append(some.data(), got);
                                    came = true;
                                    ended_ = static_cast<bool>(error);
                                });
        if (!loop_.run_until([&] { return came; })) {
            socket_.cancel();
            loop_.run_until([&] { return came; });
            break;
        }
    }
    return received_;
}

std::string wire_bytes(const Message& message, std::string_view body) {
    const std::string head = encode_head(message);
    return prefix_bytes(static_cast<std::uint32_t>(head.size()), static_cast<std::uint32_t>(body.size())) +
           head + std::string(body);
}

std::string prefix_bytes(std::uint32_t head_bytes, std::uint32_t body_bytes) {
    const auto prefix = encode_prefix({head_bytes, body_bytes});
    return {prefix.begin(), prefix.end()};
}

Hello hello_of(Role role, std::uint64_t session, std::size_t server) {
    const WireLimits limits;
    return {role, session, server_id(server), limits.max_head_bytes, limits.max_body_bytes};
}

}  // namespace swath::test
