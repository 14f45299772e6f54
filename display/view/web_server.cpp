#include "display/view/web_server.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_prefix.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/websocket.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/base/check.h"
#include "common/base/log.h"
#include "common/wire/listener.h"
#include "display/view/admission.h"
#include "display/web/assets.h"

namespace swath {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

// So many connections beyond the limit are still answered with a refusal; others are closed at once.
constexpr std::size_t kTurnedAway = 32;
// The part of a message that the socket gets at a time. Between parts we see whether the viewer takes any.
constexpr std::size_t kChunkBytes = std::size_t{64} << 10;
// Reads so much at most of a refused request's rest, and ignores it.
constexpr std::size_t kDrainBytes = std::size_t{256} << 10;

// Wraps a member function of an object that must live while the operation is pending. If memory runs out,
// only this connection ends.
template <class T>
auto bound(std::shared_ptr<T> self, void (T::*then)(const error_code&, std::size_t)) {
    return [self = std::move(self), then](const error_code& error, std::size_t bytes = 0) {
        try {
            (self.get()->*then)(error, bytes);
        } catch (const std::exception& failure) {
            log_warning("a viewer's connection: {}; closed", failure.what());
            self->end();
        }
    };
}

std::string page_policy(std::string_view host) {
    // 'self' means the WebSocket too, but not in every browser.
    return fmt::format(
        "default-src 'self'; img-src 'self' blob: data:; style-src 'self'; connect-src 'self' ws://{}; "
        "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        host);
}

const Asset* find_asset(std::string_view path) {
    if (path == "/") path = "/index.html";
    for (const Asset& asset : assets())
        if (asset.path == path) return &asset;
    return nullptr;
}

}  // namespace

class WebServer::Impl {
  public:
    class Http;
    class Live;

    Impl(asio::io_context& io, const WebLimits& limits, Handlers handlers)
        : io_(io), limits_(limits), handlers_(std::move(handlers)) {}

    Status listen(const Address& wanted, const std::optional<Address>& published);
    void on_socket(tcp::socket socket);

    asio::io_context& io_;
    const WebLimits limits_;
    const Handlers handlers_;
    std::optional<Admission> admission_;
    Address address_;
    std::string url_;
    std::unique_ptr<Listener> listener_;
    std::set<std::shared_ptr<Http>> requests_;
    std::map<ViewerId, std::shared_ptr<Live>> lives_;  // including those that close or are not yet open
    ViewerId last_viewer_ = 0;
};

// A connection that speaks HTTP. The server and its pending operations own it.
class WebServer::Impl::Http : public std::enable_shared_from_this<Http> {
  public:
    // A connection that is turned away is answered with 503.
    Http(Impl& server, tcp::socket socket, bool turned_away)
        : server_(server), stream_(std::move(socket)), turned_away_(turned_away) {}

    void read_head();
    void end();

  private:
    struct Answer {
        http::status status = http::status::ok;
        std::string_view content_type = "text/plain; charset=utf-8";
        std::string_view body{};
        std::string fields{};  // more header fields, each with its end of line
    };

    void on_head(const error_code& error, std::size_t);
    void answer();
    void answer_get(const Visitor& visitor);
    void upgrade(const Visitor& visitor);
    void refuse(http::status status, std::string_view why, std::string fields = {});
    void send(const Answer& answer);
    void on_sent(const error_code& error, std::size_t);
    void drain();
    void on_drained(const error_code& error, std::size_t bytes);

    Impl& server_;
    beast::tcp_stream stream_;
    const bool turned_away_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::string head_;  // the answer's
    bool keep_ = false;
    std::array<char, 4096> unread_{};
    std::size_t drained_ = 0;
};

// A connection that has asked for a WebSocket. The server and its pending operations own it.
class WebServer::Impl::Live : public std::enable_shared_from_this<Live> {
  public:
    Live(Impl& server, beast::tcp_stream stream, ViewerId id)
        : server_(server), socket_(std::move(stream)), patience_(server.io_), id_(id) {}

    void accept(const http::request<http::empty_body>& request);
    void send(SharedBytes message, bool text);
    void end();

