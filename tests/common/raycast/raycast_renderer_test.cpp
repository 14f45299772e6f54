#include "common/raycast/raycast_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <thread>

#include "common/base/check.h"
#include "common/image/pixel_codec.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "common/scene/procedural.h"
#include "tests/support/drawings.h"
#include "tests/support/models.h"

// A pixel depends only on the objects and the view, and is nearly the rasteriser's.

namespace swath {
namespace {

using test::all_of;
using test::compare;
using test::draw;
using test::expect_same;
using test::view_of;
using testing::HasSubstr;

// From the middle of the model, with surfaces on all sides, some before the near plane.
View view_inside(const ObjectSet& scene) {
    Camera camera;
    const glm::vec3 size = scene.bounds.size();
    camera.eye = scene.bounds.centre() + 0.01f * size;
    camera.target = scene.bounds.max;
    camera.fov_y = 1.9f;
    camera.near = 0.02f * glm::length(size);
    camera.far = 0.4f * glm::length(size);
    return make_view(camera, 97, 61);
}

struct How {
    bool shadows = false;
    bool dynamic = false;
    std::size_t threads = 1;
};
constexpr How kHows[] = {{false, false, 1}, {false, true, 2}, {true, false, 2}, {true, true, 1}};

std::unique_ptr<Renderer> make_ray_caster(const ObjectSet& scene, const How& how = {}) {
    auto renderer =
        make_raycast_renderer({RendererKind::kRaycast, {how.shadows, how.dynamic}, how.threads}, scene);
    EXPECT_TRUE(renderer.has_value()) << renderer.error().message;
    return renderer ? std::move(*renderer) : nullptr;
}

PixelFrame draw(const ObjectSet& scene, const View& view, const How& how) {
    return draw(*make_ray_caster(scene, how), all_of(scene), view, view.viewport());
}
// OpenGL is bound to its thread, so it gets one.
PixelFrame rasterise(const ObjectSet& scene, const View& view) {
    PixelFrame frame;
    std::thread([&] {
        const auto renderer = make_renderer({test::gl_here()}, scene);
        ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
        frame = draw(**renderer, all_of(scene), view, view.viewport());
    }).join();
    return frame;
}

class RaycastRendererOf : public testing::TestWithParam<const char*> {
  protected:
    const ObjectSet scene_ = test::builtin_scene(GetParam(), 5000);
    const std::vector<TriangleRange> all_ = all_of(scene_);
    const std::vector<View> views_{view_of(scene_), view_inside(scene_)};
};
INSTANTIATE_TEST_SUITE_P(Models, RaycastRendererOf, testing::Values("knot", "town", "spheres"),
                         [](const auto& of) { return of.param; });

TEST_P(RaycastRendererOf, IsTheSameWithAnyNumberOfThreadsAndATreeForEachFrame) {
    for (const View& view : views_)
        for (const bool shadows : {false, true}) {
            const PixelFrame one = draw(scene_, view, {shadows, false, 1});
            for (const std::size_t threads : {1u, 2u, 3u, 8u})
                for (const bool dynamic : {false, true})
                    expect_same(draw(scene_, view, {shadows, dynamic, threads}), one, view.viewport());
        }
}

TEST_P(RaycastRendererOf, DrawsAPartExactlyAsItIsInTheWhole) {
    for (const How& how : kHows) {
        const auto renderer = make_ray_caster(scene_, how);
        for (const View& view : views_) {
            const PixelFrame whole = draw(*renderer, all_, view, view.viewport());
            for (const Rect& part : {Rect{20, 10, 70, 50}, Rect{0, 0, 1, 61}, Rect{33, 7, 64, 64 - 7},
                                     Rect{48, 30, 49, 31}, Rect{0, 60, 97, 61}, Rect{3, 2, 36, 35}}) {
                const PixelFrame frame = draw(*renderer, all_, view, part);
                EXPECT_EQ(compare(frame, whole, part).pixels, 0) << part;
            }
        }
    }
}

// Deals ranges of all lengths out to machines, and composites their pixels on the first.
TEST_P(RaycastRendererOf, DrawsTogetherWhatSeveralDrawAndComposite) {
    std::uint32_t seed = 5;
    const auto next = [&] { return (seed = seed * 1664525 + 1013904223) >> 16; };
    for (const How& how : kHows)
        for (const View& view : views_)
            for (const std::size_t machines : {2u, 3u}) {
                std::vector<std::vector<TriangleRange>> groups(machines);
                // An object is on one machine: of equal depths on two machines the composite knows only the
                // objects.
                for (const TriangleRange& range : all_) groups[next() % machines].push_back(range);
                const Rect screen = view.viewport();
                const PixelFrame whole = draw(scene_, view, how);
                PixelFrame frame = draw(*make_ray_caster(scene_, how), groups[0], view, screen);
                EXPECT_GT(compare(frame, whole, screen).pixels, 0);
                for (std::size_t i = 1; i < machines; ++i) {
                    const PixelFrame more = draw(*make_ray_caster(scene_, how), groups[i], view, screen);
                    Buffer body;
                    const BodySizes sizes = encode_swath(more, {screen}, body);
                    ASSERT_TRUE(composite_swath(body.bytes(), sizes, {screen},
                                                static_cast<ObjectId>(scene_.objects.size()), frame)
                                    .has_value());
                }
                expect_same(frame, whole, screen);
            }
}

TEST_P(RaycastRendererOf, ForgetsTheFrameBefore) {
    for (const How& how : kHows) {
        const auto renderer = make_ray_caster(scene_, how);
        const View& view = views_[0];
        const PixelFrame first = draw(*renderer, all_, view, view.viewport());
        draw(*renderer, all_, view_of(scene_, 40, 200), {0, 0, 40, 200});
        draw(*renderer, std::vector{all_[1]}, view, view.viewport());
        const PixelFrame nothing = draw(*renderer, {}, view, view.viewport());
        EXPECT_EQ(compare(nothing, nothing, view.viewport()).active, 0);
        expect_same(draw(*renderer, all_, view, view.viewport()), first, view.viewport());
    }
}

// When drawn together, the smaller id of equal depths shows, as with compositing.
TEST(RaycastRenderer, SettlesTiesByTheSmallerId) {
    const ObjectSet scene = test::builtin_scene("town", 5000);
    const View view = view_of(scene);
    const PixelFrame whole = draw(scene, view, {});
    const auto renderer = make_ray_caster(scene);
    std::vector<TriangleRange> all = all_of(scene);
    // Without the winner of a pixel there is often another triangle as near.
    int ties = 0;
    for (const TriangleRange& range : all) {
        std::vector<TriangleRange> others;
        for (const TriangleRange& other : all)
            if (other.object != range.object) others.push_back(other);
        const PixelFrame rest = draw(*renderer, others, view, view.viewport());
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                if (*whole.depth(x, y) == kFarDepth || *rest.depth(x, y) != *whole.depth(x, y)) continue;
                if (*whole.id(x, y) != range.object) continue;
                ++ties;
                ASSERT_GT(*rest.id(x, y), range.object);
            }
    }
    EXPECT_GT(ties, 0);
}

TEST(RaycastRenderer, ReadsAPartIntoALargerFrameAndLeavesTheRestAlone) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    const View view = view_of(scene);
    const auto renderer = make_ray_caster(scene);
    const PixelFrame whole = draw(*renderer, all_of(scene), view, view.viewport());
    PixelFrame frame;
    frame.reshape({-3, -2, 120, 80});
    frame.clear(frame.rect());
    const Rect part{30, 20, 61, 41};
    ASSERT_TRUE(renderer->read(part, frame).has_value());
    expect_same(frame, whole, part);
    for (const auto& [x, y] : {std::pair{29, 20}, {61, 40}, {30, 19}, {60, 41}})
        EXPECT_EQ(*frame.depth(x, y), kFarDepth);
}

