#include "common/raster/raster_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "common/base/check.h"
#include "common/scene/procedural.h"
#include "tests/common/raster/reference.h"
#include "tests/support/drawings.h"

// Every instruction set draws the reference's picture, whatever is asked for, in whichever order and parts.

namespace swath {
namespace {

using test::all_of;
using test::compare;
using test::draw;
using test::expect_same;
using test::reference_picture;
using test::view_of;
using testing::HasSubstr;

std::unique_ptr<Renderer> make_rasteriser(const ObjectSet& scene, InstructionSet set = best_instruction_set(),
                                          std::size_t threads = 1) {
    auto renderer = make_raster_renderer({.kind = RendererKind::kRaster, .threads = threads}, scene, set);
    EXPECT_TRUE(renderer.has_value()) << renderer.error().message;
    return renderer ? std::move(*renderer) : nullptr;
}

void expect_reference(const ObjectSet& scene, const View& view) {
    const PixelFrame reference = reference_picture(scene, view);
    for (const InstructionSet set : instruction_sets()) {
        SCOPED_TRACE(name(set));
        expect_same(reference, draw(*make_rasteriser(scene, set), all_of(scene), view, view.viewport()),
                    view.viewport());
    }
}

// From the middle of the model, with surfaces on all sides, some before the near plane.
View view_inside(const ObjectSet& scene, int width = 97, int height = 61) {
    Camera camera;
    const glm::vec3 size = scene.bounds.size();
    camera.eye = scene.bounds.centre() + 0.01f * size;
    camera.target = scene.bounds.max;
    camera.fov_y = 1.9f;
    camera.near = 0.02f * glm::length(size);
    camera.far = 0.4f * glm::length(size);
    return make_view(camera, width, height);
}

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(engine_() % end); }
    float between(float low, float high) {
        return low + (high - low) * static_cast<float>(engine_() % 0x100'0000) * 0x1p-24f;
    }
    glm::vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

  private:
    std::mt19937 engine_;
};

void add_vertex(Mesh& mesh, const glm::vec3& position, Random& random) {
    Vertex vertex;
    vertex.position = position;
    vertex.normal = pack_normal(random.vector());
    for (std::size_t c = 0; c < 3; ++c) vertex.colour[c] = static_cast<std::uint8_t>(random.below(256));
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(vertex);
}

// A view in which model coordinates are pixels, from the lower left corner, and depth is z.
View pixel_view(int width, int height) {
    View view;
    view.clip_from_model =
        glm::ortho(0.0f, static_cast<float>(width), 0.0f, static_cast<float>(height), 0.0f, -1.0f);
    view.width = width;
    view.height = height;
    return view;
}

class RasterRendererOf : public testing::TestWithParam<const char*> {
  protected:
    const ObjectSet scene_ = test::builtin_scene(GetParam(), 5000);
    const std::vector<TriangleRange> all_ = all_of(scene_);
    const std::vector<View> views_{view_of(scene_), view_inside(scene_), view_inside(scene_, 640, 333)};
};
INSTANTIATE_TEST_SUITE_P(Models, RasterRendererOf, testing::Values("knot", "town", "spheres"),
                         [](const auto& of) { return of.param; });

TEST_P(RasterRendererOf, DrawsTheReferencesPicture) {
    for (const auto& [width, height] : {std::pair(97, 61), std::pair(640, 480), std::pair(1000, 37)}) {
        SCOPED_TRACE(fmt::format("{}x{}", width, height));
        expect_reference(scene_, view_of(scene_, width, height));
        expect_reference(scene_, view_inside(scene_, width, height));
    }
}

TEST_P(RasterRendererOf, DrawsTheReferencesPictureAtSizesUpToTheLimit) {
    for (const auto& [width, height] : {std::pair(16384, 5), std::pair(3, 16384), std::pair(4099, 130)}) {
        SCOPED_TRACE(fmt::format("{}x{}", width, height));
        expect_reference(scene_, view_inside(scene_, width, height));
    }
}

TEST_P(RasterRendererOf, IsTheSameWithAnyNumberOfThreads) {
    for (const View& view : views_) {
        const PixelFrame one = draw(*make_rasteriser(scene_), all_, view, view.viewport());
        for (const std::size_t threads : {2u, 3u, 8u})
            expect_same(
                one,
                draw(*make_rasteriser(scene_, best_instruction_set(), threads), all_, view, view.viewport()),
                view.viewport());
    }
}

TEST_P(RasterRendererOf, DrawsAPartExactlyAsItIsInTheWhole) {
    const auto renderer = make_rasteriser(scene_);
    Random random(7);
    for (const View& view : views_) {
        const PixelFrame whole = draw(*renderer, all_, view, view.viewport());
        for (int i = 0; i < 30; ++i) {
            Rect part;
            part.x0 = static_cast<int>(random.below(static_cast<std::uint32_t>(view.width)));
            part.y0 = static_cast<int>(random.below(static_cast<std::uint32_t>(view.height)));
            part.x1 = part.x0 + 1 +
                      static_cast<int>(random.below(static_cast<std::uint32_t>(view.width - part.x0)));
            part.y1 = part.y0 + 1 +
                      static_cast<int>(random.below(static_cast<std::uint32_t>(view.height - part.y0)));
            const PixelFrame frame = draw(*renderer, all_, view, part);
            ASSERT_EQ(compare(frame, whole, part).pixels, 0) << part;
        }
    }
}

// Puts the nearer pixels of `from` into `to`, of equal depths those of the smaller object.
void composite(const PixelFrame& from, PixelFrame& to) {
    const Rect& rect = to.rect();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const float theirs = *from.depth(x, y);
            const float ours = *to.depth(x, y);
            if (theirs == kFarDepth) continue;
            if (theirs > ours || (theirs == ours && *from.id(x, y) >= *to.id(x, y))) continue;
            *to.depth(x, y) = theirs;
            *to.id(x, y) = *from.id(x, y);
            *to.colour(x, y) = *from.colour(x, y);
        }
}

