#include "tests/e2e/raw_peer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/wire/codec.h"

namespace swath::test {
namespace {

int check(int result, const char* what) {
    if (result < 0) throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
    return result;
}

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

int make_socket() { return check(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), "socket"); }

void wait_readable(int fd, std::chrono::milliseconds limit, const char* what) {
    pollfd wait{fd, POLLIN, 0};
    if (check(::poll(&wait, 1, static_cast<int>(limit.count())), "poll") == 0)
        throw std::runtime_error(std::string(what) + " within " + std::to_string(limit.count()) + " ms");
}

}  // namespace

RawConnection::RawConnection(const std::string& address) : fd_(make_socket()) {
    const int port = std::stoi(address.substr(address.rfind(':') + 1));
    const sockaddr_in to = loopback(static_cast<std::uint16_t>(port));
    check(::connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to), "connect");
}

RawConnection::~RawConnection() { ::close(fd_); }

void RawConnection::send(const std::string& bytes) const {
    for (std::size_t done = 0; done < bytes.size();)
        done += static_cast<std::size_t>(check(
            static_cast<int>(::send(fd_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL)), "send"));
}

std::string RawConnection::read_to_end(std::chrono::milliseconds limit) const {
    return read_until([](std::string_view) { return false; }, limit);
}

std::string RawConnection::read_until(const std::function<bool(std::string_view)>& is_complete,
                                      std::chrono::milliseconds limit) const {
    std::string all;
    std::array<char, 65536> piece;
    while (!is_complete(all)) {
        wait_readable(fd_, limit, "the other end did not close");
        const ssize_t got = ::recv(fd_, piece.data(), piece.size(), 0);
        if (got <= 0) break;  // a reset is an end, too
        all.append(piece.data(), static_cast<std::size_t>(got));
    }
    return all;
}

RawListener::RawListener() : fd_(make_socket()) {
    sockaddr_in address = loopback(0);
    check(::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), "bind");
    check(::listen(fd_, 8), "listen");
    socklen_t size = sizeof address;
    check(::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size), "getsockname");
    port_ = ntohs(address.sin_port);
}

RawListener::~RawListener() { ::close(fd_); }

RawConnection RawListener::accept(std::chrono::milliseconds limit) const {
    wait_readable(fd_, limit, "nobody connected");
    return RawConnection(check(::accept4(fd_, nullptr, nullptr, SOCK_CLOEXEC), "accept"));
}

std::string closed_address() { return RawListener().address(); }

std::string raw_prefix(std::uint16_t version, std::uint32_t head_bytes, std::uint32_t body_bytes) {
    std::string bytes = "SWTH";
    const auto put = [&](std::uint32_t value, int count) {
        for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    };
    put(version, 2);
    put(0, 2);
    put(head_bytes, 4);
    put(body_bytes, 4);
    return bytes;
}

std::string client_hello() {
    Hello hello;
    hello.role = Role::kClient;
    hello.max_head_bytes = 1 << 20;
    hello.max_body_bytes = 1 << 20;
    const std::string head = encode_head(hello);
    return raw_prefix(kWireVersion, static_cast<std::uint32_t>(head.size()), 0) + head;
}

}  // namespace swath::test
