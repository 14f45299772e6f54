#include "common/cull/leaf_cull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "common/base/check.h"
#include "common/cullers/make_culler.h"
#include "common/geometry/frustum.h"
#include "tests/common/cull/cull_scenes.h"

namespace swath {
namespace {

using test::all_ids;
using test::RandomViews;

constexpr std::array kAll{CullAlgorithm::kWide, CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb,
                          CullAlgorithm::kNone};

class LeafCullTest : public testing::Test {
  protected:
    LeafCull culler(CullAlgorithm algorithm = CullAlgorithm::kWide) {
        return make_leaf_cull(algorithm, scene_, team_);
    }
    std::vector<ObjectId> some(RandomViews& random) const {
        std::vector<ObjectId> group;
        for (const ObjectId id : all_)
            if (random.below(3) != 0) group.push_back(id);
        return group;
    }
    // The triangles that a loop over the group's leaves would draw.
    std::vector<bool> not_outside(std::span<const ObjectId> group, const View& view, const Rect& rect) const {
        return not_outside(scene_, group, view, rect);
    }
    static std::vector<bool> not_outside(const ObjectSet& scene, std::span<const ObjectId> group,
                                         const View& view, const Rect& rect) {
        const Frustum frustum = make_frustum(view, rect, scene.bounds_at(view.pose));
        std::vector<bool> triangles(scene.mesh.triangle_count());
        for (const ObjectId id : group)
            for (std::uint32_t i = 0; i < scene.objects[id].leaf_count; ++i) {
                const Leaf& leaf = scene.leaves[scene.objects[id].first_leaf + i];
                if (outside(frustum, leaf.box_at(view.pose))) continue;
                std::fill_n(triangles.begin() + leaf.first_triangle, leaf.triangle_count, true);
            }
        return triangles;
    }
    std::vector<bool> drawn(const CullResult& list) const {
        std::vector<bool> triangles(scene_.mesh.triangle_count());
        for (const TriangleRange& range : list.ranges)
            for (std::uint32_t i = 0; i < range.triangle_count; ++i)
                triangles[range.first_triangle + i] = true;
        return triangles;
    }

