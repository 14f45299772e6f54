#include <gtest/gtest.h>

#include "common/cullers/make_culler.h"
#include "common/renderers/make_renderer.h"
#include "tests/common/cull/cull_scenes.h"
#include "tests/support/drawings.h"

// Culling for a rectangle changes no bit of its colour, depth or ids.

namespace swath {
namespace {

TEST(CulledPicture, EqualsThatOfTheWholeModel) {
    const SteadyClock clock;
    ThreadTeam team(2, clock);
    int active = 0;
    for (const glm::vec3& offset : {glm::vec3(0), glm::vec3(-300, 40, 1000), glm::vec3(3e4f, 1e5f, -2e4f)})
        for (const bool moves : {false, true}) {
            const ObjectSet scene = moves ? test::moving_soup(13, offset, 4) : test::soup(13, offset, 4);
            const std::vector<ObjectId> all = test::all_ids(scene);
            auto renderer = make_renderer({test::gl_here()}, scene);
            ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
            LeafCull none = make_leaf_cull(CullAlgorithm::kNone, scene, team);
            LeafCull wide = make_leaf_cull(CullAlgorithm::kWide, scene, team);
            test::RandomViews random(8);
            for (int round = 0; round < 60; ++round) {
                const View view = random.posed_view(scene);
                const Rect rect = random.rect(view);
                const PixelFrame expected =
                    test::draw(**renderer, none.cull(all, view, rect).ranges, view, rect);
                const test::Difference found = test::compare(
                    expected, test::draw(**renderer, wide.cull(all, view, rect).ranges, view, rect), rect);
                ASSERT_EQ(found.pixels, 0) << "round " << round << ", " << rect;
                active += found.active;
            }
        }
    EXPECT_GT(active, 20'000);
}

}  // namespace
}  // namespace swath
