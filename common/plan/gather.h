#pragma once
#include <map>
#include <set>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"

namespace swath {

// Keeps count of the pieces that numbered frames await from servers: a server's swaths, the display's tiles.
// Pieces come in any order, also before the frame itself is announced here, since its announcement travels on
// another connection. Decision code: no pixels, no I/O, no clock. Not thread-safe. Errors blame the sender of
// the event.
class Gather {
  public:
    // Pieces may arrive for at most this many frames that have not been opened.
    explicit Gather(std::size_t frames_in_flight) : frames_in_flight_(frames_in_flight) {}

    // Frame numbers ascend from call to call.
    Status open(FrameNumber frame, const std::vector<ServerId>& incoming);
    // From now on pieces of the (open) frame can be used; those that have arrived, ascending, are to be used
    // now.
    std::vector<ServerId> ready(FrameNumber frame);
    // True: use the piece now. False: keep it until ready() or open() names it.
    Result<bool> arrive(FrameNumber frame, ServerId from);
    // Ready, and nothing is awaited.
    bool complete(FrameNumber frame) const;
    void close(FrameNumber frame) { frames_.erase(frame); }

    std::size_t size() const { return frames_.size(); }

  private:
    struct Frame {
        bool open = false;
        bool ready = false;
        std::set<ServerId> awaited;
        std::set<ServerId> waiting;  // arrived before ready
    };
    std::size_t frames_in_flight_;
    std::map<FrameNumber, Frame> frames_;
    FrameNumber next_frame_ = 0;  // frames below it that are not in frames_ are over
};

}  // namespace swath
