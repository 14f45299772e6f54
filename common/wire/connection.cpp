#include "common/wire/connection.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <new>
#include <utility>

#include "common/wire/address.h"

namespace swath {
namespace asio = boost::asio;
namespace {

// Asio's own completion conditions move at most 64 KiB a system call.
constexpr std::size_t kTransferBytes = std::size_t{1} << 30;

std::string describe(const asio::ip::tcp::socket& socket) {
    boost::system::error_code error;
    const auto end = socket.remote_endpoint(error);
    if (error) return "a peer that has gone";
    return to_string(Address{end.address().to_string(), end.port()});
}

double seconds(Nanoseconds t) { return std::chrono::duration<double>(t).count(); }

}  // namespace

Connection::Connection(asio::ip::tcp::socket socket, Options options, const Clock& clock)
    : socket_(std::move(socket)),
      options_(options),
      clock_(clock),
      peer_(describe(socket_)),
      watchdog_(socket_.get_executor()) {
    options_.hello.max_head_bytes = options_.limits.max_head_bytes;
    options_.hello.max_body_bytes = options_.limits.max_body_bytes;
}

void Connection::start(Handlers handlers) {
    handlers_ = std::move(handlers);
    boost::system::error_code ignored;
    socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
    last_received_ = last_sent_ = clock_.now();
    if (!offer(options_.hello) || !offer(Ping{clock_.now()})) return;
    read_prefix();
    watch();
}

Result<std::size_t> Connection::offer(const Message& message, Buffer body) {
    if (!open_ || closing_) return 0;  // the close is already on its way to the caller
    const std::string head = encode_head(message);
    if (head.size() > peer_limits_.max_head_bytes || body.size() > peer_limits_.max_body_bytes)
        return fail("a {} of {} and {} bytes, its limits are {} and {}", name(message), head.size(),
                    body.size(), peer_limits_.max_head_bytes, peer_limits_.max_body_bytes);
    if (queued_bytes_ + head.size() + body.size() > options_.max_queued_bytes)
        return fail("does not read: its send queue is full");
    const auto prefix =
        encode_prefix({static_cast<std::uint32_t>(head.size()), static_cast<std::uint32_t>(body.size())});
    Outgoing out;
    out.head.reserve(prefix.size() + head.size());
    out.head.append(reinterpret_cast<const char*>(prefix.data()), prefix.size());
    out.head.append(head);
    out.body = std::move(body);
    queued_bytes_ += out.head.size() + out.body.size();
    const std::size_t head_bytes = out.head.size();
    queue_.push_back(std::move(out));
    if (writing_.empty()) write_queued();
    return head_bytes;
}

void Connection::write_queued() {
    writing_.assign(std::make_move_iterator(queue_.begin()), std::make_move_iterator(queue_.end()));
    queue_.clear();
    std::vector<asio::const_buffer> buffers;
    buffers.reserve(2 * writing_.size());
    for (const Outgoing& out : writing_) {
        buffers.emplace_back(out.head.data(), out.head.size());
        if (!out.body.empty()) buffers.emplace_back(out.body.data(), out.body.size());
    }
    last_sent_ = clock_.now();
    const auto all = [](const boost::system::error_code& error, std::size_t) {
        return error ? 0 : kTransferBytes;
    };
    asio::async_write(socket_, buffers, all,
                      [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
                          if (!self->open_) return;
                          if (error) {
                              // Its end is closed. What it said last may still lie unread, and says why.
                              self->cannot_send_ = true;
                              if (self->closing_) self->end(self->close_reason_);
                              return;
                          }
                          for (const Outgoing& out : self->writing_)
                              self->queued_bytes_ -= out.head.size() + out.body.size();
                          self->writing_.clear();
                          if (!self->queue_.empty()) {
                              self->write_queued();
                          } else if (self->closing_) {
                              self->hang_up();
                          }
                      });
}

void Connection::read_prefix() {
    asio::async_read(socket_, asio::buffer(prefix_),
                     [self = shared_from_this()](const boost::system::error_code& error, std::size_t got) {
                         if (!self->open_) return;
                         if (self->closing_) return self->drain(error);
                         if (error == asio::error::eof) {
                             self->end(fail("{}", got == 0 ? "closed the connection"
                                                           : "closed the connection within a message"));
                             return;
                         }
                         if (error) return self->end(fail("{}", error.message()));
                         self->last_received_ = self->clock_.now();
                         const auto prefix = decode_prefix(
                             self->prefix_, self->introduced_ ? self->options_.limits : kHelloLimits);
                         if (prefix) return self->read_rest(*prefix);
                         self->fail_with(prefix.error());
                         if (self->open_) self->drain({});
                     });
}

void Connection::read_rest(const Prefix& prefix) {
    try {
        head_.resize(prefix.head_bytes);
        body_ = Buffer(prefix.body_bytes);
    } catch (const std::bad_alloc&) {
        fail_with({fmt::format("a message of {} bytes: not enough memory for it", prefix.body_bytes)});
        if (open_) drain({});
        return;
    }
    const std::array<asio::mutable_buffer, 2> buffers{asio::buffer(head_),
                                                      asio::buffer(body_.data(), body_.size())};
    // The condition sees every piece that arrives: a large body on a slow link is not silence.
    const auto all = [self = shared_from_this(), before = std::size_t{0}](
                         const boost::system::error_code& error, std::size_t got) mutable {
        if (got > before) self->last_received_ = self->clock_.now();
        before = got;
        return error ? 0 : kTransferBytes;
    };
    asio::async_read(socket_, buffers, all,
                     [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
                         if (!self->open_) return;
                         if (self->closing_) return self->drain(error);
                         if (error == asio::error::eof)
                             return self->end(fail("closed the connection within a message"));
                         if (error) return self->end(fail("{}", error.message()));
                         self->on_received();
                     });
}

void Connection::on_received() {
    // What a peer asks for may be within the limits and still too much for this machine: that ends the peer,
    // not us.
    Status status;
    try {
        auto message = decode_head(head_);
        status = message ? dispatch(std::move(*message)) : tl::unexpected(message.error());
    } catch (const std::bad_alloc&) {
        status = fail("not enough memory for what it asks");
    }
    if (!status) fail_with(status.error());
    if (!open_) return;
    if (closing_) return drain({});
    read_prefix();
}

Status Connection::dispatch(Message&& message) {
    if (!introduced_) {
        const auto* hello = std::get_if<Hello>(&message);
        if (hello == nullptr) return fail("sent {} before Hello", name(message));
        introduced_ = true;
        peer_hello_ = *hello;
        peer_limits_ = {hello->max_head_bytes, hello->max_body_bytes};
        return handlers_.on_hello(*hello);
    }
    if (std::holds_alternative<Hello>(message)) return fail("sent Hello twice");
    if (const auto* ping = std::get_if<Ping>(&message)) {
        const auto sent = offer(Pong{ping->sent, clock_.now()});
        return sent ? Status{} : tl::unexpected(sent.error());
    }
    if (const auto* pong = std::get_if<Pong>(&message)) {
        const Nanoseconds now = clock_.now();
        const Nanoseconds round_trip = now - pong->sent;
        if (round_trip >= Nanoseconds(0) && round_trip < best_round_trip_) {
            best_round_trip_ = round_trip;
            clock_offset_ = pong->sent + round_trip / 2 - pong->peer;
        }
        // It answers our first Ping, which came right after our Hello.
        if (const auto on_heard = std::exchange(handlers_.on_heard, nullptr)) on_heard();
        return {};
    }
    if (const auto* failed = std::get_if<Failed>(&message)) {
        end(fail("{}", failed->what));
        return {};
    }
    if (std::holds_alternative<Bye>(message)) {
        end({});
        return {};
    }
    return handlers_.on_message(std::move(message), std::move(body_));
}

void Connection::watch() {
    watchdog_.expires_after(options_.timing.heartbeat / 2);
    watchdog_.async_wait([self = shared_from_this()](const boost::system::error_code& error) {
        if (error || !self->open_) return;
        const Nanoseconds now = self->clock_.now();
        if (now - self->last_received_ > self->options_.timing.silence_limit) {
            self->end(self->closing_ ? self->close_reason_
                                     : fail("silent for {:.1f} s", seconds(now - self->last_received_)));
            return;
        }
        if (now - self->last_sent_ >= self->options_.timing.heartbeat)
            if (const auto sent = self->offer(Ping{now}); !sent)
                return self->end(tl::unexpected(sent.error()));
        self->watch();
    });
}

// Reads on, to no end but the peer's: closing a socket with unread bytes resets the connection, and a reset
// can overtake the last words that we have just sent. `error` is that of the read before.
void Connection::drain(const boost::system::error_code& error) {
    if (error) {
        drained_ = true;
        if (hung_up_) shut();
        return;
    }
    head_.resize(std::size_t{64} << 10);
    socket_.async_read_some(asio::buffer(head_),
                            [self = shared_from_this()](const boost::system::error_code& next, std::size_t) {
                                if (self->open_) self->drain(next);
                            });
}

// Everything is sent: nothing more to say. The socket is closed when the peer has closed its end, or after
// the silence limit.
void Connection::hang_up() {
    hung_up_ = true;
    boost::system::error_code ignored;
    socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    notify(close_reason_);
    if (drained_) shut();
}

void Connection::fail_with(const Error& error) {
    if (!open_ || closing_) return;
    close_reason_ = tl::unexpected(error);
    if (cannot_send_ || !offer(Failed{error.message})) return end(close_reason_);
    closing_ = true;
}

void Connection::finish() {
    if (!open_ || closing_) return;
    handlers_.on_closed = nullptr;
    if (cannot_send_ || !offer(Bye{})) return close();
    closing_ = true;
}

void Connection::close() {
    if (!open_) return;
    shut();
    handlers_.on_closed = nullptr;
    notify({});
}

void Connection::end(const Status& why) {
    if (!open_) return;
    shut();
    notify(why);
}

void Connection::notify(const Status& why) {
    const auto on_closed = std::exchange(handlers_.on_closed, nullptr);
    // A callback may be running and own what it captures: let it go only when it has returned.
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->handlers_ = {}; });
    if (on_closed) on_closed(why);
}

void Connection::shut() {
    if (!open_) return;
    open_ = false;
    watchdog_.cancel();
    boost::system::error_code ignored;
    socket_.shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
}

}  // namespace swath
