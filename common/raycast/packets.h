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

// Functions that cast rays into a SAH tree, sixteen at once or one at a time. A KernelTree is a view: tree
// and corners must outlive it. Any number of threads may cast.

// The kernels of an instruction set, which the processor must have.
const PacketKernels& packet_kernels(InstructionSet set);

// Fills `corners` as kernels read them: nine numbers a triangle, and padding behind the last. Kernels square
// numbers as large as coordinates, so those must not be beyond 1e9 (or be scaled).
void kernel_corners(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                    ThreadTeam& team, std::vector<float>& corners);

KernelTree kernel_tree(const SahTree& tree, std::span<const float> corners);

// A ray. Its numbers are finite, and its direction, of any length, is not zero.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};
};
struct RayHit {
    std::uint32_t triangle = 0;
    float distance = 0;  // in units of the direction
    bool operator==(const RayHit&) const = default;
};

// The first hit of a ray; of equally near triangles the one with the smallest number.
std::optional<RayHit> nearest_hit(const PacketKernels& kernels, const KernelTree& tree, const Ray& ray);

// The first hits of up to kPacketRays rays at once.
std::vector<std::optional<RayHit>> nearest_hits(const PacketKernels& kernels, const KernelTree& tree,
                                                std::span<const Ray> rays);

// The first hit, found by testing every triangle without a tree.
std::optional<RayHit> nearest_hit_of_all(const PacketKernels& kernels, std::span<const float> corners,
                                         std::size_t triangles, const Ray& ray);

}  // namespace swath
