#pragma once
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/base/buffer.h"
#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/codec.h"

namespace swath {

// How patient the programs are with each other.
struct WireTiming {
    Nanoseconds heartbeat = std::chrono::milliseconds(250);  // silence after which a Ping is sent
    Nanoseconds silence_limit =
        std::chrono::milliseconds(1600);  // without a byte from the peer it is taken for dead
};

// One TCP connection that exchanges messages. Both ends start with a Hello; then each side sends what it
// likes. One writer, a send queue bounded in bytes, one silence watchdog; Ping, Pong, Failed and Bye are
// handled here. Owned by shared_ptr and by its pending operations; lives on the thread that runs its
// io_context, as do all its callbacks. It ends once: by close(), by the peer, by an error; on_closed is then
// called once (not after close()), and no other callback follows.
class Connection : public std::enable_shared_from_this<Connection> {
  public:
    struct Options {
        Hello hello;  // what we say; its limits are filled in from `limits`
        WireLimits limits;
        WireTiming timing;
        std::size_t max_queued_bytes = std::size_t{1} << 30;
    };
    // An error returned by a callback is told to the peer (Failed) and closes the connection with it.
    struct Handlers {
        std::function<Status(const Hello&)> on_hello;
        std::function<Status(Message&&, Buffer&&)> on_message;
        std::function<void(const Status&)> on_closed;  // success after a Bye
        std::function<void()> on_heard{};              // once: the peer has read our Hello. May be missing
    };

    Connection(boost::asio::ip::tcp::socket socket, Options options, const Clock& clock);

    void start(Handlers handlers);

    // Queues a message. The value is the bytes of its prefix and head, so that a caller can count what it
    // sends. Fails when the peer takes too little and the queue is full, or does not accept so much: the
    // caller gives the peer up.
    [[nodiscard]] Result<std::size_t> offer(const Message& message, Buffer body = {});

    // Tells the peer why (Failed), then closes; on_closed follows with the error. The socket itself lives on
    // until the peer has closed its end, silence_limit at most.
    void fail_with(const Error& error);
    // Says Bye, sends what is queued, closes likewise. Without on_closed.
    void finish();
    // At once, without on_closed.
    void close();

    // What the other end has said of itself: what on_hello was called with.
    const Hello& peer_hello() const { return peer_hello_; }
    // "host:port" of the other end.
    const std::string& peer() const { return peer_; }
    // What to add to a time on the peer's clock to get ours, from the quickest Pong so far (error: half of
    // its round trip); zero before the first.
    Nanoseconds clock_offset() const { return clock_offset_; }
    bool has_clock_offset() const { return best_round_trip_ != Nanoseconds::max(); }

  private:
    struct Outgoing {
        std::string head;  // prefix and head
        Buffer body;
    };

    void read_prefix();
    void read_rest(const Prefix& prefix);
    void on_received();
    Status dispatch(Message&& message);
    void write_queued();
    void watch();
    void drain(const boost::system::error_code& error);
    void hang_up();
    void end(const Status& why);
    void notify(const Status& why);
    void shut();

    boost::asio::ip::tcp::socket socket_;
    Options options_;
    const Clock& clock_;
    std::string peer_;
    Handlers handlers_;
    boost::asio::steady_timer watchdog_;

    bool open_ = true;
    bool introduced_ = false;
    Hello peer_hello_;
    WireLimits peer_limits_ = kHelloLimits;
    bool closing_ = false;      // the queue is being flushed; what comes is thrown away
    bool cannot_send_ = false;  // the peer has closed its end; only reading goes on
    bool hung_up_ = false;      // it is flushed
    bool drained_ = false;      // the peer has closed its end too
    Status close_reason_;

    std::array<std::uint8_t, kPrefixBytes> prefix_{};
    std::vector<std::uint8_t> head_;
    Buffer body_;
    std::deque<Outgoing> queue_;
    std::vector<Outgoing> writing_;
    std::size_t queued_bytes_ = 0;
    Nanoseconds last_received_{0};
    Nanoseconds last_sent_{0};
    Nanoseconds clock_offset_{0};
    Nanoseconds best_round_trip_ = Nanoseconds::max();
};

}  // namespace swath
