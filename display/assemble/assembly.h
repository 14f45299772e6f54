#pragma once
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/plan/gather.h"

namespace swath {

// What Assembly wants done.
struct AssemblyAction {
    enum class Kind {
        kMerge,     // the tile that came from `server` into the frame's picture
        kComplete,  // the picture is whole
    };
    Kind kind{};
    FrameNumber frame = 0;
    ServerId server{};
    bool operator==(const AssemblyAction&) const = default;
};

// Decides what the display does with tiles (Samanta 2000, section 4, phase 3): merges them as they come and
// knows when a picture is whole. Sans-I/O like FrameSwap; the simulator drives the same object.
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
