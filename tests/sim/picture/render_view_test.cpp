#include "sim/picture/render_view.h"

#include <gtest/gtest.h>

#include "common/geometry/frustum.h"
#include "common/scene/procedural.h"
#include "tests/client/partition/scenes.h"
#include "tests/sim/picture/scenes.h"

namespace swath::sim::test {
namespace {

TEST(RenderViewTest, draws_the_model_within_its_bounds_over_the_background) {
    const ObjectSet scene = build_objects(*make_builtin("knot", 5000), {.depth = 2, .objects = 0});
    Camera camera;
    camera.eye = {0, 0, 9};
    const View view = make_view(camera, 160, 120);
    const Rgb background{1, 2, 3};
    const auto picture = render_view(scene, view, background);
    ASSERT_TRUE(picture) << picture.error().message;
    const Rect bounds = screen_bounds(scene.bounds, view);
    int drawn = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            if (pixel(*picture, x, y) == background) continue;
            ++drawn;
            EXPECT_TRUE(bounds.contains({x, y, x + 1, y + 1})) << x << ' ' << y;
        }
    EXPECT_GT(drawn, 1000);
    EXPECT_EQ(render_view(scene, view, background), picture);
}

}  // namespace
}  // namespace swath::sim::test
