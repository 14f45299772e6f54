#include "tests/support/drawings.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "common/base/check.h"
#include "common/render/gl_renderer.h"
#include "common/scene/procedural.h"

namespace swath::test {

ObjectSet builtin_scene(const std::string& model, std::size_t triangles) {
    return build_objects(*make_builtin(model, triangles), {3, 0});
}

View view_of(const ObjectSet& scene, int width, int height) {
    Camera camera;
    const float size = glm::length(scene.bounds.size());
    camera.target = scene.bounds.centre();
    camera.eye = camera.target + size * glm::vec3(0.5f, 0.4f, 0.7f);
    camera.fov_y = 0.8f;
    camera.near = 0.01f * size;
    camera.far = 4 * size;
    return make_view(camera, width, height);
}

std::vector<TriangleRange> all_of(const ObjectSet& scene) {
    std::vector<ObjectId> ids(scene.objects.size());
    for (ObjectId id = 0; id < ids.size(); ++id) ids[id] = id;
    return whole_objects(scene.objects, ids);
}

RendererKind gl_here() {
    static const RendererKind kind = [] {
        bool works = false;
        // A thread holds one context at most, and this one may.
        std::thread([&] { works = try_gl(RendererKind::kOsmesa).has_value(); }).join();
        return works ? RendererKind::kOsmesa : RendererKind::kEgl;
    }();
    return kind;
}

PixelFrame draw(Renderer& renderer, std::span<const TriangleRange> ranges, const View& view,
                const Rect& rect) {
    const Status drawn = renderer.draw(ranges, view, rect);
    EXPECT_TRUE(drawn.has_value()) << drawn.error().message;
    PixelFrame frame;
    frame.reshape(rect);
    const Status read = renderer.read(rect, frame);
    EXPECT_TRUE(read.has_value()) << read.error().message;
    return frame;
}

Difference compare(const PixelFrame& a, const PixelFrame& b, const Rect& rect) {
    Difference found;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const bool active = *a.depth(x, y) < kFarDepth;
            found.active += active ? 1 : 0;
            const bool same = *a.depth(x, y) == *b.depth(x, y) &&
                              (!active || (*a.colour(x, y) == *b.colour(x, y) && *a.id(x, y) == *b.id(x, y)));
            found.pixels += same ? 0 : 1;
        }
    return found;
}
void expect_same(const PixelFrame& a, const PixelFrame& b, const Rect& rect) {
    const Difference found = compare(a, b, rect);
    EXPECT_EQ(found.pixels, 0);
    EXPECT_GT(found.active, 0);
}

void expect_reads_inside_only(Renderer& renderer, std::span<const TriangleRange> ranges, const View& view) {
    const Rect part{30, 20, 61, 41};
    const std::array outside{Rect{29, 20, 61, 41}, Rect{30, 19, 61, 41}, Rect{30, 20, 62, 41},
                             Rect{30, 20, 61, 42}, view.viewport()};
    PixelFrame frame;
    frame.reshape({-100, -100, 200, 200});
    EXPECT_THROW(static_cast<void>(renderer.read(part, frame)), CheckFailed);  // before anything is drawn
    ASSERT_TRUE(renderer.draw(ranges, view, part).has_value());
    for (const Rect& rect : outside)
        EXPECT_THROW(static_cast<void>(renderer.read(rect, frame)), CheckFailed) << rect;
    ASSERT_TRUE(renderer.draw(ranges, view, view.viewport()).has_value());
    frame.reshape(part);
    for (const Rect& rect : outside)
        EXPECT_THROW(static_cast<void>(renderer.read(rect, frame)), CheckFailed) << rect;
    EXPECT_TRUE(renderer.read(part, frame).has_value());
    EXPECT_TRUE(renderer.read({}, frame).has_value());
}

}  // namespace swath::test
