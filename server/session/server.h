#pragma once
#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <memory>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/address.h"
#include "common/wire/connection.h"
#include "server/session/draw_thread.h"

namespace swath {

struct ServerOptions {
    Address listen{"127.0.0.1", 0};
    std::filesystem::path cache;                               // of models
    std::uint64_t max_model_bytes = std::uint64_t{8} << 30;    // that a client may send
    Nanoseconds connect_patience = std::chrono::seconds(5);    // with peers and the display
    WireTiming timing;
};

// A render server: waits for a client, sets up with it, and works through its frames until it says Bye; then waits for the
// next. One client at a time; a second one is told so. A lost peer, display or client ends the session, never the server.
// Everything but drawing runs on the io_context's thread, which must outlive it.
class Server {
  public:
    static Result<std::unique_ptr<Server>> make(boost::asio::io_context& io, const ServerOptions& options, const Clock& clock,
                                                RendererFactory factory);
    ~Server();
    Address address() const;

  private:
    class Impl;
    explicit Server(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;
};

}  // namespace swath
