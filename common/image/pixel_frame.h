#pragma once
#include <cstdint>
#include <memory>
#include <utility>

#include "common/base/check.h"
#include "common/base/ids.h"
#include "common/geometry/rect.h"

namespace swath {

// Depth of a pixel that nothing has touched. A drawn pixel is nearer: GL_LESS never lets 1 pass.
inline constexpr float kFarDepth = 1.0f;

// Colour, depth and object id of the pixels of one rectangle, in three planes, rows bottom-up without
// padding. Owned by one thread at a time; movable. A pixel with depth kFarDepth is background: its colour and
// id mean nothing.
class PixelFrame {
  public:
    PixelFrame() = default;
    PixelFrame(PixelFrame&& from) noexcept
        : rect_(std::exchange(from.rect_, {})),
          capacity_(std::exchange(from.capacity_, 0)),
          colour_(std::move(from.colour_)),
          depth_(std::move(from.depth_)),
          id_(std::move(from.id_)) {}
    PixelFrame& operator=(PixelFrame&& from) noexcept {
        rect_ = std::exchange(from.rect_, {});
        capacity_ = std::exchange(from.capacity_, 0);
        colour_ = std::move(from.colour_);
        depth_ = std::move(from.depth_);
        id_ = std::move(from.id_);
        return *this;
    }

    // The planes hold whatever they held: the owner fills them.
    void reshape(const Rect& rect);
    const Rect& rect() const { return rect_; }

    // `n` pixels of a row, from (x, y) of the screen on. All lie in rect(), which is a DCHECK.
    // A colour has R in its low byte, then G, B, A.
    std::uint32_t* colour(int x, int y, int n = 1) { return colour_.get() + offset(x, y, n); }
    float* depth(int x, int y, int n = 1) { return depth_.get() + offset(x, y, n); }
    ObjectId* id(int x, int y, int n = 1) { return id_.get() + offset(x, y, n); }
    const std::uint32_t* colour(int x, int y, int n = 1) const { return colour_.get() + offset(x, y, n); }
    const float* depth(int x, int y, int n = 1) const { return depth_.get() + offset(x, y, n); }
    const ObjectId* id(int x, int y, int n = 1) const { return id_.get() + offset(x, y, n); }

    // Makes the pixels of `rect` background.
    void clear(const Rect& rect);
    // Takes the pixels of `rect` from another frame. CHECKs that both contain it.
    void copy(const PixelFrame& from, const Rect& rect);

  private:
    std::size_t offset(int x, int y, [[maybe_unused]] int n) const {
        DCHECK(rect_.contains({x, y, x + n, y + 1}) == true);
        return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
               static_cast<std::size_t>(x - rect_.x0);
    }

    Rect rect_;
    std::size_t capacity_ = 0;
    std::unique_ptr<std::uint32_t[]> colour_;
    std::unique_ptr<float[]> depth_;
    std::unique_ptr<ObjectId[]> id_;
};

}  // namespace swath