    const ObjectSet scene_ = test::soup(7);
    const std::vector<ObjectId> all_ = all_ids(scene_);
    const SteadyClock clock_{};
    ThreadTeam team_{3, clock_};
};

TEST_F(LeafCullTest, DrawsTheGroupsLeavesThatAreNotOutsideWithEveryAlgorithm) {
    for (const CullAlgorithm algorithm :
         {CullAlgorithm::kWide, CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb}) {
        LeafCull cull = culler(algorithm);
        RandomViews random(1);
        std::size_t partly = 0;
        for (int round = 0; round < 60; ++round) {
            const View view = random.view(scene_);
            const Rect rect = random.rect(view);
            const std::vector<ObjectId> group = round % 2 == 0 ? all_ : some(random);
            const CullResult list = cull.cull(group, view, rect);
            ASSERT_EQ(drawn(list), not_outside(group, view, rect)) << name_of(algorithm) << " " << round;
            partly += list.triangles > 0 && list.triangles < scene_.mesh.triangle_count() / 2 ? 1 : 0;
        }
        EXPECT_GT(partly, 10u);
    }
}

TEST_F(LeafCullTest, DrawsThoseOfAMovingModelAtEveryPoseInAnyOrder) {
    const ObjectSet moving = test::moving_soup(7);
    for (const CullAlgorithm algorithm :
         {CullAlgorithm::kWide, CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb}) {
        LeafCull cull = make_leaf_cull(algorithm, moving, team_);
        RandomViews random(10);
        std::size_t partly = 0;
        std::size_t elsewhere = 0;  // frames for which the boxes of pose 0 would be wrong
        View view = random.posed_view(moving);
        for (int round = 0; round < 90; ++round) {
            const float pose = view.pose;
            view = random.posed_view(moving);
            if (round % 3 == 0) view.pose = pose;
            const Rect rect = random.rect(view);
            const CullResult list = cull.cull(all_ids(moving), view, rect);
            const std::vector<bool> found = drawn(list);
            ASSERT_EQ(found, not_outside(moving, all_ids(moving), view, rect))
                << name_of(algorithm) << " " << round;
            partly += list.triangles > 0 && list.triangles < moving.mesh.triangle_count() / 2 ? 1 : 0;
            View still = view;
            still.pose = 0;
            elsewhere += found != not_outside(moving, all_ids(moving), still, rect) ? 1 : 0;
        }
        EXPECT_GT(partly, 10u);
        EXPECT_GT(elsewhere, 10u);
    }
}

TEST_F(LeafCullTest, DrawsAllOfAMovingModelAtEveryPoseWithNone) {
    const ObjectSet moving = test::moving_soup(7);
    LeafCull cull = make_leaf_cull(CullAlgorithm::kNone, moving, team_);
    RandomViews random(10);
    for (int round = 0; round < 5; ++round) {
        const View view = random.posed_view(moving);
        EXPECT_EQ(cull.cull(all_ids(moving), view, view.viewport()).triangles, moving.mesh.triangle_count());
    }
}

TEST_F(LeafCullTest, KeepsToThatForViewsThatNoCameraHas) {
    constexpr float kOdd[] = {0.0f,
                              1e30f,
                              -1e-41f,
                              std::numeric_limits<float>::max(),
                              std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN()};
    for (const CullAlgorithm algorithm :
         {CullAlgorithm::kWide, CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb}) {
        LeafCull cull = culler(algorithm);
        RandomViews random(9);
        for (int round = 0; round < 70; ++round) {
            View view = random.view(scene_);
            const float odd = kOdd[round % 7];
            if (round < 7)
                view.clip_from_model = glm::mat4(odd);
            else
                for (int i = 0; i < 1 + round / 20; ++i)
                    view.clip_from_model[static_cast<int>(random.below(4))]
                                        [static_cast<int>(random.below(4))] = odd;
            ASSERT_EQ(drawn(cull.cull(all_, view, view.viewport())), not_outside(all_, view, view.viewport()))
                << name_of(algorithm) << " " << round;
        }
    }
}

TEST_F(LeafCullTest, GivesTheSameListWithEveryAlgorithmThatCulls) {
    RandomViews random(2);
    LeafCull wide = culler();
    LeafCull a2ssb = culler(CullAlgorithm::kA2ssb);
    LeafCull adsb = culler(CullAlgorithm::kAdsb);
    for (int round = 0; round < 30; ++round) {
        const View view = random.view(scene_);
        CullResult expected = wide.cull(all_, view, view.viewport());
        for (LeafCull* other : {&a2ssb, &adsb}) {
            const CullResult list = other->cull(all_, view, view.viewport());
            expected.split_level = list.split_level;
            EXPECT_EQ(list, expected);
        }
    }
}

TEST_F(LeafCullTest, CountsWhatItDrawsAndMakesAsFewRunsAsThereCanBe) {
    LeafCull cull = culler();
    RandomViews random(3);
    for (int round = 0; round < 40; ++round) {
        const View view = random.view(scene_);
        const std::vector<ObjectId> group = some(random);
        const CullResult list = cull.cull(group, view, random.rect(view));
        ASSERT_EQ(list.visible.size(), group.size());
        std::vector<std::uint64_t> triangles(scene_.objects.size());
        for (std::size_t i = 0; i < list.ranges.size(); ++i) {
            const TriangleRange& range = list.ranges[i];
            const Object& object = scene_.objects[range.object];
            EXPECT_GE(range.first_triangle, object.first_triangle);
            EXPECT_LE(range.first_triangle + range.triangle_count,
                      object.first_triangle + object.triangle_count);
            triangles[range.object] += range.triangle_count;
            if (i == 0) continue;
            const TriangleRange& before = list.ranges[i - 1];
            const std::uint32_t end = before.first_triangle + before.triangle_count;
            EXPECT_TRUE(end < range.first_triangle ||
                        (end == range.first_triangle && before.object < range.object));
        }
        std::uint64_t sum = 0;
        std::uint64_t objects = 0;
        for (std::size_t i = 0; i < group.size(); ++i) {
            EXPECT_EQ(list.visible[i], triangles[group[i]]);
            sum += triangles[group[i]];
            objects += triangles[group[i]] > 0 ? 1 : 0;
        }
        EXPECT_EQ(list.triangles, sum);
        EXPECT_EQ(list.objects, objects);
        EXPECT_GE(list.leaves, list.ranges.size());
    }
}

TEST_F(LeafCullTest, OfAModelInFullViewIsARunForEachObject) {
    Camera camera;
    camera.target = scene_.bounds.centre();
    camera.eye = camera.target + glm::vec3(0, 0, 2 * glm::length(scene_.bounds.size()));
    camera.fov_y = 1.2f;
    const View view = make_view(camera, 640, 480);
    for (const CullAlgorithm algorithm : kAll) {
        const CullResult list = culler(algorithm).cull(all_, view, view.viewport());
        EXPECT_EQ(list.ranges, whole_objects(scene_.objects, all_));
        EXPECT_EQ(list.leaves, scene_.leaves.size());
        EXPECT_EQ(list.triangles, scene_.mesh.triangle_count());
    }
}

TEST_F(LeafCullTest, CullsNothingWithNone) {
    LeafCull cull = culler(CullAlgorithm::kNone);
    RandomViews random(4);
    for (int round = 0; round < 10; ++round) {
        const View view = random.view(scene_);
        const std::vector<ObjectId> group = some(random);
        const CullResult list = cull.cull(group, view, random.rect(view));
        EXPECT_EQ(list.ranges, whole_objects(scene_.objects, group));
        EXPECT_EQ(list.objects, group.size());
    }
}

TEST_F(LeafCullTest, DrawsNothingOfAnEmptyGroupOrForNoPixels) {
    RandomViews random(5);
    const View view = random.view(scene_);
    for (const CullAlgorithm algorithm : kAll) {
        LeafCull cull = culler(algorithm);
        EXPECT_EQ(cull.cull({}, view, view.viewport()), CullResult{});
        const CullResult nothing = cull.cull(std::vector<ObjectId>{2, 5}, view, {});
        EXPECT_TRUE(nothing.ranges.empty());
        EXPECT_EQ(nothing.visible, (std::vector<std::uint32_t>{0, 0}));
    }
    EXPECT_THROW(
        culler().cull(std::vector{static_cast<ObjectId>(scene_.objects.size())}, view, view.viewport()),
        CheckFailed);
}

// Dropped leaves cover no pixel.

using Polygon = std::vector<glm::dvec4>;

// The part of a polygon in clip space where dot(plane, point) >= 0.
Polygon clip(const Polygon& polygon, const glm::dvec4& plane) {
    Polygon inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec4& a = polygon[i];
        const glm::dvec4& b = polygon[(i + 1) % polygon.size()];
        const double at_a = glm::dot(plane, a);
        const double at_b = glm::dot(plane, b);
        if (at_a >= 0) inside.push_back(a);
        if ((at_a >= 0) != (at_b >= 0)) inside.push_back(glm::mix(a, b, at_a / (at_a - at_b)));
    }
    return inside;
}

// True if a part of the triangle shows in the rectangle; computes in double.
bool shows(const ObjectSet& scene, std::size_t triangle, const View& view, const Rect& rect) {
    Polygon polygon;
    for (std::size_t c = 0; c < 3; ++c)
        polygon.push_back(
            glm::dmat4(view.clip_from_model) *
            glm::dvec4(glm::dvec3(posed(scene.mesh, scene.mesh.indices[3 * triangle + c], view.pose)), 1));
    const auto ndc = [](int pixel, int pixels) { return 2.0 * pixel / pixels - 1; };
    for (const glm::dvec4& plane :
         {glm::dvec4(0, 0, 1, 1), glm::dvec4(0, 0, -1, 1), glm::dvec4(1, 0, 0, -ndc(rect.x0, view.width)),
          glm::dvec4(-1, 0, 0, ndc(rect.x1, view.width)), glm::dvec4(0, 1, 0, -ndc(rect.y0, view.height)),
          glm::dvec4(0, -1, 0, ndc(rect.y1, view.height))})
        polygon = clip(polygon, plane);
    return !polygon.empty();
}

TEST(LeafCullProperty, NoTriangleThatShowsInTheRectangleIsEverDropped) {
    const SteadyClock clock;
    ThreadTeam team(1, clock);
    std::size_t dropped = 0;
    std::size_t shown = 0;
    // Far from the origin single precision has fewer digits for the model.
    for (const glm::vec3& offset : {glm::vec3(0), glm::vec3(-300, 40, 1000), glm::vec3(3e4f, 1e5f, -2e4f)})
        for (const bool moves : {false, true}) {
            const ObjectSet scene = moves ? test::moving_soup(11, offset, 3) : test::soup(11, offset, 3);
            const std::vector<ObjectId> all = all_ids(scene);
            LeafCull cull = make_leaf_cull(CullAlgorithm::kWide, scene, team);
            RandomViews random(6);
            for (int round = 0; round < 40; ++round) {
                const View view = random.posed_view(scene);
                const Rect rect = random.rect(view);
                std::size_t next = 0;
                const auto check_dropped = [&](std::size_t end) {
                    for (; next < end; ++next) {
                        ++dropped;
                        ASSERT_FALSE(shows(scene, next, view, rect)) << "triangle " << next << " in " << rect;
                    }
                };
                for (const TriangleRange& range : cull.cull(all, view, rect).ranges) {
                    check_dropped(range.first_triangle);
                    for (; next < range.first_triangle + range.triangle_count; ++next)
                        shown += shows(scene, next, view, rect) ? 1 : 0;
                }
                check_dropped(scene.mesh.triangle_count());
            }
        }
    EXPECT_GT(dropped, 100'000u);
    EXPECT_GT(shown, 10'000u);
}

// The bounds that partitioners give servers are as safe: a leaf whose bounds lie in a rectangle is never
// dropped for that rectangle.
TEST(LeafCullProperty, NoLeafIsDroppedForItsOwnScreenBounds) {
    for (const glm::vec3& offset : {glm::vec3(0), glm::vec3(3e4f, 1e5f, -2e4f)}) {
        const ObjectSet scene = test::soup(12, offset);
        RandomViews random(7);
        std::size_t seen = 0;
        for (int round = 0; round < 40; ++round) {
            const View view = random.view(scene);
            for (std::size_t i = 0; i < scene.leaves.size(); i += 3) {
                const Rect bounds = screen_bounds(scene.leaves[i].box, view);
                bool in_view = false;
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::dvec4 clip = glm::dmat4(view.clip_from_model) *
                                            glm::dvec4(glm::dvec3(scene.leaves[i].box.corner(corner)), 1);
                    in_view |=
                        std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && std::abs(clip.z) < clip.w;
                }
                if (!in_view) continue;
                ++seen;
                ASSERT_FALSE(outside(make_frustum(view, bounds, scene.bounds), scene.leaves[i].box));
            }
        }
        EXPECT_GT(seen, 500u);
    }
}

}  // namespace
}  // namespace swath
