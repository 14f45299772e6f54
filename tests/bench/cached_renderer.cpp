#include "tests/bench/cached_renderer.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath::bench {

Status CachedRenderer::draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) {
    Drawn& drawn =
        drawn_[{reinterpret_cast<const char*>(&view.clip_from_model), sizeof view.clip_from_model}];
    last_ = &drawn;
    if (drawn.pixels.rect() == rect && std::ranges::equal(drawn.ranges, ranges)) return {};
    drawn.pixels.reshape({});
    SWATH_TRY_VOID(renderer_->draw(ranges, view, rect));
    drawn.ranges.assign(ranges.begin(), ranges.end());
    drawn.pixels.reshape(rect);
    return renderer_->read(rect, drawn.pixels);
}

Status CachedRenderer::read(const Rect& rect, PixelFrame& frame) {
    CHECK(last_ != nullptr);
    frame.copy(last_->pixels, rect);
    return {};
}

}  // namespace swath::bench