// Ranges end anywhere in a meshlet. An object is on one machine: of equal depths on two machines the composite
// knows only the objects.
TEST_P(RasterRendererOf, DrawsTogetherWhatSeveralDrawAndComposite) {
    Random random(5);
    for (const View& view : views_)
        for (const std::size_t machines : {2u, 5u}) {
            std::vector<std::vector<TriangleRange>> groups(machines);
            for (TriangleRange rest : all_) {
                auto& group = groups[random.below(static_cast<std::uint32_t>(machines))];
                while (rest.triangle_count > 0) {
                    const std::uint32_t count = std::min(rest.triangle_count, 1 + random.below(40));
                    group.push_back({rest.object, rest.first_triangle, count});
                    rest.first_triangle += count;
                    rest.triangle_count -= count;
                }
            }
            const auto renderer = make_rasteriser(scene_);
            PixelFrame frame = draw(*renderer, groups[0], view, view.viewport());
            for (std::size_t i = 1; i < machines; ++i)
                composite(draw(*renderer, groups[i], view, view.viewport()), frame);
            expect_same(frame, draw(*renderer, all_, view, view.viewport()), view.viewport());
        }
}

TEST_P(RasterRendererOf, ForgetsTheFrameBefore) {
    const auto renderer = make_rasteriser(scene_);
    const View& view = views_[0];
    const PixelFrame first = draw(*renderer, all_, view, view.viewport());
    draw(*renderer, all_, view_of(scene_, 40, 200), {0, 0, 40, 200});
    draw(*renderer, std::vector{all_[1]}, view, view.viewport());
    const PixelFrame nothing = draw(*renderer, {}, view, view.viewport());
    EXPECT_EQ(compare(nothing, nothing, view.viewport()).active, 0);
    expect_same(draw(*renderer, all_, view, view.viewport()), first, view.viewport());
}

// What is near hides most of what is far, and is drawn last if objects are drawn in their order.
TEST(RasterRenderer, LeavesOutOnlyWhatIsHidden) {
    const Mesh knot = *make_builtin("knot", 3000);
    const glm::vec3 size = bounds(knot).size();
    Mesh row;
    for (int i = 0; i < 6; ++i) {
        const auto first = static_cast<std::uint32_t>(row.vertices.size());
        for (Vertex vertex : knot.vertices) {
            vertex.position += static_cast<float>(i) * glm::vec3(0.1f, 0.1f, 1.2f) * size;
            row.vertices.push_back(vertex);
        }
        for (const std::uint32_t index : knot.indices) row.indices.push_back(first + index);
    }
    const ObjectSet scene = build_objects(std::move(row), {.objects = 300});
    for (const float side : {1.0f, -1.0f}) {
        Camera camera;
        camera.target = scene.bounds.centre();
        camera.eye = camera.target + glm::vec3(0.05f, 0.1f, side) * scene.bounds.size().z;
        camera.near = 0.1f;
        camera.far = 100;
        expect_reference(scene, make_view(camera, 400, 300));
    }
}

