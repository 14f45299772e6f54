#include "common/image/pixel_frame.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "tests/common/image/frames.h"

namespace swath {
namespace {

using test::pixel;
using test::Random;
using test::random_frame;

constexpr Rect kRect{3, 2, 11, 7};
// One pixel too many on each side, what lies beside, and all of it and more.
constexpr Rect kNotInside[] = {{2, 2, 11, 7},  {3, 1, 11, 7},    {3, 2, 12, 7}, {3, 2, 11, 8},
                               {11, 2, 12, 3}, {-9, -9, -8, -8}, {0, 0, 64, 64}};

PixelFrame frame_of(const Rect& rect) {
    Random random(1);
    return random_frame(rect, random, 2);
}

TEST(PixelFrame, CopiesARectangleAndLeavesTheRestAlone) {
    const PixelFrame from = frame_of(kRect);
    PixelFrame to;
    to.reshape({0, 0, 16, 16});
    to.clear(to.rect());
    const Rect part{4, 3, 10, 5};
    to.copy(from, part);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(pixel(to, x, y),
                      part.contains({x, y, x + 1, y + 1}) ? pixel(from, x, y) : test::Pixel{});
}

TEST(PixelFrame, CopiesNothingThatOneOfTheTwoDoesNotHold) {
    const PixelFrame small = frame_of(kRect);
    const PixelFrame large = frame_of({-10, -10, 64, 64});
    for (const Rect& rect : kNotInside) {
        PixelFrame to;
        to.reshape(kRect);
        EXPECT_THROW(to.copy(large, rect), CheckFailed) << rect;
        to.reshape(large.rect());
        EXPECT_THROW(to.copy(small, rect), CheckFailed) << rect;
        to.copy(small, {});
        to.copy(small, kRect);
    }
    EXPECT_THROW(PixelFrame().copy(small, kRect), CheckFailed);
}

TEST(PixelFrame, ClearsNoMoreThanItHolds) {
    for (const Rect& rect : kNotInside) {
        PixelFrame frame = frame_of(kRect);
        frame.clear(rect);
        for (int y = kRect.y0; y < kRect.y1; ++y)
            for (int x = kRect.x0; x < kRect.x1; ++x)
                EXPECT_TRUE(!rect.contains({x, y, x + 1, y + 1}) || *frame.depth(x, y) == kFarDepth);
    }
}

#ifdef SWATH_DCHECK
TEST(PixelFrame, HandsOutNoPixelThatItDoesNotHold) {
    PixelFrame frame = frame_of(kRect);
    const PixelFrame& fixed = frame;
    for (const Rect& rect : kNotInside) {
        const int y = kRect.y0 <= rect.y0 ? rect.y1 - 1 : rect.y0;
        EXPECT_THROW(frame.colour(rect.x0, y, rect.width()), CheckFailed) << rect;
        EXPECT_THROW(frame.depth(rect.x0, y, rect.width()), CheckFailed) << rect;
        EXPECT_THROW(frame.id(rect.x0, y, rect.width()), CheckFailed) << rect;
        EXPECT_THROW(fixed.colour(rect.x0, y, rect.width()), CheckFailed) << rect;
        EXPECT_THROW(fixed.depth(rect.x0, y, rect.width()), CheckFailed) << rect;
        EXPECT_THROW(fixed.id(rect.x0, y, rect.width()), CheckFailed) << rect;
    }
    EXPECT_THROW(PixelFrame().depth(0, 0), CheckFailed);
    for (int y = kRect.y0; y < kRect.y1; ++y) EXPECT_EQ(frame.depth(3, y, 8) + 7, frame.depth(10, y));
}
#endif

}  // namespace
}  // namespace swath