TEST(RaycastRenderer, ReadsNothingThatItHasNotDrawnOrThatTheFrameDoesNotHold) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    for (const How& how : kHows)
        test::expect_reads_inside_only(*make_ray_caster(scene, how), all_of(scene), view_of(scene));
}

TEST(RaycastRenderer, DoesNotDrawARangeOutsideOfItsObject) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    const View view = view_of(scene);
    const TriangleRange good = all_of(scene)[1];
    for (const How& how : kHows) {
        const auto renderer = make_ray_caster(scene, how);
        for (const int what : {0, 1, 2}) {
            TriangleRange range = good;
            if (what == 0) ++range.triangle_count;
            if (what == 1) --range.first_triangle;
            if (what == 2) range.object = static_cast<ObjectId>(scene.objects.size());
            EXPECT_THROW(static_cast<void>(renderer->draw(std::vector{range}, view, view.viewport())),
                         CheckFailed);
        }
    }
}

TEST(RaycastRenderer, SaysWhatItIs) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    EXPECT_THAT(make_ray_caster(scene, {true, true, 3})->description(),
                testing::AllOf(HasSubstr("ray caster"), HasSubstr("3 threads"), HasSubstr("shadows"),
                               HasSubstr("each frame")));
}

// A view with no rays, or with rays that are not finite.
TEST(RaycastRenderer, RefusesAViewThatIsNoPerspective) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    const std::vector<TriangleRange> all = all_of(scene);
    const View good = view_of(scene);
    for (const How& how : kHows) {
        const auto renderer = make_ray_caster(scene, how);
        const PixelFrame before = draw(*renderer, all, good, good.viewport());
        const glm::mat4 ortho = glm::ortho(-1.0f, 1.0f, -1.0f, 1.0f, 0.1f, 10.0f);
        for (const glm::mat4& matrix : {glm::mat4(0.0f), glm::mat4(1.0f), ortho, glm::mat4(std::nanf("")),
                                        glm::mat4(INFINITY), -good.clip_from_model}) {
            View view = good;
            view.clip_from_model = matrix;
            const Status status = renderer->draw(all, view, view.viewport());
            ASSERT_FALSE(status.has_value());
            EXPECT_THAT(status.error().message, HasSubstr("ray caster"));
        }
        expect_same(draw(*renderer, all, good, good.viewport()), before, good.viewport());
    }
}

