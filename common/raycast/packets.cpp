#include "common/raycast/packets.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/parts.h"

namespace swath {
namespace {

static_assert(sizeof(KernelNode) == sizeof(SahNode));

// Fewer are not worth a thread.
constexpr std::size_t kLeastCorners = 1u << 14;

// Adds a ray to a packet. Scales its direction by a power of two, which changes no digit, to a largest
// component of 1/2 to 1. Returns the factor for distances in the packet.
float put(RayPacket& packet, int lane, const Ray& ray) {
    const glm::vec3 size = glm::abs(ray.direction);
    const float largest = std::max({size.x, size.y, size.z});
    CHECK(largest > 0.0f);
    CHECK(std::isfinite(largest) == true);
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (int axis = 0; axis < 3; ++axis) {
        packet.origin[axis][lane] = ray.origin[axis];
        packet.direction[axis][lane] = std::ldexp(ray.direction[axis], -exponent);
    }
    packet.active |= 1u << lane;
    return std::ldexp(1.0f, -exponent);
}

}  // namespace

const PacketKernels& packet_kernels(InstructionSet set) {
    CHECK((std::ranges::find(instruction_sets(), set) != instruction_sets().end()) == true);
#if defined(__x86_64__)
    if (set == InstructionSet::kAvx512) return avx512::kPacketKernels;
    if (set == InstructionSet::kAvx2) return avx2::kPacketKernels;
#endif
    return portable::kPacketKernels;
}

void kernel_corners(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                    ThreadTeam& team, std::vector<float>& corners) {
    corners.resize(3 * indices.size() + kPacketRays);
    const std::size_t parts = parts_for(indices.size(), kLeastCorners, team);
    run_parts(team, parts, [&](std::size_t index) {
        const Part part = part_of(indices.size(), parts, index);
        for (std::size_t i = part.begin; i < part.end; ++i)
            for (int axis = 0; axis < 3; ++axis)
                corners[3 * i + static_cast<std::size_t>(axis)] = positions[indices[i]][axis];
    });
}

KernelTree kernel_tree(const SahTree& tree, std::span<const float> corners) {
    KernelTree kernel{};
    kernel.nodes = reinterpret_cast<const KernelNode*>(tree.nodes.data());
    kernel.triangles = tree.triangles.data();
    kernel.corners = corners.data();
    for (int axis = 0; axis < 3; ++axis) {
        kernel.low[axis] = tree.box.min[axis];
        kernel.high[axis] = tree.box.max[axis];
    }
    return kernel;
}

std::vector<std::optional<RayHit>> nearest_hits(const PacketKernels& kernels, const KernelTree& tree,
                                                std::span<const Ray> rays) {
    CHECK(rays.size() <= std::size_t{kPacketRays});
    RayPacket packet{};
    for (auto& direction : packet.direction) std::fill(std::begin(direction), std::end(direction), 1.0f);
    std::array<float, kPacketRays> scales{};
    for (std::size_t i = 0; i < rays.size(); ++i) scales[i] = put(packet, static_cast<int>(i), rays[i]);
    PacketHits hits{};
    kernels.nearest(tree, packet, hits);
    std::vector<std::optional<RayHit>> result(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits.triangle[i] != kNoTriangle)
            result[i] = RayHit{hits.triangle[i], hits.nearness[i] * scales[i]};
    return result;
}

std::optional<RayHit> nearest_hit(const PacketKernels& kernels, const KernelTree& tree, const Ray& ray) {
    return nearest_hits(kernels, tree, {&ray, 1}).front();
}

std::optional<RayHit> nearest_hit_of_all(const PacketKernels& kernels, std::span<const float> corners,
                                         std::size_t triangles, const Ray& ray) {
    if (triangles == 0) return std::nullopt;
    std::vector<std::uint32_t> all(triangles);
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    const SahNode leaf = SahNode::leaf(0, static_cast<std::uint32_t>(triangles));
    KernelTree tree{};
    tree.nodes = reinterpret_cast<const KernelNode*>(&leaf);
    tree.triangles = all.data();
    tree.corners = corners.data();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        tree.low[axis] = tree.high[axis] = corners[axis];
        for (std::size_t i = axis; i < 9 * triangles; i += 3) {
            tree.low[axis] = std::min(tree.low[axis], corners[i]);
            tree.high[axis] = std::max(tree.high[axis], corners[i]);
        }
    }
    return nearest_hit(kernels, tree, ray);
}

}  // namespace swath
