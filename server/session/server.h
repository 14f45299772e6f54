#pragma once
#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <memory>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/session_host.h"
#include "server/session/draw_thread.h"

namespace swath {

struct ServerOptions {
    Address listen{"127.0.0.1", 0};
    std::filesystem::path cache;                             // of models
    std::uint64_t max_model_bytes = std::uint64_t{8} << 30;  // the most that a client may send
    std::size_t threads = 1;                                 // cull and cast rays, the drawing one among them
    Nanoseconds connect_patience = std::chrono::seconds(5);  // with peers and the display
    WireTiming timing;
};

// A render server: waits for a client, works through its frames until it says Bye, then waits for the next.
// Everything but drawing runs on the io_context's thread. `clock` and `io` must outlive it.
Result<std::unique_ptr<SessionHost>> make_server(boost::asio::io_context& io, const ServerOptions& options,
                                                 const Clock& clock, RendererFactory factory);

}  // namespace swath