// Parts that fly apart, and one that stays.
ObjectSet moving_spheres() {
    Mesh mesh = *make_builtin("spheres", 5000);
    mesh.motion.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (i > 100) mesh.motion[i] = 0.37f * (mesh.vertices[i].position - glm::vec3(3, 2, 5));
    return build_objects(std::move(mesh), {3, 0});
}

// A model of any size: the still model is scaled by itself.
TEST(MovingRaycastRenderer, DrawsAPoseAsIfTheModelWereMadeInIt) {
    const ObjectSet moving = moving_spheres();
    const std::vector<TriangleRange> all = all_of(moving);
    for (const How& how : kHows) {
        const auto renderer = make_ray_caster(moving, how);
        std::vector<PixelFrame> pictures;
        for (const float pose : {0.0f, 0.1f, 1.0f / 3, 0.7f, 1.0f, 0.1f}) {
            ObjectSet still = moving;
            still.mesh.motion.clear();
            still.end_bounds = {};
            for (std::uint32_t i = 0; i < still.mesh.vertices.size(); ++i)
                still.mesh.vertices[i].position = posed(moving.mesh, i, pose);
            still.bounds = bounds(still.mesh);
            View view = view_of(moving);
            view.pose = pose;
            pictures.push_back(draw(*renderer, all, view, view.viewport()));
            expect_same(pictures.back(), draw(still, view, how), view.viewport());
        }
        EXPECT_GT(compare(pictures[0], pictures[3], pictures[0].rect()).pixels, 100);
        expect_same(pictures[1], pictures[5], pictures[1].rect());
    }
}

// A bad pose is an error of that frame only.
TEST(MovingRaycastRenderer, RefusesAPoseThatIsNotANumberAndGoesOn) {
    const ObjectSet moving = moving_spheres();
    const std::vector<TriangleRange> all = all_of(moving);
    for (const How& how : kHows) {
        const auto renderer = make_ray_caster(moving, how);
        View view = view_of(moving);
        const PixelFrame before = draw(*renderer, all, view, view.viewport());
        for (const float pose : {1e36f, 1e36f, std::nanf(""), std::nanf("")}) {
            view.pose = pose;
            const Status status = renderer->draw(all, view, view.viewport());
            ASSERT_FALSE(status.has_value());
            EXPECT_THAT(status.error().message, HasSubstr("ray caster"));
        }
        view.pose = 0;
        expect_same(draw(*renderer, all, view, view.viewport()), before, view.viewport());
    }
}

// Comparison with the rasteriser.

