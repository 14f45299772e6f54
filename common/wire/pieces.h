#pragma once
#include <map>
#include <utility>

#include "common/base/buffer.h"
#include "common/base/check.h"
#include "common/base/ids.h"
#include "common/image/pixel_codec.h"

namespace swath {

// Pixels of one server for one frame, as they came.
struct Piece {
    BodySizes sizes;
    Buffer body;
};

// Pieces that have come before they can be used. Gather decides how many there can be.
class Pieces {
  public:
    void keep(FrameNumber frame, ServerId from, Piece piece) {
        pieces_.emplace(std::pair(frame, from), std::move(piece));
    }
    // That was kept.
    Piece take(FrameNumber frame, ServerId from) {
        auto piece = pieces_.extract({frame, from});
        CHECK(piece.empty() == false);
        return std::move(piece.mapped());
    }

  private:
    std::map<std::pair<FrameNumber, ServerId>, Piece> pieces_;
};

}  // namespace swath