  private:
    void on_accepted(const error_code& error, std::size_t);
    void read();
    void on_read(const error_code& error, std::size_t);
    void write_chunk();
    void on_chunk(const error_code& error, std::size_t bytes);
    void on_patience(const error_code& stopped, std::size_t);
    void close(websocket::close_code code, const std::string& why);
    void on_closed(const error_code&, std::size_t) { end(); }
    void leave();

    Impl& server_;
    websocket::stream<beast::tcp_stream, false> socket_;  // without compression: pictures have their own
    asio::steady_timer patience_;                         // runs while a chunk is written
    const ViewerId id_;
    bool joined_ = false;
    bool closing_ = false;
    beast::flat_buffer buffer_;
    SharedBytes message_;  // being written
    std::size_t written_ = 0;
};

void WebServer::Impl::Http::read_head() {
    parser_.emplace();
    parser_->header_limit(server_.limits_.head_bytes);
    parser_->body_limit(0);
    buffer_.max_size(std::max<std::size_t>(server_.limits_.head_bytes, buffer_.size()));
    stream_.expires_after(server_.limits_.head_time);
    http::async_read_header(stream_, buffer_, *parser_, bound(shared_from_this(), &Http::on_head));
}

void WebServer::Impl::Http::on_head(const error_code& error, std::size_t) {
    keep_ = false;
    if (error == http::error::header_limit || error == http::error::buffer_overflow)
        return refuse(http::status::request_header_fields_too_large, "a request this long is not taken");
    if (error == http::error::body_limit) return refuse(http::status::payload_too_large, "no bodies");
    if (error == http::error::end_of_stream || error == http::error::partial_message) return end();
    if (error.category() == http::make_error_code(http::error::bad_method).category())
        return refuse(http::status::bad_request, "this is not HTTP");
    if (error) return end();  // it has gone, or time is up
    answer();
}

void WebServer::Impl::Http::answer() {
    if (turned_away_) return refuse(http::status::service_unavailable, "too many connections");
    if (parser_->chunked() || parser_->content_length().value_or(0) > 0)
        return refuse(http::status::payload_too_large, "no bodies");
    const auto& request = parser_->get();
    const auto values = [&](http::field field) {
        std::vector<std::string_view> all;
        const auto [begin, end] = request.equal_range(field);
        for (auto at = begin; at != end; ++at) all.emplace_back(at->value().data(), at->value().size());
        return all;
    };
    const auto view = request.target();
    const Visitor visitor{values(http::field::host), values(http::field::origin), values(http::field::cookie),
                          std::string_view(view.data(), view.size())};
    if (const auto why = server_.admission_->refusal(visitor); !why.empty())
        return refuse(http::status::forbidden, why);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
        return refuse(http::status::method_not_allowed, "only GET and HEAD", "Allow: GET, HEAD\r\n");
    if (visitor.target.substr(0, visitor.target.find('?')) == "/live") return upgrade(visitor);
    answer_get(visitor);
}

void WebServer::Impl::Http::answer_get(const Visitor& visitor) {
    const Asset* asset = find_asset(visitor.target.substr(0, visitor.target.find('?')));
    keep_ = parser_->get().keep_alive();
    if (asset == nullptr) return send({.status = http::status::not_found, .body = "there is no such page\n"});
    Answer answer{.content_type = asset->content_type,
                  .body = {reinterpret_cast<const char*>(asset->bytes.data()), asset->bytes.size()}};
    answer.fields = fmt::format("Content-Security-Policy: {}\r\n", page_policy(visitor.hosts[0]));
    if (const std::string cookie = server_.admission_->cookie(); !cookie.empty())
        answer.fields += fmt::format("Set-Cookie: {}\r\n", cookie);
    send(answer);
}

void WebServer::Impl::Http::upgrade(const Visitor& visitor) {
    // Nothing may follow the head until the upgrade is answered.
    if (!websocket::is_upgrade(parser_->get()) || buffer_.size() > 0)
        return refuse(http::status::upgrade_required, "this is for a WebSocket", "Upgrade: websocket\r\n");
    if (const auto why = Admission::upgrade_refusal(visitor); !why.empty())
        return refuse(http::status::forbidden, why);
    if (server_.lives_.size() >= server_.limits_.viewers)
        return refuse(http::status::service_unavailable, "too many viewers");
    stream_.expires_never();
    const ViewerId id = ++server_.last_viewer_;
    const auto live = std::make_shared<Live>(server_, std::move(stream_), id);
    server_.lives_.emplace(id, live);
    live->accept(parser_->get());
    server_.requests_.erase(shared_from_this());
}

// Says why, and closes: we do not understand or want the rest of the request.
void WebServer::Impl::Http::refuse(http::status status, std::string_view why, std::string fields) {
    keep_ = false;
    const std::string line = fmt::format("{}\n", why);
    send({.status = status, .body = line, .fields = std::move(fields)});
}

void WebServer::Impl::Http::send(const Answer& answer) {
    const auto reason = http::obsolete_reason(answer.status);
    head_ = fmt::format(
        "HTTP/1.1 {} {}\r\n"
        "Content-Type: {}\r\nContent-Length: {}\r\nConnection: {}\r\n"
        "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n"
        "Cross-Origin-Resource-Policy: same-origin\r\n{}\r\n",
        static_cast<unsigned>(answer.status), std::string_view(reason.data(), reason.size()),
        answer.content_type, answer.body.size(), keep_ ? "keep-alive" : "close", answer.fields);
    const bool body = !parser_->is_header_done() || parser_->get().method() != http::verb::head;
    if (body && answer.status != http::status::ok) head_ += answer.body;
    // Pages are part of the program: they are sent from there without a copy.
    const std::string_view page =
        body && answer.status == http::status::ok ? answer.body : std::string_view();
    const std::array<asio::const_buffer, 2> buffers{asio::buffer(head_),
                                                    asio::buffer(page.data(), page.size())};
    stream_.expires_after(server_.limits_.head_time);
    asio::async_write(stream_, buffers, bound(shared_from_this(), &Http::on_sent));
}

void WebServer::Impl::Http::on_sent(const error_code& error, std::size_t) {
    if (error) return end();
    if (keep_) return read_head();
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(server_.limits_.head_time);
    drain();
}

// Reads what is left. To close a socket with unread bytes resets the connection, which can overtake the
// answer.
void WebServer::Impl::Http::drain() {
    stream_.async_read_some(asio::buffer(unread_), bound(shared_from_this(), &Http::on_drained));
}

void WebServer::Impl::Http::on_drained(const error_code& error, std::size_t bytes) {
    drained_ += bytes;
    if (error || drained_ > kDrainBytes) return end();
    drain();
}

void WebServer::Impl::Http::end() {
    stream_.close();
    server_.requests_.erase(shared_from_this());
}

void WebServer::Impl::Live::accept(const http::request<http::empty_body>& request) {
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = server_.limits_.head_time;
    timeout.idle_timeout = server_.limits_.silence;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.read_message_max(server_.limits_.text_bytes);
    socket_.auto_fragment(false);  // because we do it, in larger pieces
    socket_.async_accept(request, bound(shared_from_this(), &Live::on_accepted));
}

void WebServer::Impl::Live::on_accepted(const error_code& error, std::size_t) {
    if (error) return end();
    joined_ = true;
    server_.handlers_.on_join(id_);
    read();
}

void WebServer::Impl::Live::read() { socket_.async_read(buffer_, bound(shared_from_this(), &Live::on_read)); }

void WebServer::Impl::Live::on_read(const error_code& error, std::size_t) {
    if (error) return end();
    if (closing_) return;
    if (!socket_.got_text()) return close(websocket::close_code::unknown_data, "texts only");
    const auto bytes = buffer_.cdata();
    const auto status =
        server_.handlers_.on_text(id_, {static_cast<const char*>(bytes.data()), bytes.size()});
    if (!status) return close(websocket::close_code::policy_error, status.error().message);
    buffer_.consume(buffer_.size());
    read();
}

void WebServer::Impl::Live::send(SharedBytes message, bool text) {
    if (!joined_) return;
    CHECK((message_ == nullptr) == true);
    message_ = std::move(message);
    written_ = 0;
    socket_.text(text);
    write_chunk();
}

void WebServer::Impl::Live::write_chunk() {
    patience_.expires_after(server_.limits_.silence);
    patience_.async_wait(bound(shared_from_this(), &Live::on_patience));
    const std::size_t count = std::min(message_->size() - written_, kChunkBytes);
    socket_.async_write_some(written_ + count == message_->size(),
                             asio::buffer(message_->data() + written_, count),
                             bound(shared_from_this(), &Live::on_chunk));
}

void WebServer::Impl::Live::on_chunk(const error_code& error, std::size_t bytes) {
    patience_.cancel();
    if (error) return end();
    if (closing_) return;
    written_ += bytes;
    if (written_ < message_->size()) return write_chunk();
    message_ = nullptr;
    server_.handlers_.on_written(id_);
}

void WebServer::Impl::Live::on_patience(const error_code& stopped, std::size_t) {
    // The timer may run out just as the chunk is written.
    if (!stopped && patience_.expiry() <= asio::steady_timer::clock_type::now()) end();
}

void WebServer::Impl::Live::close(websocket::close_code code, const std::string& why) {
    closing_ = true;
    leave();
    socket_.async_close({code, why.substr(0, 100)}, bound(shared_from_this(), &Live::on_closed));
}

void WebServer::Impl::Live::leave() {
    if (std::exchange(joined_, false)) server_.handlers_.on_leave(id_);
}

void WebServer::Impl::Live::end() {
    leave();
    patience_.cancel();
    beast::get_lowest_layer(socket_).close();
    server_.lives_.erase(id_);
}

Status WebServer::Impl::listen(const Address& wanted, const std::optional<Address>& published) {
    error_code error;
    tcp::resolver resolver(io_);
    const auto found =
        resolver.resolve(wanted.host, std::to_string(wanted.port), tcp::resolver::passive, error);
    if (error) return fail("cannot listen on {}: {}", to_string(wanted), error.message());
    const asio::ip::address where = found.begin()->endpoint().address();
    SWATH_TRY(listener_, Listener::make(io_, {where.to_string(), wanted.port},
                                        [this](tcp::socket socket) { on_socket(std::move(socket)); }));
    address_ = {wanted.host, listener_->address().port};
    Address shown = published.value_or(address_);
    const asio::ip::address reached = published ? asio::ip::make_address(published->host, error) : where;
    const bool loopback = reached.is_loopback() || shown.host == "localhost";
    admission_.emplace(shown, loopback, loopback ? std::string() : make_token());
    if (reached.is_unspecified() && !loopback && !error) {
        if (published) return fail("{} is no address that a browser could open", to_string(*published));
        shown.host = asio::ip::host_name(error);
    }
    url_ = fmt::format("http://{}/", to_string(shown));
    if (!admission_->token().empty()) url_ += "?token=" + admission_->token();
    return {};
}

void WebServer::Impl::on_socket(tcp::socket socket) {
    const std::size_t connections = requests_.size() + lives_.size();
    if (connections >= limits_.connections + kTurnedAway) return;
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    const auto request = std::make_shared<Http>(*this, std::move(socket), connections >= limits_.connections);
    requests_.insert(request);
    request->read_head();
}

Result<std::unique_ptr<WebServer>> WebServer::make(asio::io_context& io, const Options& options,
                                                   Handlers handlers) {
    auto impl = std::make_unique<Impl>(io, options.limits, std::move(handlers));
    SWATH_TRY_VOID(impl->listen(options.listen, options.published));
    return std::unique_ptr<WebServer>(new WebServer(std::move(impl)));
}

WebServer::WebServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WebServer::~WebServer() = default;

const Address& WebServer::address() const { return impl_->address_; }
const std::string& WebServer::url() const { return impl_->url_; }

void WebServer::send(ViewerId to, SharedBytes message, bool text) {
    const auto found = impl_->lives_.find(to);
    if (found != impl_->lives_.end()) found->second->send(std::move(message), text);
}

}  // namespace swath