struct Agreement {
    int drawn = 0;  // pixels that either draws
    int away = 0;   // of them, away from silhouettes
    int drawn_by_one = 0;
    int far_depths = 0;   // away, with depths that differ by more than 1e-5
    int far_colours = 0;  // away, with a channel that differs by more than 2
    int other_ids = 0;    // away
    float depth = 0;      // the largest difference away
    int colour = 0;
};

// True away from silhouettes: all eight neighbours are drawn, and depth changes evenly through the pixel in
// every direction, so that no two surfaces meet there. A rasteriser moves corners to a grid of about 1/256 of
// a pixel: this moves depths most where a surface is seen from its side, and colours where it bends.
constexpr float kEven = 1e-5f;
bool is_away(const PixelFrame& frame, int x, int y) {
    const Rect& rect = frame.rect();
    if (x <= rect.x0 || y <= rect.y0 || x + 1 >= rect.x1 || y + 1 >= rect.y1) return false;
    const float here = *frame.depth(x, y);
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
        const float one = *frame.depth(x + dx, y + dy);
        const float other = *frame.depth(x - dx, y - dy);
        if (one == kFarDepth || other == kFarDepth) return false;
        if (std::abs((one - here) - (here - other)) > kEven) return false;
    }
    return here < kFarDepth;
}

Agreement agreement(const PixelFrame& rays, const PixelFrame& raster) {
    Agreement found;
    const Rect& rect = raster.rect();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const bool one = *rays.depth(x, y) < kFarDepth;
            const bool other = *raster.depth(x, y) < kFarDepth;
            found.drawn += one || other ? 1 : 0;
            found.drawn_by_one += one != other ? 1 : 0;
            if (!is_away(raster, x, y)) continue;
            ++found.away;
            const float depth = std::abs(*rays.depth(x, y) - *raster.depth(x, y));
            found.depth = std::max(found.depth, depth);
            found.far_depths += depth > 1e-5f ? 1 : 0;
            found.other_ids += *rays.id(x, y) != *raster.id(x, y) ? 1 : 0;
            int colour = 0;
            for (int channel = 0; channel < 24; channel += 8)
                colour = std::max(colour, std::abs(static_cast<int>(*rays.colour(x, y) >> channel & 255) -
                                                   static_cast<int>(*raster.colour(x, y) >> channel & 255)));
            found.colour = std::max(found.colour, colour);
            found.far_colours += colour > 2 ? 1 : 0;
        }
    return found;
}

void expect_agreement(const ObjectSet& scene, double least_away) {
    const View view = view_of(scene, 480, 360);
    const Agreement found = agreement(draw(scene, view, {}), rasterise(scene, view));
    std::printf(
        "%d drawn, %d by one only, %.4f away; depths off by %.2g, %d far; colours off by %d, %d far; %d "
        "other ids\n",
        found.drawn, found.drawn_by_one, static_cast<double>(found.away) / found.drawn,
        static_cast<double>(found.depth), found.far_depths, found.colour, found.far_colours, found.other_ids);
    EXPECT_GT(found.away, least_away * found.drawn);
    EXPECT_EQ(found.far_depths, 0) << found.depth;
}

TEST(RaycastRenderer, HasTheRasterisersDepthsAwayFromSilhouettes) {
    for (const char* model : {"knot", "town", "spheres"}) {
        SCOPED_TRACE(model);
        expect_agreement(test::builtin_scene(model, 20'000), 0.25);
    }
}
TEST(RaycastRenderer, HasTheRasterisersDepthsOfTheDragonAwayFromSilhouettes) {
    SWATH_SHARED_MODEL(path, "dragon.ply");
    expect_agreement(build_objects(*load_model(path), {4, 0}), 0.5);
}
TEST(RaycastRenderer, HasTheRasterisersDepthsOfTheConferenceAwayFromSilhouettes) {
    SWATH_SHARED_MODEL(path, "conference.ply");
    expect_agreement(build_objects(*load_model(path), {4, 0}), 0.5);
}

// Shadows.

// A plate from -1 to 1 at height 1 over a floor from -5 to 5 at height 0.
ObjectSet plate_over_floor() {
    Mesh mesh;
    const auto square = [&](float half, float height) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const auto& [x, z] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
            Vertex vertex;
            vertex.position = {half * x, height, half * z};
            mesh.vertices.push_back(vertex);
        }
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
    };
    square(5, 0);
    square(1, 1);
    compute_normals(mesh);
    return build_objects(std::move(mesh), {3, 0});
}