// Triangles anywhere, of all sizes, many through the eye.
TEST(RasterRenderer, DrawsSoupsAsTheReferenceDoes) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const float size = seed % 3 == 0 ? 0.05f : (seed % 3 == 1 ? 0.5f : 4.0f);
        Mesh mesh;
        for (int t = 0; t < 400; ++t) {
            const glm::vec3 middle = random.vector();
            const float scale = size * std::exp2(random.between(-6, 0));
            const glm::vec3 along = random.vector();
            for (int k = 0; k < 3; ++k)  // a third are slivers
                add_vertex(
                    mesh,
                    middle + scale * (t % 3 == 0 ? random.between(-1, 1) * along + 0.001f * random.vector()
                                                 : random.vector()),
                    random);
        }
        const ObjectSet scene = build_objects(std::move(mesh), {.objects = 20});
        expect_reference(scene, view_of(scene, 300, 200));
        expect_reference(scene, view_inside(scene, 300, 200));
        expect_reference(scene, view_inside(scene, 2000, 20));
    }
}

// Edges along rows and columns of samples, and corners on them.
TEST(RasterRenderer, DrawsTrianglesOnSamplesAsTheReferenceDoes) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        const View view = pixel_view(70, 50);
        Mesh mesh;
        for (int t = 0; t < 600; ++t) {
            const int size = t % 2 == 0 ? 5 : 40;
            const float x = static_cast<float>(random.below(70));
            const float y = static_cast<float>(random.below(50));
            for (int k = 0; k < 3; ++k)
                add_vertex(mesh,
                           {x + 0.5f * static_cast<float>(random.below(static_cast<std::uint32_t>(2 * size))),
                            y + 0.5f * static_cast<float>(random.below(static_cast<std::uint32_t>(2 * size))),
                            random.between(0, 1)},
                           random);
        }
        expect_reference(build_objects(std::move(mesh), {.objects = 5}), view);
    }
}

// Triangles between a point and the edges of a polygon around it, drawn in either order of their corners, cover each
// sample off the polygon's outline as often as the polygon winds around it: samples on an edge between two of them are
// covered by one. A triangle that is turned right counts negatively.
TEST(RasterRenderer, CoversSamplesOnSharedEdgesOnce) {
    Random random(11);
    const int side = 64;
    const View view = pixel_view(side, side);
    using Point = std::array<std::int64_t, 2>;  // 1/256 pixel
    const auto cross = [](const Point& a, const Point& b, const Point& c) {
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    int on_spokes = 0;
    for (const InstructionSet set : instruction_sets())
        for (int round = 0; round < 100; ++round) {
            const auto at = [&](float pixels) {  // often on a row or column of samples
                return random.below(2) == 0 ? 256 * std::lrint(pixels) + 128 : std::lrint(256 * pixels);
            };
            const int corners = 3 + static_cast<int>(random.below(8));
            const float radius = std::exp2(random.between(-2, 4.8f));
            std::vector<Point> around;
            for (int i = 0; i < corners; ++i) {
                const float angle = 6.2831853f * (static_cast<float>(i) + random.between(0, 0.9f)) /
                                    static_cast<float>(corners);
                around.push_back({at(32 + radius * std::cos(angle)), at(32 + radius * std::sin(angle))});
            }
            around.push_back(around.front());
            const Point middle{at(32), at(32)};
            std::vector<std::int64_t> covered(static_cast<std::size_t>(side * side));
            for (std::size_t i = 0; i + 1 < around.size(); ++i) {
                std::array<Point, 3> triangle{middle, around[i], around[i + 1]};
                const int sign = cross(triangle[0], triangle[1], triangle[2]) < 0 ? -1 : 1;
                if (random.below(2) == 0) std::swap(triangle[1], triangle[2]);
                Mesh mesh;
                for (const Point& corner : triangle)
                    add_vertex(
                        mesh,
                        {static_cast<float>(corner[0]) / 256, static_cast<float>(corner[1]) / 256, 0.5f},
                        random);
                const ObjectSet scene = build_objects(std::move(mesh), {});
                const PixelFrame frame =
                    draw(*make_rasteriser(scene, set), all_of(scene), view, view.viewport());
                for (int p = 0; p < side * side; ++p)
                    if (*frame.depth(p % side, p / side) < kFarDepth)
                        covered[static_cast<std::size_t>(p)] += sign;
            }
            for (int p = 0; p < side * side; ++p) {
                const Point sample{256 * (p % side) + 128, 256 * (p / side) + 128};
                int winding = 0;
                bool on_outline = false;
                for (std::size_t i = 0; i + 1 < around.size(); ++i) {
                    const Point& a = around[i];
                    const Point& b = around[i + 1];
                    const std::int64_t left = cross(a, b, sample);
                    const auto between = [](std::int64_t v, std::int64_t one, std::int64_t other) {
                        return std::min(one, other) <= v && v <= std::max(one, other);
                    };
                    on_outline |=
                        left == 0 && between(sample[0], a[0], b[0]) && between(sample[1], a[1], b[1]);
                    if (a[1] <= sample[1] && b[1] > sample[1] && left > 0) ++winding;
                    if (a[1] > sample[1] && b[1] <= sample[1] && left < 0) --winding;
                    on_spokes += cross(middle, a, sample) == 0 ? 1 : 0;
                }
                if (on_outline) continue;
                ASSERT_EQ(covered[static_cast<std::size_t>(p)], winding)
                    << p % side << ' ' << p / side << " of round " << round;
            }
        }
    EXPECT_GT(on_spokes, 1000);
}

TEST(RasterRenderer, DrawsAPoseAsIfTheModelWereMadeInIt) {
    Mesh mesh = *make_builtin("spheres", 5000);
    mesh.motion.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (i > 100) mesh.motion[i] = 0.37f * (mesh.vertices[i].position - glm::vec3(3, 2, 5));
    const ObjectSet moving = build_objects(std::move(mesh), {3, 0});
    for (const float pose : {0.0f, 0.1f, 1.0f / 3, 0.7f, 1.0f}) {
        ObjectSet still = moving;
        still.mesh.motion.clear();
        still.end_bounds = {};
        for (std::uint32_t i = 0; i < still.mesh.vertices.size(); ++i)
            still.mesh.vertices[i].position = posed(moving.mesh, i, pose);
        View view = view_of(moving);
        view.pose = pose;
        expect_reference(moving, view);
        expect_same(draw(*make_rasteriser(moving), all_of(moving), view, view.viewport()),
                    draw(*make_rasteriser(still), all_of(still), view, view.viewport()), view.viewport());
    }
}

TEST(RasterRenderer, ReadsNothingThatItHasNotDrawnOrThatTheFrameDoesNotHold) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    test::expect_reads_inside_only(*make_rasteriser(scene), all_of(scene), view_of(scene));
}

