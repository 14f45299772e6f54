#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace swath::test {

// TCP on loopback, spoken by hand, for peers that do not keep to the protocol. Blocking; throws
// std::runtime_error when something fails or takes too long.
class RawConnection {
  public:
    explicit RawConnection(int fd) : fd_(fd) {}
    // Connects to "127.0.0.1:PORT".
    explicit RawConnection(const std::string& address);
    ~RawConnection();
    RawConnection(const RawConnection&) = delete;
    RawConnection& operator=(const RawConnection&) = delete;

    void send(const std::string& bytes) const;
    // Reads until the other end closes.
    std::string read_to_end(std::chrono::milliseconds limit) const;
    // Reads until all that came is complete, or the other end closes.
    std::string read_until(const std::function<bool(std::string_view all)>& is_complete,
                           std::chrono::milliseconds limit) const;

  private:
    int fd_;
};

// Listens on a free port.
class RawListener {
  public:
    RawListener();
    ~RawListener();
    RawListener(const RawListener&) = delete;
    RawListener& operator=(const RawListener&) = delete;

    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
    RawConnection accept(std::chrono::milliseconds limit) const;

  private:
    int fd_;
    std::uint16_t port_ = 0;
};

// An address where nobody listens.
std::string closed_address();

// A message prefix as in docs/wire.md.
std::string raw_prefix(std::uint16_t version, std::uint32_t head_bytes, std::uint32_t body_bytes);
// The whole Hello of swath-client.
std::string client_hello();

}  // namespace swath::test
