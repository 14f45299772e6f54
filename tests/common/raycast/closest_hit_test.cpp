#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "common/base/instruction_set.h"
#include "common/published/octree/sah_kd_tree.h"
#include "common/scene/model.h"
#include "tests/common/raycast/rays.h"
#include "tests/support/models.h"

// The first hit of a ray is the nearest of all triangles: by the same arithmetic without a tree, to the bit,
// and by exact geometry as far as single precision can tell.

namespace swath {
namespace {

using test::NamedSettings;
using test::Triangles;
using test::TriangleSet;

using Hits = std::vector<std::optional<RayHit>>;

Hits hits_of_all(const PacketKernels& kernels, const Triangles& triangles, std::span<const Ray> rays) {
    const std::vector<float> corners = test::corners_of(triangles);
    Hits hits;
    for (const Ray& ray : rays) hits.push_back(nearest_hit_of_all(kernels, corners, triangles.count(), ray));
    return hits;
}

// In packets, in the rays' order.
Hits hits_in(const PacketKernels& kernels, const SahTree& tree, std::span<const float> corners,
             std::span<const Ray> rays) {
    const KernelTree kernel = kernel_tree(tree, corners);
    Hits hits;
    for (std::size_t i = 0; i < rays.size(); i += kPacketRays) {
        const Hits some = nearest_hits(kernels, kernel,
                                       rays.subspan(i, std::min<std::size_t>(kPacketRays, rays.size() - i)));
        hits.insert(hits.end(), some.begin(), some.end());
    }
    return hits;
}

std::string differences(const Hits& found, const Hits& expected, std::span<const Ray> rays) {
    std::string text;
    int count = 0;
    const auto say = [](const std::optional<RayHit>& hit) {
        return hit ? fmt::format("triangle {} at {}", hit->triangle, hit->distance) : "nothing";
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (found[i] == expected[i] || ++count > 3) continue;
        const Ray& ray = rays[i];
        text += fmt::format("\nray {} from {:a} {:a} {:a} along {:a} {:a} {:a}: {}, not {}", i, ray.origin.x,
                            ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
                            say(found[i]), say(expected[i]));
    }
    return count == 0 ? "" : fmt::format("{} of {} rays:{}", count, rays.size(), text);
}

class ClosestHit : public testing::TestWithParam<std::size_t> {
  protected:
    const TriangleSet& set_ = test::triangle_sets()[GetParam()];
    const Triangles& triangles_ = set_.triangles;
    const std::vector<Ray> rays_ = test::rays_at(triangles_, 520, 77);
    const Hits expected_ = hits_of_all(portable::kPacketKernels, triangles_, rays_);
};

std::string name_of_set(const testing::TestParamInfo<std::size_t>& info) {
    std::string name = test::triangle_sets()[info.param].name;
    std::ranges::replace(name, ' ', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Of, ClosestHit, testing::Range(std::size_t{0}, test::triangle_sets().size()),
                         name_of_set);

TEST_P(ClosestHit, OfAllTrianglesIsTheSameForEveryInstructionSet) {
    for (const InstructionSet set : instruction_sets())
        EXPECT_EQ(differences(hits_of_all(packet_kernels(set), triangles_, rays_), expected_, rays_), "")
            << name(set);
}

TEST_P(ClosestHit, InATreeIsThatOfAllTriangles) {
    const std::vector<float> corners = test::corners_of(triangles_);
    SahBuilder builder(2);
    for (const NamedSettings& named : test::sah_settings()) {
        const SahTree tree = test::sah_tree(builder, triangles_, named.settings);
        for (const InstructionSet set : instruction_sets())
            EXPECT_EQ(differences(hits_in(packet_kernels(set), tree, corners, rays_), expected_, rays_), "")
                << named.name << ", " << name(set);
    }
    for (const float traversal : {3.0f, 0.2f}) {
        SahSettings settings = kDefaultSah;
        settings.traversal_cost = traversal;
        const auto tree = build_sah_kd_tree(triangles_.view(), settings);
        ASSERT_TRUE(tree.has_value());
        for (const InstructionSet set : instruction_sets())
            EXPECT_EQ(differences(hits_in(packet_kernels(set), *tree, corners, rays_), expected_, rays_), "")
                << "kd-tree, " << name(set);
    }
}

// A triangle seen along a ray, in double precision, by the axis along which the ray is longest, and the error
// of single precision. The kernels compute, with e = 2^-24 the relative error of an operation and R the
// largest component of corner - origin, for a corner's position beside the ray (|shear| <= 1):
//   corner - origin: R e; shear: two divisions or products, 2 e R; times z: e R, and z's own R e; the
//   difference of two numbers up to R: 2 R e. Seven in all: h = 8 R e is more.
// An edge function b x c then is off by h (|b| + |c|) twice over (both components), h^2 twice, and by its own
// three operations, 2 e (|bx cy| + |by cx|). Beyond that its sign is certain. Products of distances below
// 1e-19 may vanish, so 1e-44 is added.
struct Seen {
    bool certain_hit = false;
    bool certain_miss = false;
    double distance = 0;      // if there is an area
    double distance_off = 0;  // the most by which a kernel's may differ
    double beside = 0;        // distance of the ray from the box around the projected triangle
    double rounding = 0;      // h
};
Seen see(const Triangles& triangles, std::size_t triangle, const Ray& ray) {
    constexpr double kE = 0x1p-24;
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 size = glm::abs(direction);
    const int kz = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const int kx = (kz + 1) % 3;
    const int ky = (kz + 2) % 3;
    std::array<glm::dvec3, 3> corner;
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 at = glm::dvec3(triangles.corner(triangle, k)) - glm::dvec3(ray.origin);
        reach = std::max({reach, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        corner[k] = {at[kx] - direction[kx] / direction[kz] * at[kz],
                     at[ky] - direction[ky] / direction[kz] * at[kz], at[kz] / direction[kz]};
    }
    Seen seen;
    const double h = 8 * kE * reach + 1e-44;
    seen.rounding = h;
    int above = 0;
    int below = 0;
    double sum = 0;
    double sum_off = 0;
    double weighted = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& b = corner[(k + 1) % 3];
        const glm::dvec3& c = corner[(k + 2) % 3];
        const double edge = c.x * b.y - c.y * b.x;
        const double off = h * (std::abs(b.x) + std::abs(b.y) + std::abs(c.x) + std::abs(c.y)) + 2 * h * h +
                           2 * kE * (std::abs(c.x * b.y) + std::abs(c.y * b.x)) + 1e-44;
        above += edge > off ? 1 : 0;
        below += edge < -off ? 1 : 0;
        sum += edge;
        sum_off += off;
        weighted += edge * corner[k].z;
    }
    seen.certain_hit = above == 3 || below == 3;
    seen.certain_miss = above > 0 && below > 0;
    for (const int axis : {0, 1}) {
        const auto [low, high] = std::minmax({corner[0][axis], corner[1][axis], corner[2][axis]});
        seen.beside = std::max({seen.beside, low, -high});
    }
    // A distance is a mean of the corners', weighted by edge functions. Each weight is off by its share of
    // sum_off; a few more operations follow on numbers as large as the farthest corner.
    const auto [near, far] = std::minmax({corner[0].z, corner[1].z, corner[2].z});
    const double area = std::abs(sum);
    const double share = area > 2 * sum_off ? std::min(1.0, 2 * sum_off / (area - sum_off)) : 1.0;
    seen.distance = area > 2 * sum_off ? weighted / sum : 0.5 * (near + far);
    seen.distance_off = share * (far - near) + 16 * kE * std::max(std::abs(near), std::abs(far)) +
                        h / std::abs(direction[kz]);
    return seen;
}

TEST_P(ClosestHit, IsWhatExactGeometrySays) {
    std::size_t certain = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        const Ray& ray = rays_[i];
        const auto& hit = expected_[i];
        SCOPED_TRACE(fmt::format("ray {}", i));
        bool any_unclear = false;
        for (std::size_t t = 0; t < triangles_.count(); ++t) {
            const Seen seen = see(triangles_, t, ray);
            any_unclear = any_unclear || (!seen.certain_hit && !seen.certain_miss);
            const double nearest = seen.distance - seen.distance_off;
            const double farthest = seen.distance + seen.distance_off;
            if (seen.certain_hit && nearest > 0) {
                ASSERT_TRUE(hit && static_cast<double>(hit->distance) <= farthest)
                    << "triangle " << t << " at " << seen.distance << " is missed";
            }
            if (!hit || hit->triangle != t) continue;
            ASSERT_FALSE(seen.certain_miss) << "triangle " << t;
            ASSERT_LE(seen.beside, seen.rounding) << "triangle " << t << " is elsewhere";
            ASSERT_NEAR(static_cast<double>(hit->distance), seen.distance, seen.distance_off)
                << "triangle " << t;
        }
        certain += any_unclear ? 0 : 1;
    }
    RecordProperty("certain",
                   std::to_string(static_cast<double>(certain) / static_cast<double>(rays_.size())));
    // Most rays are certain if they are not aimed at edges: so this test does say something.
    if (set_.name == "small" || set_.name == "large") {
        test::Numbers numbers(5);
        std::size_t clear = 0;
        for (int i = 0; i < 200; ++i) {
            const Ray ray{numbers.point(), numbers.point()};
            bool unclear = false;
            for (std::size_t t = 0; t < triangles_.count(); ++t) {
                const Seen seen = see(triangles_, t, ray);
                unclear = unclear || (!seen.certain_hit && !seen.certain_miss);
            }
            clear += unclear ? 0 : 1;
        }
        EXPECT_GT(clear, 190u);
    }
}

// From inside of a closed surface every ray hits, at corners and edges, too.
TEST(ClosedSurface, LetsNoRayOut) {
    SahBuilder builder(2);
    const std::vector<std::pair<std::string, Triangles>> surfaces{
        {"sphere", test::bumpy_sphere(24, 0, 1)},
        {"bumpy sphere", test::bumpy_sphere(40, 0.5f, 2)},
        {"far away", test::moved(test::bumpy_sphere(30, 0.3f, 3), 1, {3000, -100, 77})},
        {"tiny", test::moved(test::bumpy_sphere(30, 0.3f, 4), 1e-8f)},
        {"huge", test::moved(test::bumpy_sphere(30, 0.3f, 5), 1e8f)}};
    for (const auto& [name, surface] : surfaces) {
        const Box box = surface.box();
        const glm::vec3 centre = box.centre();
        const float radius = 0.1f * box.size().x / 2;
        test::Numbers numbers(6);
        std::vector<Ray> rays;
        for (std::size_t t = 0; t < surface.count(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3 from = centre + radius * numbers.point();
                const glm::vec3& a = surface.corner(t, k);
                const glm::vec3& b = surface.corner(t, (k + 1) % 3);
                rays.push_back({from, a - from});
                rays.push_back({from, 0.5f * (a + b) - from});
                rays.push_back({from, a + numbers.fraction() * (b - a) - from});
                rays.push_back({from, numbers.point()});
                // Along an axis, exactly at a corner.
                for (int axis = 0; axis < 3; ++axis) {
                    Ray ray{a, glm::vec3(0)};
                    ray.origin[axis] = centre[axis];
                    ray.direction[axis] = a[axis] < centre[axis] ? -1.0f : 1.0f;
                    if (glm::length(ray.origin - centre) < 2 * radius) rays.push_back(ray);
                }
            }
        const std::vector<float> corners = test::corners_of(surface);
        for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
            const SahTree tree = test::sah_tree(builder, surface, settings);
            for (const InstructionSet set : instruction_sets()) {
                const Hits hits = hits_in(packet_kernels(set), tree, corners, rays);
                EXPECT_EQ(std::ranges::count(hits, std::optional<RayHit>()), 0) << name;
            }
        }
    }
}

// Of equal hits the smallest number wins.
TEST(ClosestHitOfEquals, IsTheSmallestTriangle) {
    Triangles pile;
    for (int i = 0; i < 100; ++i) pile.add({-1, -1, 2}, {3, -1, 2}, {-1, 3, 2});
    // Even if the pile is cut apart: these triangles make planes worth while.
    for (int i = 0; i < 200; ++i) {
        const float at = 3 + 0.01f * static_cast<float>(i);
        pile.add({at, 0, 5}, {at + 0.005f, 0, 5}, {at, 0.005f, 5.5f});
    }
    SahBuilder builder(1);
    const std::vector<float> corners = test::corners_of(pile);
    for (const NamedSettings& named : test::sah_settings()) {
        const SahTree tree = test::sah_tree(builder, pile, named.settings);
        for (const InstructionSet set : instruction_sets()) {
            const auto hit = nearest_hit(packet_kernels(set), kernel_tree(tree, corners),
                                         {{0.1f, 0.2f, -3}, {0.01f, 0, 1}});
            EXPECT_EQ(hit, (RayHit{0, 5})) << named.name;
        }
    }
}

// The real models: the Conference has 53,627 triangles without area.
void expect_nearest_of_all(const std::string& path) {
    const auto mesh = load_model(path);
    ASSERT_TRUE(mesh.has_value());
    Triangles triangles;
    for (const Vertex& vertex : mesh->vertices) triangles.positions.push_back(vertex.position);
    triangles.indices = mesh->indices;
    const std::vector<Ray> rays = test::rays_at(triangles, 260, 7);
    const PacketKernels& kernels = packet_kernels(best_instruction_set());
    const Hits expected = hits_of_all(kernels, triangles, rays);
    EXPECT_GT(std::ranges::count_if(expected, [](const auto& hit) { return hit.has_value(); }), 50);
    const std::vector<float> corners = test::corners_of(triangles);
    SahBuilder builder(2);
    for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
        const SahTree tree = test::sah_tree(builder, triangles, settings);
        for (const InstructionSet set : instruction_sets())
            EXPECT_EQ(differences(hits_in(packet_kernels(set), tree, corners, rays), expected, rays), "");
    }
}
TEST(ClosestHitOfModels, IsThatOfAllTrianglesOfTheBunny) {
    SWATH_SHARED_MODEL(path, "bunny.ply");
    expect_nearest_of_all(path);
}
TEST(ClosestHitOfModels, IsThatOfAllTrianglesOfTheConference) {
    SWATH_SHARED_MODEL(path, "conference.ply");
    expect_nearest_of_all(path);
}
TEST(ClosestHitOfModels, IsThatOfAllTrianglesOfBuiltins) {
    for (const char* model : {"town:40000", "spheres:40000", "hand:40000"}) {
        SCOPED_TRACE(model);
        expect_nearest_of_all("builtin:" + std::string(model));
    }
}

}  // namespace
}  // namespace swath
