#pragma once
#include <map>
#include <set>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"

namespace swath {

// Keeps count of the pieces that frames await from servers: swaths at a server, tiles at the display. Pieces
// come in any order, even before the frame is opened, because its announcement travels on another connection.
// Decision code: no pixels, no I/O, no clock. Not thread-safe. Errors blame the sender of the event.
class Gather {
  public:
    // At most this many frames may be open, and pieces may come early for at most this many.
    explicit Gather(std::size_t frames_in_flight) : frames_in_flight_(frames_in_flight) {}

    // Announces a frame and the servers that it awaits a piece from. Frame numbers must ascend.
    Status open(FrameNumber frame, const std::vector<ServerId>& incoming);
    // Says that pieces of an open frame can be used from now on. Use those that it returns, which have
    // arrived, ascending.
    std::vector<ServerId> ready(FrameNumber frame);
    // A piece has arrived. True: use it now. False: keep it until ready() names it.
    Result<bool> arrive(FrameNumber frame, ServerId from);
    // Whether the frame is ready and awaits nothing.
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
    FrameNumber next_frame_ = 0;  // a frame below it that is not in frames_ is over
};

}  // namespace swath
