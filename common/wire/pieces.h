#pragma once
#include <map>
#include <utility>

#include "common/base/buffer.h"
#include "common/base/ids.h"
#include "common/image/pixel_codec.h"

namespace swath {

// Pixels that have arrived and await their turn, by frame and sender. Gather decides how many there can be.
struct Piece {
    BodySizes sizes;
    Buffer body;
};
using Pieces = std::map<std::pair<FrameNumber, ServerId>, Piece>;

}  // namespace swath