TEST(Shadows, AreWhereThePlateIsInTheLightsWay) {
    const ObjectSet scene = plate_over_floor();
    Camera camera;
    camera.eye = {4, 7, 6};
    camera.target = {0, 0, 0};
    camera.fov_y = 0.9f;
    camera.near = 1;
    camera.far = 30;
    View view = make_view(camera, 320, 240);
    for (const glm::vec3& direction :
         {glm::vec3(0, 1, 0), glm::vec3(1, 2, 0.5f), glm::vec3(-1, 1, -1), glm::vec3(0.2f, 0.3f, -0.3f)}) {
        view.to_light = glm::normalize(direction);
        for (const bool dynamic : {false, true}) {
            const auto renderer = make_ray_caster(scene, {true, dynamic, 2});
            const auto without = make_ray_caster(scene, {false, dynamic, 1});
            const PixelFrame frame = draw(*renderer, all_of(scene), view, view.viewport());
            const PixelFrame lit = draw(*without, all_of(scene), view, view.viewport());
            const glm::dmat4 inverse = glm::inverse(glm::dmat4(view.clip_from_model));
            const auto level = [](const PixelFrame& of, int x, int y) {
                return static_cast<int>(*of.colour(x, y) & 255);
            };
            const int expected_lit = static_cast<int>(200 * (0.2f + 0.8f * view.to_light.y) + 0.5f);
            int counts[3] = {};
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const double depth = static_cast<double>(*frame.depth(x, y));
                    ASSERT_EQ(*frame.depth(x, y), *lit.depth(x, y));
                    if (*frame.depth(x, y) == kFarDepth) continue;
                    const glm::dvec4 at =
                        inverse * glm::dvec4(2 * (x + 0.5) / view.width - 1, 2 * (y + 0.5) / view.height - 1,
                                             2 * depth - 1, 1);
                    const glm::dvec3 point = glm::dvec3(at) / at.w;
                    ASSERT_NEAR(level(lit, x, y), expected_lit, 1);
                    if (point.y > 0.5) {  // the plate, which nothing shadows
                        ASSERT_NEAR(level(frame, x, y), expected_lit, 1);
                        ++counts[2];
                        continue;
                    }
                    // The point where the light that comes here crosses the plate's height.
                    const glm::dvec3 above =
                        point +
                        glm::dvec3(view.to_light) * ((1 - point.y) / static_cast<double>(view.to_light.y));
                    const double off = std::max(std::abs(above.x), std::abs(above.z)) - 1;
                    if (std::abs(off) < 0.01) continue;
                    ASSERT_NEAR(level(frame, x, y), off < 0 ? 40 : expected_lit, 1)
                        << point.x << ' ' << point.z;
                    ++counts[off < 0 ? 0 : 1];
                }
            for (const int count : counts) EXPECT_GT(count, 300);
        }
    }
}

// Every server has the whole model: objects that others draw are in the light's way, too.
TEST(Shadows, AreCastByWhatIsNotDrawn) {
    const ObjectSet scene = plate_over_floor();
    View view = view_of(scene);
    view.to_light = glm::normalize(glm::vec3(0.1f, 1, 0.2f));
    std::vector<TriangleRange> floor;
    for (const TriangleRange& range : all_of(scene))
        if (scene.objects[range.object].box.max.y < 0.5f) floor.push_back(range);
    ASSERT_LT(floor.size(), scene.objects.size());
    for (const bool dynamic : {false, true}) {
        const auto renderer = make_ray_caster(scene, {true, dynamic, 1});
        const PixelFrame frame = draw(*renderer, floor, view, view.viewport());
        int dark = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                dark += *frame.depth(x, y) < kFarDepth && (*frame.colour(x, y) & 255) < 50 ? 1 : 0;
        EXPECT_GT(dark, 20);
    }
}

// No surface shadows itself: on a convex model with the light at the eye everything visible is lit.
TEST(Shadows, AreNotOnAConvexSurfaceThatFacesTheLight) {
    for (const float size : {1.0f, 1e-6f, 1e9f}) {
        const ObjectSet scene = build_objects(test::cube(size), {2, 0});
        const View view = view_of(scene, 200, 150);
        expect_same(draw(scene, view, {true, false, 1}), draw(scene, view, {false, false, 1}),
                    view.viewport());
    }
}

}  // namespace
}  // namespace swath
