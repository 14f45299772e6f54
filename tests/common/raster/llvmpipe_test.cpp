#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <thread>

#include "common/raster/raster_renderer.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "tests/support/drawings.h"
#include "tests/support/models.h"

// Our rasteriser covers the samples that llvmpipe covers, and gives them nearly its depths and colours.

namespace swath {
namespace {

using test::all_of;
using test::view_of;

struct Apart {
    int active = 0;
    int covered_by_one = 0;
    int far_depths = 0;   // by more than 1e-5
    int far_colours = 0;  // by more than 1 in a channel
};

Apart apart(const ObjectSet& scene, const View& view) {
    PixelFrame theirs;
    // OpenGL is bound to its thread, so it gets one.
    std::thread([&] {
        const auto renderer = make_renderer({test::gl_here()}, scene);
        ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
        theirs = test::draw(**renderer, all_of(scene), view, view.viewport());
    }).join();
    const auto renderer = make_raster_renderer({.kind = RendererKind::kRaster}, scene);
    const PixelFrame ours = test::draw(**renderer, all_of(scene), view, view.viewport());
    Apart found;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const bool in_theirs = *theirs.depth(x, y) < kFarDepth;
            const bool in_ours = *ours.depth(x, y) < kFarDepth;
            found.active += in_ours ? 1 : 0;
            found.covered_by_one += in_theirs != in_ours ? 1 : 0;
            if (!in_theirs || !in_ours || *theirs.id(x, y) != *ours.id(x, y)) continue;
            found.far_depths += std::abs(*theirs.depth(x, y) - *ours.depth(x, y)) > 1e-5f ? 1 : 0;
            int most = 0;
            for (int shift = 0; shift < 24; shift += 8)
                most = std::max(most, std::abs(static_cast<int>(*theirs.colour(x, y) >> shift & 0xff) -
                                               static_cast<int>(*ours.colour(x, y) >> shift & 0xff)));
            found.far_colours += most > 1 ? 1 : 0;
        }
    return found;
}

// Corners on samples and half-way between them: every edge that may own samples does it alike, also level ones.
TEST(RasterBesideLlvmpipe, CoversTheSameSamplesOnEdges) {
    std::mt19937 random(3);
    int active = 0;
    for (int round = 0; round < 20; ++round) {
        Mesh mesh;
        for (int t = 0; t < 60; ++t) {
            const auto x = static_cast<int>(random() % 120);
            const auto y = static_cast<int>(random() % 56);
            for (int k = 0; k < 3; ++k) {
                Vertex vertex;
                // Of every second triangle, two corners are level.
                const int row = t % 2 == 0 && k == 1 ? 0 : static_cast<int>(random() % 16);
                vertex.position = {static_cast<float>(x) + 0.5f * static_cast<float>(random() % 16),
                                   static_cast<float>(y) + (k == 0 ? 0 : 0.5f * static_cast<float>(row)),
                                   static_cast<float>(random() % 100) * 0.01f};
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
                mesh.vertices.push_back(vertex);
            }
        }
        View view;
        view.clip_from_model = glm::ortho(0.0f, 128.0f, 0.0f, 64.0f, 0.0f, -1.0f);
        view.width = 128;
        view.height = 64;
        const Apart found = apart(build_objects(std::move(mesh), {}), view);
        EXPECT_EQ(found.covered_by_one, 0) << "round " << round;
        active += found.active;
    }
    EXPECT_GT(active, 5000);
}

TEST(RasterBesideLlvmpipe, DrawsNearlyTheSameOfModels) {
    for (const char* model : {"knot", "town", "spheres"}) {
        SCOPED_TRACE(model);
        const ObjectSet scene = test::builtin_scene(model, 20000);
        const Apart found = apart(scene, view_of(scene, 640, 480));
        EXPECT_GT(found.active, 10000);
        EXPECT_EQ(found.covered_by_one, 0);
        EXPECT_LT(found.far_depths, found.active / 1000);
        // Faces of the town's houses coincide, and the last bit of their depths says which shows.
        const bool ties = model == std::string("town");
        EXPECT_LT(found.far_colours, ties ? found.active : found.active / 1000);
    }
}

class RasterBesideLlvmpipeOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, RasterBesideLlvmpipeOf, testing::Values("bunny", "dragon", "conference"),
                         [](const auto& of) { return of.param; });

// Of the Conference a pixel differs, at the edge of a triangle that is as large as the screen and reaches beyond it.
TEST_P(RasterBesideLlvmpipeOf, CoversTheSameSamples) {
    SWATH_SHARED_MODEL(file, std::string(GetParam()) + ".ply");
    const auto mesh = load_model(file);
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    const ObjectSet scene = build_objects(*mesh, {});
    const bool room = GetParam() == std::string("conference");
    for (const auto& [width, height] : {std::pair(640, 480), std::pair(1280, 960)}) {
        const Apart found = apart(scene, view_of(scene, width, height));
        EXPECT_GT(found.active, 10000);
        EXPECT_LE(found.covered_by_one, room ? 1 : 0);
        EXPECT_LT(found.far_depths, found.active / 1000);
        EXPECT_LT(found.far_colours, found.active / 1000);
    }
}

}  // namespace
}  // namespace swath
