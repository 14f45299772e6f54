#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/plan/gather.h"

namespace swath {

// A server's task as FrameSwap sees it: the servers that it sends pixels to, those that it awaits pixels
// from, and whether the display awaits a tile.
struct SwapTask {
    FrameNumber frame = 0;
    std::vector<ServerId> outgoing;
    std::vector<ServerId> incoming;
    bool has_tile = false;
};

// An order from FrameSwap.
struct SwapAction {
    enum class Kind {
        kDraw,       // cull, draw and read back; then on_drawn
        kSendSwath,  // to `peer`
        kComposite,  // the swath from `peer`
        kSendTile,   // to the display
        kFinished,   // the server's work for the frame is over: report it
    };
    Kind kind{};
    FrameNumber frame = 0;
    ServerId peer{};
    bool operator==(const SwapAction&) const = default;
};

// Decides what a server does for its frames (Samanta 2000, section 4, phases 2 and 3; it composites in host
// memory): swaths go out as soon as the frame is drawn, peers' swaths are composited as they come, in any
// order, and the tile goes out after the last. Sans-I/O: events in, actions out, in the order to do them; the
// server drives it from its sockets and the simulator from its event queue. Several frames may be open at
// once. Not thread-safe.
class FrameSwap {
  public:
    explicit FrameSwap(std::size_t frames_in_flight) : gather_(frames_in_flight) {}

    using Actions = std::vector<SwapAction>;

    // Frame numbers ascend from task to task. Errors are the sender's: they end its connection.
    Result<Actions> on_task(const SwapTask& task);
    // The frame's own pixels are in host memory.
    Actions on_drawn(FrameNumber frame);
    Result<Actions> on_swath(FrameNumber frame, ServerId from);

  private:
    struct Task {
        std::vector<ServerId> outgoing;
        bool has_tile = false;
    };
    void finish_if_complete(FrameNumber frame, Actions& actions);

    Gather gather_;
    std::map<FrameNumber, Task> tasks_;
};

}  // namespace swath
