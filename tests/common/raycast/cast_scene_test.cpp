#include "common/raycast/cast_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/raycast/packets.h"
#include "common/scene/procedural.h"
#include "tests/common/raycast/rays.h"
#include "tests/support/models.h"

namespace swath {
namespace {

using test::Numbers;
using test::Triangles;

// The mesh as a CastScene has it.
Triangles scaled(const Mesh& mesh, float scale, float pose = 0) {
    Triangles triangles;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
        triangles.positions.push_back(posed(mesh, v, pose) * scale);
    triangles.indices = mesh.indices;
    return triangles;
}

std::vector<TriangleRange> some_runs(const ObjectSet& scene, Numbers& numbers) {
    std::vector<TriangleRange> ranges;
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        if (numbers.below(3) == 0) continue;
        // The whole object, or pieces of it.
        const bool whole = numbers.below(2) == 0;
        std::uint32_t first = object.first_triangle;
        const std::uint32_t end = first + object.triangle_count;
        while (first < end) {
            const std::uint32_t count = whole ? end - first : std::min(end - first, 1 + numbers.below(40));
            if (whole || numbers.below(2) == 0) ranges.push_back({id, first, count});
            first += count;
        }
    }
    return ranges;
}

using Hits = std::vector<std::optional<RayHit>>;
Hits hits_in(const KernelTree& tree, const std::vector<Ray>& rays) {
    Hits hits;
    for (const Ray& ray : rays)
        hits.push_back(nearest_hit(packet_kernels(best_instruction_set()), tree, ray));
    return hits;
}

class CastSceneTest : public testing::Test {
  protected:
    const ObjectSet scene_ = build_objects(test::triangle_soup(2500, 3), {3, 0});
    SteadyClock clock_;
    ThreadTeam two_{2, clock_};
    CastScene cast_{scene_, two_, SahDevice::kThreads};
    std::vector<Ray> rays(std::uint32_t seed, float pose = 0) const {
        return test::rays_at(scaled(scene_.mesh, cast_.scale(), pose), 400, seed);
    }
};

TEST_F(CastSceneTest, IsScaledByAPowerOfTwoToAtMostOne) {
    for (const float size : {1e-30f, 1e-3f, 0.7f, 1.0f, 1e9f, 1e17f}) {
        const ObjectSet cube = build_objects(test::cube(size), {1, 0});
        const CastScene cast(cube, two_, SahDevice::kThreads);
        int exponent = 0;
        EXPECT_EQ(std::frexp(cast.scale(), &exponent), 0.5f);
        EXPECT_LE(cast.scale() * size, 1.0f);
        EXPECT_GE(cast.scale() * size, 0.25f);
        for (std::uint32_t t = 0; t < 12; ++t)
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(
                    cast.corner(t, k),
                    cast.scale() *
                        cube.mesh.vertices[cube.mesh.indices[3 * t + static_cast<unsigned>(k)]].position);
    }
}

// A tree over all that is limited to the wanted triangles finds the same as a tree over these alone.
TEST_F(CastSceneTest, WantedFindsWhatATreeOfThatFinds) {
    Numbers numbers(4);
    CastScene part(scene_, two_, SahDevice::kThreads);
    for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
        ASSERT_TRUE(cast_.build_all(settings).has_value());
        for (int repeat = 0; repeat < 12; ++repeat) {
            const std::vector<TriangleRange> ranges = some_runs(scene_, numbers);
            ASSERT_TRUE(part.build(ranges, settings).has_value());
            cast_.want(ranges);
            const std::vector<Ray> some = rays(numbers.below(1000));
            const Hits hits = hits_in(cast_.wanted(), some);
            EXPECT_EQ(hits, hits_in(part.wanted(), some));
            EXPECT_EQ(hits, hits_in(part.all(), some));
            // Brute force finds it, too.
            Triangles wanted = scaled(scene_.mesh, cast_.scale());
            wanted.indices.clear();
            std::vector<std::uint32_t> numbers_of;
            for (const TriangleRange& range : ranges)
                for (std::uint32_t t = range.first_triangle; t < range.first_triangle + range.triangle_count;
                     ++t) {
                    numbers_of.push_back(t);
                    for (std::uint32_t k = 0; k < 3; ++k)
                        wanted.indices.push_back(scene_.mesh.indices[3 * t + k]);
                }
            const std::vector<float> corners = test::corners_of(wanted);
            for (std::size_t i = 0; i < some.size(); ++i) {
                auto hit = nearest_hit_of_all(portable::kPacketKernels, corners, wanted.count(), some[i]);
                if (hit) hit->triangle = numbers_of[hit->triangle];
                ASSERT_EQ(hit, hits[i]) << i;
            }
        }
    }
}

