#pragma once
#include <boost/asio/io_context.hpp>
#include <memory>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/session_host.h"
#include "display/view/viewer_host.h"

namespace swath {

struct DisplayOptions {
    Address listen{"127.0.0.1", 0};
    WireTiming timing;
    ViewerHost* viewers = nullptr;  // serves people who look, and outlives the display; null: none
};

// The display: waits for a client, assembles the tiles that servers send into pictures, encodes them if the
// client wants them, and tells it when each is complete. Encoding runs on a thread of its own, viewers on
// those of `viewers`, all else on the io_context's.
Result<std::unique_ptr<SessionHost>> make_display(boost::asio::io_context& io, const DisplayOptions& options,
                                                  const Clock& clock);

}  // namespace swath
