#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/instruction_set.h"
#include "common/base/sharing.h"
#include "common/base/thread_team.h"
#include "common/cull/wide/id_slots.h"
#include "common/geometry/frustum.h"
#include "common/published/cull/octree_kernel.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// Finds the leaves of a uniform octree that a frustum does not miss, 16 nodes at once and without a stored
// tree, to be compared with the published algorithms (ADSB, A2SSB). Both calls give exactly the codes of the
// leaves that are not outside(frustum, shape.box_of(height, code)), ascending. Frusta are in the octree's
// coordinates, where a leaf's edge is 1.
//
// One thread at a time. The team must outlive it and be idle when it is called; it takes part if that pays
// (see sharing.h). It reserves places for all codes, of which only those written cost memory.
class WideOctree {
  public:
    WideOctree(const UniformOctree& shape, ThreadTeam& team,
               InstructionSet instructions = best_instruction_set(),
               SharingMode mode = SharingMode::kWhenItPays);

    // Tests the very nodes that ALGO5 tests, the canonical walk of A2SSB (section 3.6): the root, and all
    // children of each inner node that is not outside, against all six planes. Valid until the next call.
    std::span<const std::uint32_t> cull_same_nodes(const Frustum& frustum);
    // Tests nothing below a node against planes that the node is inside of.
    std::span<const std::uint32_t> cull(const Frustum& frustum);

    // The nodes that the last call tested. After cull_same_nodes() it is what ALGO5 tests.
    std::uint64_t tested_nodes() const { return tested_; }

  private:
    enum Visit : std::size_t { kSameNodes, kEarlyOut };
    std::span<const std::uint32_t> cull(const Frustum& frustum, Visit visit);
    std::span<const std::uint32_t> cull_shared(OctreeWalk walk, Visit visit, std::size_t members);

    UniformOctree shape_;
    ThreadTeam& team_;
    const OctreeKernels& kernels_;
    IdSlots ids_;
    std::vector<std::uint32_t> codes_[2];  // of the nodes that are shared, and of those one level above
    std::vector<std::uint32_t> cells_[2];
    std::vector<std::size_t> begins_;
    std::vector<std::uint64_t> tests_;
    std::uint64_t tested_ = 0;
    // For each Visit: how to share it, and what one thread would have taken for the last frame.
    Sharing sharing_[2];
    double expected_ns_[2] = {};
};

}  // namespace swath