TEST_F(CastSceneTest, WantingAllOrOtherThingsBeforeChangesNothing) {
    ASSERT_TRUE(cast_.build_all(kDefaultSah).has_value());
    const std::vector<Ray> some = rays(5);
    const Hits everything = hits_in(cast_.all(), some);
    const std::vector<TriangleRange> one{{0, scene_.objects[0].first_triangle, 1}};
    std::vector<TriangleRange> all;
    for (ObjectId id = 0; id < scene_.objects.size(); ++id)
        all.push_back({id, scene_.objects[id].first_triangle, scene_.objects[id].triangle_count});
    cast_.want(one);
    EXPECT_NE(hits_in(cast_.wanted(), some), everything);
    EXPECT_EQ(hits_in(cast_.all(), some), everything);
    const Hits of_one = hits_in(cast_.wanted(), some);
    cast_.want(all);
    EXPECT_EQ(hits_in(cast_.wanted(), some), everything);
    cast_.want(one);
    EXPECT_EQ(hits_in(cast_.wanted(), some), of_one);
    cast_.want({});
    EXPECT_EQ(std::ranges::count(hits_in(cast_.wanted(), some), std::optional<RayHit>()),
              static_cast<std::ptrdiff_t>(some.size()));
}

TEST_F(CastSceneTest, WithoutTrianglesIsAnError) {
    const Status status = cast_.build({}, kDefaultSah);
    ASSERT_FALSE(status.has_value());
    EXPECT_NE(status.error().message.find("ray caster"), std::string::npos);
}

TEST(MovingCastScene, IsWhereItsTrianglesAreAtAPose) {
    const ObjectSet scene = build_objects(*make_builtin("swarm", 3000), {3, 0});
    ASSERT_TRUE(scene.moves());
    const SteadyClock clock;
    ThreadTeam two(2, clock);
    CastScene cast(scene, two, SahDevice::kThreads);
    for (const float pose : {0.0f, 0.25f, 1.0f, 1.0f / 3, 0.0f}) {
        cast.pose(pose);
        ASSERT_TRUE(cast.build_all(kDefaultSah).has_value());
        const Triangles triangles = scaled(scene.mesh, cast.scale(), pose);
        const std::vector<float> corners = test::corners_of(triangles);
        const std::vector<Ray> rays = test::rays_at(triangles, 200, 6);
        Hits expected;
        for (const Ray& ray : rays)
            expected.push_back(nearest_hit_of_all(portable::kPacketKernels, corners, triangles.count(), ray));
        EXPECT_EQ(hits_in(cast.wanted(), rays), expected) << pose;
    }
}

// So many triangles that a team shares the work.
TEST(MovingCastScene, IsTheSameForAnyTeam) {
    const ObjectSet scene = build_objects(*make_builtin("swarm", 60'000), {3, 0});
    const SteadyClock clock;
    ThreadTeam alone(1, clock);
    ThreadTeam five(5, clock);
    CastScene one(scene, alone, SahDevice::kThreads);
    CastScene other(scene, five, SahDevice::kThreads);
    Numbers numbers(8);
    for (const float pose : {0.0f, 0.7f}) {
        for (CastScene* cast : {&one, &other}) {
            cast->pose(pose);
            ASSERT_TRUE(cast->build_all(kFastSah).has_value());
        }
        for (std::uint32_t t = 0; t < scene.mesh.triangle_count(); ++t)
            for (int k = 0; k < 3; ++k) ASSERT_EQ(one.corner(t, k), other.corner(t, k));
        const std::vector<TriangleRange> ranges = some_runs(scene, numbers);
        one.want(ranges);
        other.want(ranges);
        const auto rays = test::rays_at(scaled(scene.mesh, one.scale(), pose), 2000, 9);
        const Hits hits = hits_in(one.wanted(), rays);
        EXPECT_NE(hits, hits_in(one.all(), rays));
        EXPECT_EQ(hits, hits_in(other.wanted(), rays));
    }
}

}  // namespace
}  // namespace swath
