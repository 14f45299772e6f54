#pragma once
#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/address.h"
#include "common/wire/messages.h"
#include "display/view/viewers.h"

namespace swath {

// The limits for strangers (docs/viewer.md, Limits).
struct WebLimits {
    std::size_t connections = 64;  // viewers among them; one more is answered with 503
    std::size_t viewers = 32;
    std::uint32_t head_bytes = 8u << 10;              // of a request
    Nanoseconds head_time = std::chrono::seconds(5);  // to send a request's head, or to take an answer
    std::size_t text_bytes = kMaxWishBytes;           // of a viewer's message
    // A viewer that sends nothing, not even a pong, or takes nothing for this long is disconnected.
    Nanoseconds silence = std::chrono::seconds(20);
};

// HTTP and WebSocket for viewers. Serves the page (display/web), and makes a viewer of whoever opens /live.
// Refuses strangers as docs/viewer.md says; whatever a browser sends can harm only its own connection. Knows
// nothing of runs. Lives on the thread of its io_context, as do all calls of its handlers, and is destroyed
// when that no longer runs.
class WebServer {
  public:
    struct Options {
        Address listen{"127.0.0.1", 0};
        WebLimits limits;
        // The address that people use, if something forwards it to us. If that is on loopback, only people
        // there reach us, wherever we listen ourselves.
        std::optional<Address> published{};
    };
    struct Handlers {
        std::function<void(ViewerId)> on_join;
        // An error disconnects the viewer.
        std::function<Status(ViewerId, std::string_view)> on_text;
        // The last message to the viewer is written.
        std::function<void(ViewerId)> on_written;
        // Called once for each viewer that joined, after all other calls about it.
        std::function<void(ViewerId)> on_leave;
    };

    // Port 0 takes a free one. Errors name the address: taken, not ours, unknown host, or out of people's
    // reach.
    static Result<std::unique_ptr<WebServer>> make(boost::asio::io_context& io, const Options& options,
                                                   Handlers handlers);
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    // The address on which it listens, with the port that it got.
    const Address& address() const;
    // The page's address for people; off loopback with the token.
    const std::string& url() const;

    // Sends one message; the next may follow after on_written. Does nothing if the viewer has left.
    void send(ViewerId to, SharedBytes message, bool text);

  private:
    class Impl;
    explicit WebServer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace swath
