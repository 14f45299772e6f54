#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/result.h"
#include "common/wire/address.h"

namespace swath::test {

// The browser's end of the viewer's page, for tests and benchmarks: whole HTTP exchanges, and a WebSocket
// that blocks, with a time limit on everything.

inline constexpr std::chrono::milliseconds kWebPatience = std::chrono::seconds(20);

struct HttpAnswer {
    int status = 0;  // 0: no answer, or none that is HTTP
    std::string head;
    std::string body;
};
// Sends these bytes on a connection of their own and reads until the other end closes.
HttpAnswer http_exchange(const Address& address, std::string_view request);
// Sends one request with the usual head. `fields` are more header fields, each with its end of line.
HttpAnswer http_get(const Address& address, const std::string& target, const std::string& fields = {});

struct WebMessage {
    bool text = false;
    std::string bytes;
};

// A viewer. One thread.
class WebClient {
  public:
    struct Options {
        std::string token;
        std::string host;    // of the request; empty: the address
        std::string origin;  // empty: http:// and the host; "none": no such field
        std::string cookie;
        int receive_buffer_bytes = 0;  // the socket's; 0: the system's default
    };
    // Opens /live. The error has the status and text of a refusal.
    static Result<std::unique_ptr<WebClient>> connect(const Address& address, const Options& options);
    static Result<std::unique_ptr<WebClient>> connect(const Address& address, const std::string& token = {});
    ~WebClient();
    WebClient(const WebClient&) = delete;
    WebClient& operator=(const WebClient&) = delete;

    // False if it cannot be sent within the limit.
    bool send(std::string_view message, bool text = true);
    // The next message; nothing if none comes in time or the connection has ended.
    std::optional<WebMessage> next(std::chrono::milliseconds limit = kWebPatience);
    // The close code of the ended connection, 1006 without one; nothing while it lives.
    std::optional<int> close_code() const;
    void close();

  private:
    struct Impl;
    explicit WebClient(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace swath::test
