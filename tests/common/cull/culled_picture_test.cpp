#include <gtest/gtest.h>

#include "common/cull/leaf_cull.h"
#include "common/renderers/make_renderer.h"
#include "tests/common/cull/cull_scenes.h"

// Culling for a rectangle changes no bit of it: colour, depth or id.

namespace swath {
namespace {

struct Counted {
    int different = 0;
    int active = 0;
};

Counted compare(const PixelFrame& a, const PixelFrame& b, const Rect& rect) {
    Counted counted;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const bool active = *a.depth(x, y) < kFarDepth;
            counted.active += active ? 1 : 0;
            const bool same = *a.depth(x, y) == *b.depth(x, y) &&
                              (!active || (*a.colour(x, y) == *b.colour(x, y) && *a.id(x, y) == *b.id(x, y)));
            counted.different += same ? 0 : 1;
        }
    return counted;
}

PixelFrame draw(Renderer& renderer, const DrawList& list, const View& view, const Rect& rect) {
    const Status drawn = renderer.draw(list.runs, view, rect);
    EXPECT_TRUE(drawn.has_value()) << drawn.error().message;
    PixelFrame frame;
    frame.reshape(rect);
    EXPECT_TRUE(renderer.read(rect, frame).has_value());
    return frame;
}

TEST(CulledPicture, EqualsThatOfTheWholeModel) {
    const SteadyClock clock;
    ThreadTeam team(2, clock);
    int active = 0;
    for (const glm::vec3& offset : {glm::vec3(0), glm::vec3(-300, 40, 1000), glm::vec3(3e4f, 1e5f, -2e4f)})
        for (const bool moves : {false, true}) {
            const ObjectSet scene = moves ? test::moving_soup(13, offset, 4) : test::soup(13, offset, 4);
            const std::vector<ObjectId> all = test::all_ids(scene);
            auto renderer = make_renderer(RendererSetup{}, scene);
            ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
            LeafCull none(CullAlgorithm::kNone, scene, team);
            LeafCull wide(CullAlgorithm::kWide, scene, team);
            test::RandomViews random(8);
            for (int round = 0; round < 60; ++round) {
                const View view = random.posed_view(scene);
                const Rect rect = random.rect(view);
                const PixelFrame expected = draw(**renderer, none.cull(all, view, rect), view, rect);
                const Counted counted =
                    compare(expected, draw(**renderer, wide.cull(all, view, rect), view, rect), rect);
                ASSERT_EQ(counted.different, 0) << "round " << round << ", " << rect;
                active += counted.active;
            }
        }
    EXPECT_GT(active, 20'000);
}

}  // namespace
}  // namespace swath
