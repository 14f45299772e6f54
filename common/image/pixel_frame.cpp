#include "common/image/pixel_frame.h"

#include <algorithm>

namespace swath {

void PixelFrame::reshape(const Rect& rect) {
    rect_ = rect.empty() ? Rect{} : rect;
    const auto pixels = static_cast<std::size_t>(rect_.area());
    if (pixels <= capacity_) return;
    colour_ = std::make_unique_for_overwrite<std::uint32_t[]>(pixels);
    depth_ = std::make_unique_for_overwrite<float[]>(pixels);
    id_ = std::make_unique_for_overwrite<ObjectId[]>(pixels);
    capacity_ = pixels;
}

void PixelFrame::clear(const Rect& rect) {
    const Rect inside = intersect(rect, rect_);
    for (int y = inside.y0; y < inside.y1; ++y) {
        float* row = depth(inside.x0, y);
        std::fill(row, row + inside.width(), kFarDepth);
    }
}

}  // namespace swath
