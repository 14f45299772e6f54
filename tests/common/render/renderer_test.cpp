#include "common/render/gl_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <thread>

#include "common/base/check.h"
#include "common/image/pixel_codec.h"
#include "common/scene/procedural.h"
#include "tests/support/drawings.h"

// This makes a cluster's picture exact: a pixel depends only on the objects and the view, not on who draws
// it, which other pixels are drawn with it or what was drawn before.

namespace swath {
namespace {

using test::all_of;
using test::compare;
using test::Difference;
using test::draw;
using test::expect_same;
using test::gl_here;
using test::view_of;
using testing::HasSubstr;

constexpr int kWidth = 97;
constexpr int kHeight = 61;

std::unique_ptr<Renderer> make(const ObjectSet& scene, RendererKind kind = gl_here()) {
    auto renderer = make_gl_renderer(kind, scene);
    EXPECT_TRUE(renderer.has_value()) << renderer.error().message;
    return renderer ? std::move(*renderer) : nullptr;
}

// Draws on a thread of its own, as if on another machine: a renderer is bound to its thread and alone there.
PixelFrame draw_elsewhere(const ObjectSet& scene, std::span<const TriangleRange> ranges, const View& view,
                          RendererKind kind = gl_here()) {
    PixelFrame frame;
    std::thread([&] {
        if (const auto renderer = make(scene, kind)) frame = draw(*renderer, ranges, view, view.viewport());
    }).join();
    return frame;
}

class RendererTest : public testing::Test {
  protected:
    explicit RendererTest(const char* model = "knot") : scene_(test::builtin_scene(model, 6000)) {}
    const ObjectSet scene_;
    const std::vector<TriangleRange> all_ = all_of(scene_);
    const View view_ = view_of(scene_);
    std::unique_ptr<Renderer> renderer_ = make(scene_);
};

TEST_F(RendererTest, DrawsObjectsOverBackground) {
    const PixelFrame frame = draw(*renderer_, all_, view_, view_.viewport());
    std::set<ObjectId> seen;
    int background = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float depth = *frame.depth(x, y);
            ASSERT_GE(depth, 0);
            ASSERT_LE(depth, kFarDepth);
            if (depth == kFarDepth) {
                ++background;
                continue;
            }
            ASSERT_LT(*frame.id(x, y), scene_.objects.size());
            ASSERT_EQ(*frame.colour(x, y) >> 24, 255u);
            seen.insert(*frame.id(x, y));
        }
    EXPECT_GT(background, kWidth);
    EXPECT_GT(seen.size(), 10u);
    EXPECT_THAT(renderer_->description(), HasSubstr("llvmpipe"));
}

// Parts that fly apart, and one that stays.
ObjectSet moving_scene() {
    Mesh mesh = *make_builtin("spheres", 6000);
    mesh.motion.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (i > 100) mesh.motion[i] = 0.37f * (mesh.vertices[i].position - glm::vec3(3, 2, 5));
    return build_objects(std::move(mesh), {3, 0});
}

// Vertices move as in posed(), to the last bit.
TEST(MovingRenderer, DrawsAPoseAsIfTheModelWereMadeInIt) {
    const ObjectSet moving = moving_scene();
    const std::vector<TriangleRange> all = all_of(moving);
    for (const RendererKind kind : {gl_here(), RendererKind::kEgl})
        for (const float pose : {0.0f, 0.1f, 1.0f / 3, 0.7f, 1.0f}) {
            ObjectSet still = moving;
            still.mesh.motion.clear();
            still.end_bounds = {};
            for (std::uint32_t i = 0; i < still.mesh.vertices.size(); ++i)
                still.mesh.vertices[i].position = posed(moving.mesh, i, pose);
            View view = view_of(moving);
            view.pose = pose;
            expect_same(draw_elsewhere(moving, all, view, kind), draw_elsewhere(still, all, view, kind),
                        view.viewport());
        }
}

TEST(MovingRenderer, DrawsPosesOneAfterTheOther) {
    const ObjectSet moving = moving_scene();
    const std::vector<TriangleRange> all = all_of(moving);
    const auto renderer = make(moving);
    View view = view_of(moving);
    const PixelFrame first = draw(*renderer, all, view, view.viewport());
    view.pose = 0.5f;
    const PixelFrame second = draw(*renderer, all, view, view.viewport());
    EXPECT_GT(compare(first, second, view.viewport()).pixels, 100);
    view.pose = 0;
    expect_same(first, draw(*renderer, all, view, view.viewport()), view.viewport());
}

TEST_F(RendererTest, IsTheSameWithOsmesaAndEgl) {
    if (gl_here() != RendererKind::kOsmesa) GTEST_SKIP() << "no OSMesa here";
    const PixelFrame egl = draw_elsewhere(scene_, all_, view_, RendererKind::kEgl);
    ASSERT_EQ(egl.rect(), view_.viewport());
    expect_same(draw(*renderer_, all_, view_, view_.viewport()), egl, view_.viewport());
}

TEST_F(RendererTest, DrawsAPartExactlyAsItIsInTheWhole) {
    const PixelFrame whole = draw(*renderer_, all_, view_, view_.viewport());
    for (const Rect& part : {Rect{20, 10, 70, 50}, Rect{0, 0, 1, 61}, Rect{33, 7, 64, 64 - 7},
                             Rect{48, 30, 49, 31}, Rect{0, 60, 97, 61}}) {
        const PixelFrame frame = draw(*renderer_, all_, view_, part);
        EXPECT_EQ(compare(frame, whole, part).pixels, 0) << part;
    }
}

TEST_F(RendererTest, ReadsAPartIntoALargerFrameAndLeavesTheRestAlone) {
    const PixelFrame whole = draw(*renderer_, all_, view_, view_.viewport());
    PixelFrame frame;
    frame.reshape({-3, -2, 120, 80});
    frame.clear(frame.rect());
    const Rect part{30, 20, 61, 41};
    ASSERT_TRUE(renderer_->read(part, frame).has_value());
    expect_same(frame, whole, part);
    EXPECT_EQ(*frame.depth(29, 20), kFarDepth);
    EXPECT_EQ(*frame.depth(61, 40), kFarDepth);
    EXPECT_EQ(*frame.depth(30, 19), kFarDepth);
    EXPECT_EQ(*frame.depth(60, 41), kFarDepth);
}

TEST_F(RendererTest, ReadsNothingThatItHasNotDrawnOrThatTheFrameDoesNotHold) {
    test::expect_reads_inside_only(*renderer_, all_, view_);
}

TEST_F(RendererTest, ForgetsTheFrameBefore) {
    const PixelFrame first = draw(*renderer_, all_, view_, view_.viewport());
    draw(*renderer_, all_, view_of(scene_, 40, 200), {0, 0, 40, 200});
    draw(*renderer_, {}, view_, view_.viewport());
    expect_same(draw(*renderer_, all_, view_, view_.viewport()), first, view_.viewport());
    const PixelFrame nothing = draw(*renderer_, {}, view_, view_.viewport());
    EXPECT_EQ(compare(nothing, nothing, view_.viewport()).active, 0);
}

// Ranges of all lengths, so that objects take one call or several.
std::vector<TriangleRange> cut(const std::vector<TriangleRange>& ranges, std::uint32_t seed) {
    std::vector<TriangleRange> parts;
    for (TriangleRange rest : ranges)
        while (rest.triangle_count > 0) {
            seed = seed * 1664525 + 1013904223;
            const std::uint32_t count = std::min(rest.triangle_count, 1 + (seed >> 16) % 8);
            parts.push_back({rest.object, rest.first_triangle, count});
            rest.first_triangle += count;
            rest.triangle_count -= count;
        }
    return parts;
}

TEST_F(RendererTest, DrawsRunsOfAnObjectAsTheObject) {
    const PixelFrame whole = draw(*renderer_, all_, view_, view_.viewport());
    for (const std::uint32_t seed : {1u, 2u}) {
        const std::vector<TriangleRange> parts = cut(all_, seed);
        ASSERT_GT(parts.size(), 2 * all_.size());
        expect_same(draw(*renderer_, parts, view_, view_.viewport()), whole, view_.viewport());
    }
}

TEST_F(RendererTest, LeavesOutTheTrianglesBetweenRuns) {
    std::vector<TriangleRange> parts = cut(all_, 3);
    std::vector<TriangleRange> odd;
    std::vector<TriangleRange> even;
    for (std::size_t i = 0; i < parts.size(); ++i) (i % 2 == 0 ? even : odd).push_back(parts[i]);
    const Rect screen = view_.viewport();
    const PixelFrame whole = draw(*renderer_, all_, view_, screen);
    PixelFrame frame = draw(*renderer_, even, view_, screen);
    EXPECT_GT(compare(frame, whole, screen).pixels, 0);
    const PixelFrame rest = draw(*renderer_, odd, view_, screen);
    Buffer body;
    const BodySizes sizes = encode_swath(rest, {screen}, body);
    ASSERT_TRUE(
        composite_swath(body.bytes(), sizes, {screen}, static_cast<ObjectId>(scene_.objects.size()), frame)
            .has_value());
    EXPECT_EQ(compare(frame, whole, screen).pixels, 0);
}

TEST_F(RendererTest, DoesNotDrawARangeOutsideOfItsObject) {
    TriangleRange range = all_[1];
    ++range.triangle_count;
    EXPECT_THROW(static_cast<void>(renderer_->draw(std::vector{range}, view_, view_.viewport())),
                 CheckFailed);
    range = all_[1];
    --range.first_triangle;
    EXPECT_THROW(static_cast<void>(renderer_->draw(std::vector{range}, view_, view_.viewport())),
                 CheckFailed);
}

TEST_F(RendererTest, DrawsAPictureOfOnePixel) {
    const View view = view_of(scene_, 1, 1);
    const PixelFrame one = draw(*renderer_, all_, view, view.viewport());
    EXPECT_EQ(compare(one, draw_elsewhere(scene_, all_, view), view.viewport()).pixels, 0);
}

TEST_F(RendererTest, NamesTheLimitOfAPictureThatIsTooLarge) {
    View view = view_;
    view.width = 70'000;
    const Status status = renderer_->draw(all_, view, {0, 0, 1, 1});
    ASSERT_FALSE(status.has_value());
    EXPECT_THAT(status.error().message,
                testing::MatchesRegex("picture size 70000x61: this renderer's limits are "
                                      "1x1 to [0-9]+x[0-9]+"));
    // It can draw pictures of a good size afterwards.
    expect_same(draw(*renderer_, all_, view_, view_.viewport()), draw_elsewhere(scene_, all_, view_),
                view_.viewport());
}

// Boxes whose faces coincide: depths tie between objects everywhere.
class TiesTest : public RendererTest {
  protected:
    TiesTest() : RendererTest("town") {}
    // Two machines draw disjoint groups; the second's pixels go to the first.
    void expect_composite_is_exact(const std::function<bool(ObjectId)>& is_first) {
        std::vector<TriangleRange> groups[2];
        for (const TriangleRange& range : all_) groups[is_first(range.object) ? 0 : 1].push_back(range);
        const Rect screen = view_.viewport();
        const PixelFrame whole = draw(*renderer_, all_, view_, screen);
        PixelFrame first = draw(*renderer_, groups[0], view_, screen);
        const PixelFrame second = draw_elsewhere(scene_, groups[1], view_);
        Buffer body;
        const BodySizes sizes = encode_swath(second, {screen}, body);
        const Status status = composite_swath(body.bytes(), sizes, {screen},
                                              static_cast<ObjectId>(scene_.objects.size()), first);
        ASSERT_TRUE(status.has_value()) << status.error().message;
        expect_same(first, whole, screen);
    }
};

TEST_F(TiesTest, OccurBetweenObjects) {
    // In the reversed order, the later of two equal depths shows.
    std::vector<TriangleRange> reversed = all_;
    std::reverse(reversed.begin(), reversed.end());
    const PixelFrame up = draw(*renderer_, all_, view_, view_.viewport());
    const PixelFrame down = draw(*renderer_, reversed, view_, view_.viewport());
    int ties = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            ASSERT_EQ(*up.depth(x, y), *down.depth(x, y));
            if (*up.depth(x, y) == kFarDepth) continue;
            ASSERT_LE(*up.id(x, y), *down.id(x, y));
            ties += *up.id(x, y) != *down.id(x, y) ? 1 : 0;
        }
    EXPECT_GT(ties, 0);  // or the tests below prove nothing
}

TEST_F(TiesTest, AreSettledAlikeByDrawingTogetherAndByCompositing) {
    expect_composite_is_exact([](ObjectId id) { return id % 2 == 0; });
    expect_composite_is_exact([](ObjectId id) { return id % 2 == 1; });
    expect_composite_is_exact([&](ObjectId id) { return id >= all_.size() / 2; });
    expect_composite_is_exact([](ObjectId) { return false; });
}

}  // namespace
}  // namespace swath
