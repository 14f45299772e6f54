#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/base/instruction_set.h"
#include "common/base/thread_team.h"
#include "common/octree/sah/sah_tree.h"
#include "common/raycast/packet_kernel.h"

namespace swath {

// Casting rays into a SAH tree, sixteen at once or one at a time. Everything here is a view: tree and corners
// must outlive it. Any number of threads may cast.

// The kernels for an instruction set, or the best one of those that the processor has.
const PacketKernels& packet_kernels(InstructionSet set);

// The corners of triangles as kernels read them: nine numbers a triangle, and some behind the last one that
// are not read as corners. Kernels square what is as large as a coordinate, so coordinates must not be beyond
// 1e9 (or scaled).
void kernel_corners(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                    ThreadTeam& team, std::vector<float>& corners);

KernelTree kernel_tree(const SahTree& tree, std::span<const float> corners);

// A ray from `origin`, in any direction that is not zero, of finite numbers.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};
};
struct RayHit {
    std::uint32_t triangle = 0;
    float distance = 0;  // in units of the direction
    bool operator==(const RayHit&) const = default;
};

// What the ray hits first, of equally near triangles the one with the smallest number.
std::optional<RayHit> nearest_hit(const PacketKernels& kernels, const KernelTree& tree, const Ray& ray);

// The same for up to kPacketRays rays at once: a hit each.
std::vector<std::optional<RayHit>> nearest_hits(const PacketKernels& kernels, const KernelTree& tree,
                                                std::span<const Ray> rays);

// By testing every triangle, without a tree.
std::optional<RayHit> nearest_hit_of_all(const PacketKernels& kernels, std::span<const float> corners,
                                         std::size_t triangles, const Ray& ray);

}  // namespace swath
