#include "tests/support/web_client.h"

#include <fmt/core.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <functional>

namespace swath::test {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

// The concrete executor: clang-tidy's analyzer takes that of any_io_executor for a null pointer.
using Stream = beast::basic_stream<tcp, asio::io_context::executor_type>;

// Runs the loop until `done`; false if the time is up before.
bool run_until(asio::io_context& io, std::chrono::milliseconds limit, const std::function<bool()>& done) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (!done()) {
        io.restart();
        if (io.run_one_until(deadline) == 0 && std::chrono::steady_clock::now() >= deadline) return done();
    }
    return true;
}

tcp::endpoint endpoint_of(const Address& address) {
    return {asio::ip::make_address(address.host), address.port};
}

}  // namespace

HttpAnswer http_exchange(const Address& address, std::string_view request) {
    asio::io_context io(1);
    Stream stream(io);
    stream.expires_after(kWebPatience);
    error_code failed;
    stream.socket().connect(endpoint_of(address), failed);
    std::string all;
    asio::async_write(stream, asio::buffer(request.data(), request.size()),
                      [](const error_code&, std::size_t) {});
    // Reads until the stream ends, even if the request could not be sent.
    asio::async_read(stream, asio::dynamic_buffer(all), [](const error_code&, std::size_t) {});
    io.run();

    HttpAnswer answer;
    const std::size_t end = all.find("\r\n\r\n");
    if (!all.starts_with("HTTP/1.1 ") || end == std::string::npos) return answer;
    std::from_chars(all.data() + 9, all.data() + 12, answer.status);
    answer.head = all.substr(0, end + 2);
    answer.body = all.substr(end + 4);
    return answer;
}

HttpAnswer http_get(const Address& address, const std::string& target, const std::string& fields) {
    return http_exchange(address, fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n{}Connection: close\r\n\r\n",
                                              target, to_string(address), fields));
}

struct WebClient::Impl {
    asio::io_context io{1};
    websocket::stream<Stream, false> socket{io};
    beast::flat_buffer buffer;
    bool reading = false;
    bool came = false;
    std::optional<int> closed;
};

Result<std::unique_ptr<WebClient>> WebClient::connect(const Address& address, const std::string& token) {
    Options options;
    options.token = token;
    return connect(address, options);
}

Result<std::unique_ptr<WebClient>> WebClient::connect(const Address& address, const Options& options) {
    auto impl = std::make_unique<Impl>();
    auto& socket = impl->socket;
    auto& tcp_socket = beast::get_lowest_layer(socket).socket();
    error_code error;
    tcp_socket.open(endpoint_of(address).protocol(), error);
    if (options.receive_buffer_bytes > 0)
        tcp_socket.set_option(tcp::socket::receive_buffer_size(options.receive_buffer_bytes), error);
    tcp_socket.connect(endpoint_of(address), error);
    if (error) return fail("{}", error.message());
    tcp_socket.set_option(tcp::no_delay(true), error);

    const std::string host = options.host.empty() ? to_string(address) : options.host;
    socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
        if (options.origin != "none")
            request.set(beast::http::field::origin,
                        options.origin.empty() ? "http://" + host : options.origin);
        if (!options.cookie.empty()) request.set(beast::http::field::cookie, options.cookie);
    }));
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = kWebPatience;
    timeout.idle_timeout = websocket::stream_base::none();
    timeout.keep_alive_pings = false;
    socket.set_option(timeout);
    socket.read_message_max(std::size_t{1} << 30);
    websocket::response_type response;
    std::optional<error_code> done;
    socket.async_handshake(response, host, options.token.empty() ? "/live" : "/live?token=" + options.token,
                           [&](const error_code& result) { done = result; });
    if (!run_until(impl->io, kWebPatience, [&] { return done.has_value(); })) return fail("no answer");
    if (*done == websocket::error::upgrade_declined)
        return fail("{} {}", response.result_int(), response.body());
    if (*done) return fail("{}", done->message());
    return std::unique_ptr<WebClient>(new WebClient(std::move(impl)));
}

WebClient::WebClient(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WebClient::~WebClient() = default;

bool WebClient::send(std::string_view message, bool text) {
    std::optional<error_code> done;
    impl_->socket.text(text);
    impl_->socket.async_write(asio::buffer(message.data(), message.size()),
                              [&](const error_code& error, std::size_t) { done = error; });
    if (!run_until(impl_->io, kWebPatience, [&] { return done.has_value(); })) {
        close();
        run_until(impl_->io, kWebPatience, [&] { return done.has_value(); });
        return false;
    }
    return !*done;
}

std::optional<WebMessage> WebClient::next(std::chrono::milliseconds limit) {
    Impl& impl = *impl_;
    if (impl.closed) return std::nullopt;
    // A pending read goes on from call to call.
    if (!std::exchange(impl.reading, true)) {
        impl.came = false;
        impl.socket.async_read(impl.buffer, [&impl](const error_code& error, std::size_t) {
            impl.came = true;
            if (!error) return;
            const auto code = error == websocket::error::closed ? impl.socket.reason().code : 1006;
            impl.closed = static_cast<int>(code);
        });
    }
    if (!run_until(impl.io, limit, [&] { return impl.came; })) return std::nullopt;
    impl.reading = false;
    if (impl.closed) return std::nullopt;
    const auto bytes = impl.buffer.cdata();
    WebMessage message{impl.socket.got_text(),
                       std::string(static_cast<const char*>(bytes.data()), bytes.size())};
    impl.buffer.consume(impl.buffer.size());
    return message;
}

std::optional<int> WebClient::close_code() const { return impl_->closed; }

void WebClient::close() {
    beast::get_lowest_layer(impl_->socket).close();
    if (!impl_->closed) impl_->closed = 1006;
}

}  // namespace swath::test
