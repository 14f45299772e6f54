#include "common/wire/session_host.h"

#include <boost/asio/post.hpp>

#include "common/base/log.h"

namespace swath {

using boost::asio::ip::tcp;

Result<std::unique_ptr<SessionHost>> SessionHost::make(boost::asio::io_context& io, const Options& options,
                                                       const Clock& clock, MakeSession make_session) {
    std::unique_ptr<SessionHost> host(new SessionHost(io, options, clock, std::move(make_session)));
    auto listener = Listener::make(
        io, options.listen, [raw = host.get()](tcp::socket socket) { raw->on_socket(std::move(socket)); });
    if (!listener) return tl::unexpected(listener.error());
    host->listener_ = std::move(*listener);
    return host;
}

SessionHost::SessionHost(boost::asio::io_context& io, const Options& options, const Clock& clock,
                         MakeSession make_session)
    : io_(io), options_(options), clock_(clock), make_session_(std::move(make_session)) {}

SessionHost::~SessionHost() {
    for (const auto& connection : newcomers_) connection->close();
    if (session_) session_->stop();
}

void SessionHost::leave(std::function<void()> done) {
    leaving_ = true;
    if (!session_) return done();
    on_left_ = std::move(done);
    session_->leave();
}

void SessionHost::on_socket(tcp::socket socket) {
    Connection::Options options;
    options.hello.role = options_.role;
    if (session_) {
        options.hello.session = session_->id();
        options.hello.server = session_->server();
    }
    options.timing = options_.timing;
    const auto connection = std::make_shared<Connection>(std::move(socket), options, clock_);
    newcomers_.insert(connection);
    const std::weak_ptr<Connection> weak = connection;
    const std::weak_ptr<char> alive = alive_;
    connection->start({[this, alive, weak](const Hello& hello) {
                           return alive.expired() ? Status(fail("shutting down"))
                                                  : on_hello(weak.lock(), hello);
                       },
                       [this, alive, weak](Message&& message, Buffer&& body) -> Status {
                           if (alive.expired() || !session_) return fail("the session is over");
                           return session_->on_message(weak.lock(), std::move(message), std::move(body));
                       },
                       [this, alive, weak](const Status& why) {
                           if (!alive.expired()) on_closed(weak.lock(), why);
                       }});
}

Status SessionHost::on_hello(const std::shared_ptr<Connection>& connection, const Hello& hello) {
    switch (hello.role) {
        case Role::kClient:
            if (leaving_) return fail("this {} is being stopped", name_of(options_.role));
            if (session_) return fail("this {} is busy with another client", name_of(options_.role));
            log_info("client {}: connected", connection->peer());
            newcomers_.erase(connection);
            session_ = make_session_(connection);
            return {};
        case Role::kServer: {
            if (!session_) return fail("this {} is in no session", name_of(options_.role));
            const auto status = session_->on_peer(connection, hello);
            if (status) newcomers_.erase(connection);
            return status;
        }
        case Role::kProbe:
            return {};
        case Role::kDisplay:
            break;
    }
    return fail("a {} takes no connection from a display", name_of(options_.role));
}

void SessionHost::on_closed(const std::shared_ptr<Connection>& connection, const Status& why) {
    if (newcomers_.erase(connection) > 0) {
        if (!why) log_warning("{}: {}; connection closed", connection->peer(), why.error().message);
        return;
    }
    if (!session_ || !session_->on_closed(connection, why)) return;
    if (why)
        log_info("client {}: done", connection->peer());
    else
        log_warning("client {}: {}; waiting for the next client", connection->peer(), why.error().message);
    // Let the caller's stack unwind before the session and its connections go.
    boost::asio::post(io_, [session = std::move(session_), on_left = std::move(on_left_)] {
        session->stop();
        if (on_left) on_left();
    });
}

}  // namespace swath
