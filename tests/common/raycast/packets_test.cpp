#include "common/raycast/packets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/base/check.h"
#include "tests/common/raycast/rays.h"

// A ray of a packet finds the same whatever its companions, its lane and the tree are.

namespace swath {
namespace {

using test::Numbers;
using test::Triangles;

// A ray in the form of the kernels, with the depth that it has at a distance.
struct Cast {
    Ray ray;
    float depth_offset = 1.001f;
};
constexpr float kDepthScale = 0.05f;

struct Found {
    std::uint32_t triangle = kNoTriangle;
    std::array<std::uint32_t, 4> bits{};  // nearness and weights, if there is a triangle
    bool operator==(const Found&) const = default;
};

void put(RayPacket& packet, std::size_t lane, const Cast& cast) {
    for (int axis = 0; axis < 3; ++axis) {
        packet.origin[axis][lane] = cast.ray.origin[axis];
        packet.direction[axis][lane] = cast.ray.direction[axis];
    }
    packet.depth_offset[lane] = cast.depth_offset;
}

Found found(const PacketHits& hits, std::size_t lane) {
    Found one;
    one.triangle = hits.triangle[lane];
    if (one.triangle == kNoTriangle) return one;
    const float values[4] = {hits.nearness[lane], hits.weight[0][lane], hits.weight[1][lane],
                             hits.weight[2][lane]};
    std::memcpy(one.bits.data(), values, sizeof values);
    return one;
}
float nearness(const Found& one) { return std::bit_cast<float>(one.bits[0]); }

RayPacket empty_packet() {
    RayPacket packet{};
    packet.depth_scale = kDepthScale;
    return packet;
}

using Kernel = void (*)(const KernelTree&, const RayPacket&, PacketHits&);

Found cast_alone(Kernel kernel, const KernelTree& tree, const Cast& cast) {
    RayPacket packet = empty_packet();
    // The other lanes are not active, and have direction 0.
    put(packet, 5, cast);
    packet.active = 1u << 5;
    PacketHits hits;
    std::memset(&hits, 0xa5, sizeof hits);
    kernel(tree, packet, hits);
    for (std::size_t lane = 0; lane < kPacketRays; ++lane)
        EXPECT_EQ(hits.triangle[lane] != kNoTriangle && lane != 5, false);
    return found(hits, 5);
}

struct PacketScene {
    explicit PacketScene(Triangles of, const SahSettings& settings = kDefaultSah)
        : triangles(std::move(of)), corners(test::corners_of(triangles)) {
        SahBuilder builder(1);
        sah = test::sah_tree(builder, triangles, settings);
        tree = kernel_tree(sah, corners);
        for (std::uint32_t t = 0; t < triangles.count(); ++t) all.push_back(t);
    }
    // Calls `use` with a tree that has only this triangle, in the box of all.
    template <class Use>
    auto with_only(std::uint32_t triangle, Use use) const {
        const SahNode leaf = SahNode::leaf(triangle, 1);
        KernelTree one = tree;
        one.nodes = reinterpret_cast<const KernelNode*>(&leaf);
        one.triangles = all.data();
        return use(one);
    }
    Triangles triangles;
    std::vector<float> corners;
    SahTree sah;
    KernelTree tree{};
    std::vector<std::uint32_t> all;
};

std::vector<PacketScene> scenes() {
    std::vector<PacketScene> made;
    made.reserve(4);  // a tree points into its scene
    made.emplace_back(test::soup(700, 0.3f, 1));
    made.emplace_back(test::bumpy_sphere(12, 0.4f, 2), kFastSah);
    made.emplace_back(test::grid_of_squares(4));
    // The same twice, from number 600 on.
    Triangles twice = test::soup(300, 0.5f, 3);
    twice.add(test::soup(300, 0.02f, 4));
    twice.add(Triangles(twice));
    made.emplace_back(std::move(twice));
    return made;
}

// Rays with a largest component between 1/2 and 1, as kernels demand (2^-20 to 2^20).
std::vector<Cast> casts(const Triangles& triangles, std::size_t count, std::uint32_t seed) {
    std::vector<Cast> made;
    for (Ray ray : test::rays_at(triangles, count, seed)) {
        const glm::vec3 size = glm::abs(ray.direction);
        int exponent = 0;
        std::frexp(std::max({size.x, size.y, size.z}), &exponent);
        for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = std::ldexp(ray.direction[axis], -exponent);
        made.push_back({ray});
    }
    return made;
}

// Rays from one place, of all directions and with depths of their own.
std::vector<Cast> casts_from(const glm::vec3& eye, std::size_t count, std::uint32_t seed) {
    Numbers numbers(seed);
    std::vector<Cast> made;
    while (made.size() < count) {
        Cast cast{{eye, numbers.point()}, numbers.between(0.9f, 1.1f)};
        if (made.size() % 7 == 0) cast.ray.direction[static_cast<int>(numbers.below(3))] = -0.0f;
        const glm::vec3 size = glm::abs(cast.ray.direction);
        if (std::max({size.x, size.y, size.z}) > 0.01f) made.push_back(cast);
    }
    return made;
}

// Casts packets of any rays of `pool`, in any lanes, some not active: these hold rays or other finite
// numbers.
void expect_independent(Kernel kernel, const KernelTree& tree, const std::vector<Cast>& pool,
                        std::span<const Found> alone, Numbers& numbers, bool one_origin) {
    RayPacket packet = empty_packet();
    std::array<std::uint32_t, kPacketRays> of{};
    for (std::size_t lane = 0; lane < kPacketRays; ++lane) {
        of[lane] = numbers.below(pool.size());
        put(packet, lane, pool[of[lane]]);
        if (numbers.below(3) != 0) {
            packet.active |= 1u << lane;
        } else if (numbers.below(2) == 0) {
            for (int axis = 0; axis < 3; ++axis) {
                if (!one_origin) packet.origin[axis][lane] = 3e38f;
                packet.direction[axis][lane] = numbers.below(2) == 0 ? 0.0f : -3e38f;
            }
            packet.depth_offset[lane] = -3e38f;
        }
    }
    if (numbers.below(4) == 0) {
        for (std::size_t lane = 0; lane < kPacketRays; ++lane) put(packet, lane, pool[of[lane]]);
        packet.active = 0xffff;
    }
    PacketHits hits;
    std::memset(&hits, 0x5a, sizeof hits);
    kernel(tree, packet, hits);
    for (std::size_t lane = 0; lane < kPacketRays; ++lane) {
        const bool active = (packet.active >> lane & 1) != 0;
        ASSERT_EQ(found(hits, lane), active ? alone[of[lane]] : Found{})
            << "lane " << lane << ", ray " << of[lane];
    }
}

class Packets : public testing::TestWithParam<InstructionSet> {
  protected:
    const PacketKernels& kernels_ = packet_kernels(GetParam());
    const std::vector<PacketScene> scenes_ = scenes();
    const glm::vec3 eyes_[4] = {{0.3f, 0.1f, -2.5f}, {0, 0, 0}, {2, 2, 2}, {-1.5f, 0.25f, 0.5f}};
};
INSTANTIATE_TEST_SUITE_P(With, Packets, testing::ValuesIn(instruction_sets()),
                         [](const auto& of) { return std::string(name(of.param)); });

TEST_P(Packets, FindForARayWhatItFindsAlone) {
    Numbers numbers(1);
    for (const PacketScene& scene : scenes_) {
        const std::vector<Cast> pool = casts(scene.triangles, 500, 2);
        std::vector<Found> alone;
        for (const Cast& cast : pool) alone.push_back(cast_alone(kernels_.nearest, scene.tree, cast));
        for (int repeat = 0; repeat < 300 && !HasFatalFailure(); ++repeat)
            expect_independent(kernels_.nearest, scene.tree, pool, alone, numbers, false);
    }
}

TEST_P(Packets, FindByDepthForARayWhatItFindsAlone) {
    Numbers numbers(3);
    for (const PacketScene& scene : scenes_)
        for (const glm::vec3& eye : eyes_) {
            const std::vector<Cast> pool = casts_from(eye, 200, 4);
            std::vector<Found> alone;
            for (const Cast& cast : pool)
                alone.push_back(cast_alone(kernels_.nearest_by_depth, scene.tree, cast));
            for (int repeat = 0; repeat < 150 && !HasFatalFailure(); ++repeat)
                expect_independent(kernels_.nearest_by_depth, scene.tree, pool, alone, numbers, true);
        }
}

TEST_P(Packets, WithoutARayFindNothing) {
    const RayPacket packet = empty_packet();
    for (const Kernel kernel : {kernels_.nearest, kernels_.nearest_by_depth}) {
        PacketHits hits;
        std::memset(&hits, 0, sizeof hits);
        kernel(scenes_[0].tree, packet, hits);
        for (const std::uint32_t triangle : hits.triangle) EXPECT_EQ(triangle, kNoTriangle);
    }
    std::array<std::uint32_t, kPacketRays> but{};
    EXPECT_EQ(kernels_.any(scenes_[0].tree, packet, but.data()), 0u);
}

// Both kinds of nearest find the best of what every triangle alone gives; of equal ones the smallest number.
TEST_P(Packets, FindTheBestOfWhatEachTriangleAloneGives) {
    int hits = 0;
    const auto expect_best = [&hits](Kernel kernel, const PacketScene& scene, const std::vector<Cast>& pool) {
        for (const Cast& cast : pool) {
            Found best;
            for (const std::uint32_t t : scene.all) {
                const Found one = scene.with_only(
                    t, [&](const KernelTree& tree) { return cast_alone(kernel, tree, cast); });
                if (one.triangle == kNoTriangle) continue;
                ASSERT_EQ(one.triangle, t);
                if (best.triangle == kNoTriangle || nearness(one) < nearness(best)) best = one;
            }
            ASSERT_EQ(cast_alone(kernel, scene.tree, cast), best);
            hits += best.triangle != kNoTriangle ? 1 : 0;
        }
    };
    for (const PacketScene& scene : scenes_) {
        expect_best(kernels_.nearest, scene, casts(scene.triangles, 130, 5));
        if (HasFatalFailure()) return;
        for (const glm::vec3& eye : eyes_)
            expect_best(kernels_.nearest_by_depth, scene, casts_from(eye, 60, 6));
    }
    EXPECT_GT(hits, 100);
}

// Nothing is found before depth 0, or from depth 1 on.
TEST_P(Packets, FindNothingOutsideOfDepths) {
    const PacketScene& scene = scenes_[0];
    for (const Cast& cast : casts_from({0, 0, 0}, 300, 7)) {
        const Found one = cast_alone(kernels_.nearest_by_depth, scene.tree, cast);
        if (one.triangle == kNoTriangle) continue;
        EXPECT_GE(nearness(one), 0);
        EXPECT_LT(nearness(one), 1);
        const Found by_distance = scene.with_only(
            one.triangle, [&](const KernelTree& tree) { return cast_alone(kernels_.nearest, tree, cast); });
        ASSERT_EQ(by_distance.triangle, one.triangle);
        EXPECT_NEAR(nearness(one), cast.depth_offset - kDepthScale / nearness(by_distance), 1e-6);
    }
}

TEST_P(Packets, FindAnyWhereThereIsOneButTheirOwn) {
    Numbers numbers(8);
    for (const PacketScene& scene : scenes_) {
        const std::vector<Cast> pool = casts(scene.triangles, 160, 9);
        // The triangles that each ray hits at all.
        std::vector<std::vector<std::uint32_t>> hit(pool.size());
        for (std::size_t i = 0; i < pool.size(); ++i)
            for (const std::uint32_t t : scene.all) {
                const auto alone = [&](const KernelTree& tree) {
                    return cast_alone(kernels_.nearest, tree, pool[i]);
                };
                if (scene.with_only(t, alone).triangle != kNoTriangle) hit[i].push_back(t);
            }
        int both[2] = {};
        for (int repeat = 0; repeat < 200; ++repeat) {
            RayPacket packet = empty_packet();
            packet.active = numbers.below(1u << kPacketRays);
            std::array<std::uint32_t, kPacketRays> but{};
            std::array<std::uint32_t, kPacketRays> of{};
            for (std::size_t lane = 0; lane < kPacketRays; ++lane) {
                of[lane] = numbers.below(pool.size());
                put(packet, lane, pool[of[lane]]);
                const auto& own = hit[of[lane]];
                but[lane] =
                    own.empty() || numbers.below(3) == 0 ? kNoTriangle : own[numbers.below(own.size())];
            }
            const std::uint32_t any = kernels_.any(scene.tree, packet, but.data());
            for (std::size_t lane = 0; lane < kPacketRays; ++lane) {
                const auto& own = hit[of[lane]];
                const bool expected =
                    (packet.active >> lane & 1) != 0 &&
                    std::ranges::any_of(own, [&](std::uint32_t t) { return t != but[lane]; });
                ASSERT_EQ((any >> lane & 1) != 0, expected) << "lane " << lane << ", ray " << of[lane];
                ++both[expected ? 1 : 0];
            }
        }
        EXPECT_GT(both[0], 100);
        EXPECT_GT(both[1], 100);
    }
}

TEST_P(Packets, FindTheSameWhenTheyCount) {
    for (const PacketScene& scene : scenes_) {
        PacketWork work;
        std::uint64_t calls = 0;
        for (const Cast& cast : casts(scene.triangles, 100, 10)) {
            RayPacket packet = empty_packet();
            put(packet, 3, cast);
            packet.active = 1u << 3;
            PacketHits hits;
            kernels_.count(scene.tree, packet, hits, work);
            ++calls;
            ASSERT_EQ(found(hits, 3), cast_alone(kernels_.nearest, scene.tree, cast));
        }
        EXPECT_EQ(work.packets, calls);
        EXPECT_EQ(work.ray_steps, work.steps);  // of one ray
        EXPECT_GT(work.leaves, 0u);
        EXPECT_GT(work.triangles, 0u);
        EXPECT_LT(work.triangles, calls * scene.triangles.count() / 2);
    }
}

TEST_P(Packets, CanBeOfAnyLengthOfDirection) {
    const PacketScene& scene = scenes_[0];
    for (const Cast& cast : casts(scene.triangles, 100, 11)) {
        const auto once = nearest_hit(kernels_, scene.tree, cast.ray);
        for (const int exponent : {-60, -3, 1, 90}) {
            Ray scaled = cast.ray;
            // Skips rays whose tiny components would lose digits.
            bool exact = true;
            for (int axis = 0; axis < 3; ++axis) {
                scaled.direction[axis] = std::ldexp(cast.ray.direction[axis], exponent);
                exact = exact && std::ldexp(scaled.direction[axis], -exponent) == cast.ray.direction[axis];
            }
            if (!exact) continue;
            const auto hit = nearest_hit(kernels_, scene.tree, scaled);
            ASSERT_EQ(hit.has_value(), once.has_value());
            if (!hit) continue;
            EXPECT_EQ(hit->triangle, once->triangle);
            EXPECT_EQ(hit->distance, std::ldexp(once->distance, -exponent));
        }
    }
    EXPECT_THROW(nearest_hit(kernels_, scene.tree, {{0, 0, 0}, {0, 0, 0}}), CheckFailed);
    EXPECT_THROW(nearest_hit(kernels_, scene.tree, {{0, 0, 0}, {0, INFINITY, 0}}), CheckFailed);
}

}  // namespace
}  // namespace swath
