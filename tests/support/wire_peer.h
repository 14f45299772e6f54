#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/wire/connection.h"
#include "common/wire/listener.h"

namespace swath::test {

// An event loop that a test runs until something has happened. Sockets on loopback are real, and all their
// ends are in the test's thread.
class Loop {
  public:
    // False, and a test failure, if it has not happened within ten seconds.
    bool run_until(const std::function<bool()>& happened);

    SteadyClock clock;
    boost::asio::io_context io{1};
};

// Listens on a free port and keeps connections.
class Door {
  public:
    explicit Door(Loop& loop);
    Address address() const { return listener_->address(); }
    boost::asio::ip::tcp::socket next();

  private:
    Loop& loop_;
    std::deque<boost::asio::ip::tcp::socket> sockets_;
    std::unique_ptr<Listener> listener_;
};

boost::asio::ip::tcp::socket connect(Loop& loop, const Address& address);
// Both ends of a connection.
std::pair<boost::asio::ip::tcp::socket, boost::asio::ip::tcp::socket> socket_pair(Loop& loop);

// A program at the other end of a connection, as far as a test needs one: it says Hello, keeps all messages
// and sends what it is told to.
class Peer {
  public:
    Peer(Loop& loop, boost::asio::ip::tcp::socket socket, const Connection::Options& options,
         const Clock* clock = nullptr);
    Peer(Loop& loop, boost::asio::ip::tcp::socket socket, const Hello& hello);
    ~Peer() { connection->close(); }
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    void send(const Message& message, Buffer body = {});
    // The next message, which must be an M; its body is kept in `body`.
    template <class M>
    M expect();
    // Waits for the end of the connection and returns the reason: "" after a Bye.
    std::string ending();

    std::shared_ptr<Connection> connection;
    std::optional<Hello> hello;
    std::deque<std::pair<Message, Buffer>> inbox;
    Buffer body;
    std::optional<Status> closed;
    std::function<Status(const Message&)> answer = [](const Message&) { return Status(); };

  private:
    std::optional<Message> next();
    static void wrong_kind(const Message& got, const Message& wanted);
    Loop& loop_;
};

template <class M>
M Peer::expect() {
    auto message = next();
    if (!message) return M{};
    if (auto* wanted = std::get_if<M>(&*message)) return std::move(*wanted);
    wrong_kind(*message, M{});
    return M{};
}

// A bad peer: sends and reads any bytes.
class RawPeer {
  public:
    RawPeer(Loop& loop, boost::asio::ip::tcp::socket socket) : loop_(loop), socket_(std::move(socket)) {}
    void send(std::string_view bytes);
    // Everything so far, once `count` bytes or the end have come.
    const std::string& read(std::size_t count);
    const std::string& read_to_end() { return read(std::string::npos); }
    void close() { socket_.close(); }

  private:
    Loop& loop_;
    boost::asio::ip::tcp::socket socket_;
    std::string received_;
    bool ended_ = false;
};

// A whole message as bytes.
std::string wire_bytes(const Message& message, std::string_view body = {});
// A prefix that announces what may never come.
std::string prefix_bytes(std::uint32_t head_bytes, std::uint32_t body_bytes);
// A Hello that accepts what a program usually accepts.
Hello hello_of(Role role, std::uint64_t session = 0, std::size_t server = 0);

}  // namespace swath::test
