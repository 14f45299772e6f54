#include "common/program/health.h"

#include <boost/asio/io_context.hpp>
#include <memory>

#include "common/base/clock.h"
#include "common/wire/connection.h"
#include "common/wire/listener.h"

namespace swath {
namespace {

constexpr Nanoseconds kPatience = std::chrono::milliseconds(500);  // to connect, and then for the answer

Address reachable(const Address& listening) {
    if (listening.host == "0.0.0.0") return {"127.0.0.1", listening.port};
    if (listening.host == "::") return {"::1", listening.port};
    return listening;
}

}  // namespace

Status check_health(const Address& listening, Role role) {
    const Address address = reachable(listening);
    const SteadyClock clock;
    boost::asio::io_context io(1);
    Status status = fail("no answer from {}", to_string(address));
    async_connect(io, address, kPatience, [&](Result<boost::asio::ip::tcp::socket> socket) {
        if (!socket) {
            status = tl::unexpected(socket.error());
            return;
        }
        Connection::Options options;
        options.hello.role = Role::kProbe;
        options.timing.silence_limit = kPatience;
        const auto connection = std::make_shared<Connection>(std::move(*socket), options, clock);
        const std::weak_ptr<Connection> weak = connection;
        connection->start({[&, weak](const Hello& hello) -> Status {
                               status = hello.role == role ? Status()
                                                           : fail("{} is a {}, not a {}", to_string(address),
                                                                  name_of(hello.role), name_of(role));
                               weak.lock()->finish();
                               return {};
                           },
                           [](Message&&, Buffer&&) { return Status(); },
                           [&](const Status& why) {
                               if (!why) status = fail("{}: {}", to_string(address), why.error().message);
                           }});
    });
    io.run_for(2 * kPatience);
    return status;
}

}  // namespace swath
