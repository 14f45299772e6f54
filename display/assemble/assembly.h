#pragma once
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/plan/gather.h"

namespace swath {

// An order from Assembly.
struct AssemblyAction {
    enum class Kind {
        kAssemble,  // write the tile from `server` into the frame's picture
        kComplete,  // the picture is complete
    };
    Kind kind{};
    FrameNumber frame = 0;
    ServerId server{};
    bool operator==(const AssemblyAction&) const = default;
};

// Decides what the display does with tiles (Samanta 2000, section 4, phase 3): it assembles them as they
// come, and knows when a picture is complete. Sans-I/O like FrameSwap; the simulator drives the same object.
// Errors blame the sender.
class Assembly {
  public:
    explicit Assembly(std::size_t frames_in_flight) : gather_(frames_in_flight) {}

    using Actions = std::vector<AssemblyAction>;

    Result<Actions> on_task(FrameNumber frame, const std::vector<ServerId>& servers);
    Result<Actions> on_tile(FrameNumber frame, ServerId from);

  private:
    void finish_if_complete(FrameNumber frame, Actions& actions);
    Gather gather_;
};

}  // namespace swath
