#include "common/image/pixel_frame.h"

#include <algorithm>
#include <cstring>

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
        float* row = depth(inside.x0, y, inside.width());
        std::fill(row, row + inside.width(), kFarDepth);
    }
}

void PixelFrame::copy(const PixelFrame& from, const Rect& rect) {
    CHECK(rect_.contains(rect) == true);
    CHECK(from.rect_.contains(rect) == true);
    const int n = rect.width();
    const std::size_t bytes = 4 * static_cast<std::size_t>(n);
    for (int y = rect.y0; y < rect.y1 && n > 0; ++y) {
        std::memcpy(colour(rect.x0, y, n), from.colour(rect.x0, y, n), bytes);
        std::memcpy(depth(rect.x0, y, n), from.depth(rect.x0, y, n), bytes);
        std::memcpy(id(rect.x0, y, n), from.id(rect.x0, y, n), bytes);
    }
}

}  // namespace swath
