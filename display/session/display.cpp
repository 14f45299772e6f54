#include "display/session/display.h"

#include "display/session/session.h"

namespace swath {

Result<std::unique_ptr<SessionHost>> make_display(boost::asio::io_context& io, const DisplayOptions& options,
                                                  const Clock& clock) {
    return SessionHost::make(io, {Role::kDisplay, options.listen, options.timing}, clock,
                             [&io, &clock, viewers = options.viewers](std::shared_ptr<Connection> client) {
                                 return std::make_shared<DisplaySession>(io, clock, viewers,
                                                                         std::move(client));
                             });
}

}  // namespace swath
