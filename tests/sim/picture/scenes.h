#pragma once
#include "common/image/pixel_codec.h"
#include "common/plan/frame_plan.h"

namespace swath::sim::test {

inline Picture plain(int width, int height, std::uint8_t grey) {
    Picture picture;
    fill(picture, width, height, {grey, grey, grey});
    return picture;
}

inline Rgb pixel(const Picture& picture, int x, int y) {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                               static_cast<std::size_t>(x));
    return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

// 8 x 8 pixels. The left half is server 0's, the right half server 1's. Server 2 owns nothing and draws in
// the middle. Swaths:
//
//   0 -> 1: [4, 6) x [0, 8)     1 -> 0: [3, 4) x [2, 6)
//   2 -> 0: [2, 4) x [3, 5)     2 -> 1: [4, 6) x [3, 5)
inline FramePlan small_plan() {
    FramePlan plan;
    plan.view.width = 8;
    plan.view.height = 8;
    plan.servers = {{{0, 1}, {{0, 0, 4, 8}}, {0, 0, 6, 8}},
                    {{1, 2}, {{4, 0, 8, 8}}, {3, 2, 8, 6}},
                    {{1, 3}, {}, {2, 3, 6, 5}}};
    return plan;
}

}  // namespace swath::sim::test
