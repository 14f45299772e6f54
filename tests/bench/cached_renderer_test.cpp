#include "tests/bench/cached_renderer.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace swath::bench {
namespace {

// Every pixel has the number of draws so far as its colour, and the first range's object as its id.
class CountingRenderer final : public Renderer {
  public:
    explicit CountingRenderer(std::uint32_t& draws) : draws_(draws) {}
    Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) override {
        if (view.to_light.x == 13) return fail("no light");
        ++draws_;
        id_ = ranges.front().object;
        rect_ = rect;
        return {};
    }
    Status read(const Rect& rect, PixelFrame& frame) override {
        CHECK(rect_.contains(rect) == true);
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                *frame.colour(x, y) = draws_;
                *frame.depth(x, y) = 0.5f;
                *frame.id(x, y) = id_;
            }
        return {};
    }
    std::string description() const override { return "counting"; }

  private:
    std::uint32_t& draws_;
    ObjectId id_ = 0;
    Rect rect_;
};

class CachedRendererTest : public testing::Test {
  protected:
    // Which draw the pixels are from.
    std::uint32_t draw(const View& view, const Rect& rect, ObjectId object = 5) {
        EXPECT_TRUE(renderer_.draw(std::vector{TriangleRange{object, 0, 1}}, view, rect).has_value());
        PixelFrame frame;
        frame.reshape({0, 0, 8, 8});
        EXPECT_TRUE(renderer_.read(rect, frame).has_value());
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                EXPECT_EQ(*frame.colour(x, y), *frame.colour(rect.x0, rect.y0));
                EXPECT_EQ(*frame.id(x, y), object);
            }
        return *frame.colour(rect.x0, rect.y0);
    }
    static View view(float zoom) {
        View made;
        made.clip_from_model[0][0] = zoom;
        return made;
    }

    std::uint32_t draws_ = 0;
    CachedRenderer renderer_{std::make_unique<CountingRenderer>(draws_)};
};

TEST_F(CachedRendererTest, DrawsEachViewOnce) {
    EXPECT_EQ(draw(view(1), {0, 0, 4, 4}), 1u);
    EXPECT_EQ(draw(view(2), {0, 0, 4, 4}), 2u);
    EXPECT_EQ(draw(view(1), {0, 0, 4, 4}), 1u);
    EXPECT_EQ(draw(view(2), {0, 0, 4, 4}), 2u);
    EXPECT_EQ(draws_, 2u);
}

TEST_F(CachedRendererTest, DrawsAViewAgainForAnotherRectangleOrOtherRuns) {
    draw(view(1), {0, 0, 4, 4});
    EXPECT_EQ(draw(view(1), {0, 0, 5, 4}), 2u);  // not what lies beside the first in memory
    EXPECT_EQ(draw(view(1), {1, 1, 3, 3}), 3u);
    EXPECT_EQ(draw(view(1), {1, 1, 3, 3}, 6), 4u);
    EXPECT_EQ(draw(view(1), {1, 1, 3, 3}, 6), 4u);
}

TEST_F(CachedRendererTest, ReadsNothingThatWasNotDrawn) {
    PixelFrame frame;
    frame.reshape({0, 0, 8, 8});
    EXPECT_THROW(static_cast<void>(renderer_.read({0, 0, 1, 1}, frame)), CheckFailed);
    draw(view(1), {0, 0, 4, 4});
    EXPECT_THROW(static_cast<void>(renderer_.read({0, 0, 5, 4}, frame)), CheckFailed);
    // A draw that failed leaves nothing of the one before.
    View dark = view(1);
    dark.to_light.x = 13;
    EXPECT_FALSE(renderer_.draw(std::vector{TriangleRange{5, 0, 1}}, dark, {0, 0, 5, 4}).has_value());
    EXPECT_THROW(static_cast<void>(renderer_.read({0, 0, 4, 4}, frame)), CheckFailed);
}

}  // namespace
}  // namespace swath::bench
