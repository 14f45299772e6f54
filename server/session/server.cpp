#include "server/session/server.h"

#include "server/session/session.h"

namespace swath {

Result<std::unique_ptr<SessionHost>> make_server(boost::asio::io_context& io, const ServerOptions& options,
                                                 const Clock& clock, RendererFactory factory) {
    return SessionHost::make(
        io, {Role::kServer, options.listen, options.timing}, clock,
        [&io, options, &clock, factory = std::move(factory)](std::shared_ptr<Connection> client) {
            return std::make_shared<ServerSession>(io, options, clock, factory, std::move(client));
        });
}

}  // namespace swath
