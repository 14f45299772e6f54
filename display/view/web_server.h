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

// What strangers may ask of the web server (docs/viewer.md, Limits).
struct WebLimits {
    std::size_t connections = 64;  // one more is answered with 503; of these the viewers are
    std::size_t viewers = 32;
    std::uint32_t head_bytes = 8u << 10;  // of a request
    Nanoseconds head_time =
        std::chrono::seconds(5);             // until a request's head is there, or an answer is taken
    std::size_t text_bytes = kMaxWishBytes;  // of a viewer's message
    // A viewer that says nothing, not even that it is alive, or takes nothing for this long is disconnected.
    Nanoseconds silence = std::chrono::seconds(20);
};

// HTTP and WebSocket for people who look: serves the page (display/web) and turns who opens /live into
// viewers. It refuses strangers as docs/viewer.md says; whatever a browser sends, it costs no more than its
// own connection. Knows nothing of runs. Lives on the thread of its io_context, as do all calls of its
// handlers, and is destroyed when that no longer runs.
class WebServer {
  public:
    struct Options {
        Address listen{"127.0.0.1", 0};
        WebLimits limits;
        // Where people reach it, if that is elsewhere: something passes on what comes there. If it is on
        // loopback, so are the people, wherever we listen ourselves.
        std::optional<Address> published{};
    };
    struct Handlers {
        std::function<void(ViewerId)> on_join;
        // An error ends the viewer.
        std::function<Status(ViewerId, std::string_view)> on_text;
        // What was sent to it is written.
        std::function<void(ViewerId)> on_written;
        // Called once for each that joined; nothing else about it follows.
        std::function<void(ViewerId)> on_leave;
    };

    // Port 0 takes a free one. Errors name the address: taken, not ours, unknown host, nowhere to be reached.
    static Result<std::unique_ptr<WebServer>> make(boost::asio::io_context& io, const Options& options,
                                                   Handlers handlers);
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    // Where it listens itself, with the port that it got.
    const Address& address() const;
    // Where a person's browser finds it; off loopback with the token that opens it.
    const std::string& url() const;

    // One message at a time: the next after on_written. Nothing happens if the viewer has left.
    void send(ViewerId to, SharedBytes message, bool text);

  private:
    class Impl;
    explicit WebServer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace swath
