#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "common/image/pixel_codec.h"

// Sizes of pixels, spans and ids, a byte each, then the body of a swath and of a tile: either an error of one
// line, or pixels that are composited; no pixel outside of the region may be touched.
namespace {

constexpr swath::Rect kScreen{0, 0, 16, 8};
const swath::Region kRegion{{1, 1, 9, 4}, {10, 0, 13, 6}};

bool inside(int x, int y) {
    return std::any_of(kRegion.begin(), kRegion.end(), [&](const swath::Rect& r) {
        return r.contains({x, y, x + 1, y + 1});
    });
}

void check(const swath::Status& status) {
    if (!status && (status.error().message.empty() || status.error().message.find('\n') != std::string::npos))
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swath;
    if (size < 3) return 0;
    const BodySizes sizes{data[0], data[1], data[2]};
    Buffer body;  // aligned like a received body
    body.append(data + 3, size - 3);

    PixelFrame frame;
    frame.reshape(kScreen);
    frame.clear(kScreen);
    constexpr ObjectId kLimit = 300;
    check(composite_swath(body.bytes(), sizes, kRegion, kLimit, frame));
    Picture picture;
    fill(picture, kScreen.x1, kScreen.y1, {1, 2, 3});
    check(assemble_tile(body.bytes(), sizes, kRegion, picture));
    for (int y = 0; y < kScreen.y1; ++y)
        for (int x = 0; x < kScreen.x1; ++x) {
            const float depth = *frame.depth(x, y);
            if (!(depth >= 0 && depth <= kFarDepth)) std::abort();
            if (inside(x, y)) {
                if (depth < kFarDepth && *frame.id(x, y) >= kLimit) std::abort();
                continue;
            }
            const std::size_t at = 3 * static_cast<std::size_t>(kScreen.x1 * y + x);
            if (depth != kFarDepth || picture.rgb[at] != 1 || picture.rgb[at + 2] != 3) std::abort();
        }
    return 0;
}