TEST(RasterRenderer, DoesNotDrawARangeOutsideOfItsObject) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    const View view = view_of(scene);
    const auto renderer = make_rasteriser(scene);
    for (const int what : {0, 1, 2}) {
        TriangleRange range = all_of(scene)[1];
        if (what == 0) ++range.triangle_count;
        if (what == 1) --range.first_triangle;
        if (what == 2) range.object = static_cast<ObjectId>(scene.objects.size());
        EXPECT_THROW(static_cast<void>(renderer->draw(std::vector{range}, view, view.viewport())),
                     CheckFailed);
    }
}

TEST(RasterRenderer, NamesTheLimitOfAPictureThatIsTooLarge) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    const auto renderer = make_rasteriser(scene);
    View view = view_of(scene);
    view.width = 16385;
    const Status status = renderer->draw(all_of(scene), view, {0, 0, 1, 1});
    ASSERT_FALSE(status.has_value());
    EXPECT_THAT(status.error().message,
                HasSubstr("picture size 16385x61: this renderer's limits are 1x1 to 16384x16384"));
}

// Whatever a peer sends, nothing is read or written where it should not be, and the next frame is right.
TEST(RasterRenderer, SurvivesMatricesThatAreNoProjection) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    const std::vector<TriangleRange> all = all_of(scene);
    const View good = view_of(scene);
    for (const InstructionSet set : instruction_sets()) {
        const auto renderer = make_rasteriser(scene, set);
        const PixelFrame before = draw(*renderer, all, good, good.viewport());
        for (const glm::mat4& matrix :
             {glm::mat4(0.0f), glm::mat4(1.0f), glm::mat4(std::nanf("")), glm::mat4(INFINITY),
              glm::mat4(1e30f), glm::mat4(1e-30f), -good.clip_from_model, good.clip_from_model * 1e20f,
              good.clip_from_model * 1e-20f}) {
            View view = good;
            view.clip_from_model = matrix;
            static_cast<void>(renderer->draw(all, view, view.viewport()));
        }
        View view = good;
        for (const float number : {1e30f, INFINITY, std::nanf("")}) {
            view.to_light = glm::vec3(number);
            static_cast<void>(renderer->draw(all, view, view.viewport()));
            view.pose = number;
        }
        expect_same(draw(*renderer, all, good, good.viewport()), before, good.viewport());
    }
}

TEST(RasterRenderer, SaysWhatItIs) {
    const ObjectSet scene = test::builtin_scene("knot", 2000);
    EXPECT_THAT(make_rasteriser(scene, InstructionSet::kPortable, 3)->description(),
                testing::AllOf(HasSubstr("rasteriser"), HasSubstr("portable"), HasSubstr("3 threads")));
}

}  // namespace
}  // namespace swath
