#include "server/session/server.h"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <map>
#include <set>
#include <vector>

#include "common/base/check.h"
#include "common/wire/listener.h"
#include "server/session/model_store.h"
#include "server/session/session.h"

namespace swath {

using boost::asio::ip::tcp;

// Owns the listener, the connections that have not introduced themselves, and the session.
class Server::Impl : public std::enable_shared_from_this<Server::Impl> {
  public:
    Impl(boost::asio::io_context& io, const ServerOptions& options, const Clock& clock, RendererFactory factory)
        : io_(io), options_(options), clock_(clock), factory_(std::move(factory)) {}

    Status listen() {
        auto listener = Listener::make(io_, options_.listen, [weak = weak_from_this()](tcp::socket socket) {
            if (const auto self = weak.lock()) self->on_socket(std::move(socket));
        });
        if (!listener) return tl::unexpected(listener.error());
        listener_ = std::move(*listener);
        return {};
    }
    Address address() const { return listener_->address(); }

    void stop() {
        listener_.reset();
        for (const auto& connection : newcomers_) connection->close();
        newcomers_.clear();
        if (session_) session_->stop();
        session_.reset();
    }

  private:
    void on_socket(tcp::socket socket) {
        Connection::Options options;
        options.hello.role = Role::kServer;
        if (session_) options.hello.session = session_->id();
        if (session_) options.hello.server = session_->server();
        options.timing = options_.timing;
        const auto connection = std::make_shared<Connection>(std::move(socket), options, clock_);
        newcomers_.insert(connection);
        const std::weak_ptr<Connection> weak = connection;
        Connection::Handlers handlers;
        handlers.on_hello = [self = shared_from_this(), weak](const Hello& hello) { return self->on_hello(weak.lock(), hello); };
        handlers.on_message = [self = shared_from_this(), weak](Message&& message, Buffer&& body) {
            return self->on_message(weak.lock(), std::move(message), std::move(body));
        };
        handlers.on_closed = [self = shared_from_this(), weak](const Status& why) { self->on_closed(weak.lock(), why); };
        connection->start(std::move(handlers));
    }

    Status on_hello(const std::shared_ptr<Connection>& connection, const Hello& hello) {
        switch (hello.role) {
            case Role::kClient:
                if (session_) return fail("this server is busy with another client");
                spdlog::info("client {}: connected", connection->peer());
                newcomers_.erase(connection);
                session_ = std::make_shared<ServerSession>(io_, options_, clock_, factory_, connection);
                return {};
            case Role::kServer:
                if (!session_) return fail("this server is in no session");
                newcomers_.erase(connection);
                return session_->on_peer(connection, hello);
            case Role::kDisplay: break;
        }
        return fail("a server takes no connection from a display");
    }

    Status on_message(const std::shared_ptr<Connection>& connection, Message&& message, Buffer&& body) {
        if (!session_) return fail("the session is over");
        return session_->on_message(connection, std::move(message), std::move(body));
    }

    void on_closed(const std::shared_ptr<Connection>& connection, const Status& why) {
        if (newcomers_.erase(connection) > 0) {
            if (!why) spdlog::warn("{}: {}; connection closed", connection->peer(), why.error().message);
            return;
        }
        if (!session_ || !session_->on_closed(connection, why)) return;
        // Let the caller's stack unwind before the session and its connections go.
        boost::asio::post(io_, [session = std::move(session_)] { session->stop(); });
    }

    boost::asio::io_context& io_;
    ServerOptions options_;
    const Clock& clock_;
    RendererFactory factory_;
    std::unique_ptr<Listener> listener_;
    std::set<std::shared_ptr<Connection>> newcomers_;
    std::shared_ptr<ServerSession> session_;
};

Result<std::unique_ptr<Server>> Server::make(boost::asio::io_context& io, const ServerOptions& options, const Clock& clock,
                                             RendererFactory factory) {
    auto impl = std::make_shared<Impl>(io, options, clock, std::move(factory));
    if (const auto status = impl->listen(); !status) return tl::unexpected(status.error());
    return std::unique_ptr<Server>(new Server(std::move(impl)));
}

Server::Server(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() { impl_->stop(); }
Address Server::address() const { return impl_->address(); }

}  // namespace swath
