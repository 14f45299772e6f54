#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/instruction_set.h"
#include "common/base/sharing.h"
#include "common/base/thread_team.h"
#include "common/cull/wide/box_blocks.h"
#include "common/cull/wide/hierarchy_kernel.h"
#include "common/cull/wide/id_slots.h"
#include "common/geometry/frustum.h"

namespace swath {

// An implicit hierarchy of 16 children a node over boxes in their given order: 16 that follow each other make
// a node, 16 nodes that follow each other one above. 25.6 bytes a box. The nearer together neighbours are,
// the faster (see common/geometry/morton.h); any order is right.
//
// A node's 16 children are tested at once. What is outside of a plane goes with all below it, what is inside
// of a plane need not be tested against it below, and what is inside of all becomes a range of ids. The
// answer is exactly that of outside(frustum, box) for each box, for boxes that are empty, infinite or no
// numbers too: the plane test is monotone (see frustum.h), and nodes hold whatever such boxes may do.
//
// One thread at a time. The team must outlive it and be idle when it is called; it takes part where that
// pays (see sharing.h).
class WideHierarchy {
  public:
    // At most 2^31 boxes. O(n).
    WideHierarchy(std::span<const Box> boxes, ThreadTeam& team,
                  InstructionSet instructions = best_instruction_set(),
                  SharingMode mode = SharingMode::kWhenItPays);

    // As many boxes in the same order, somewhere else. O(n); allocates nothing.
    void refit(std::span<const Box> boxes);

    // The indices of the boxes that are not outside(frustum, box), ascending. Valid until the next call.
    std::span<const std::uint32_t> cull(const Frustum& frustum);

    // Of the nodes of 256 boxes those that cull() would look into, as they cross a plane: an estimate of its
    // work for a 200th of a scan's.
    std::uint32_t crossing_nodes(const Frustum& frustum) const;

    // What the last cull tested.
    const WideWork& work() const { return work_; }
    const BoxBlocks& blocks() const { return boxes_; }

  private:
    void bound_nodes();
    std::span<const std::uint32_t> cull_shared(WideWalk walk, std::size_t members);
    int split_level(std::size_t members) const;

    ThreadTeam& team_;
    const HierarchyKernels& kernels_;
    BoxBlocks boxes_;
    std::vector<AlignedArray<float>> inner_;  // levels from 1 up
    std::vector<WideLevel> levels_;           // the last has one block; none if there are no boxes
    IdSlots ids_;
    std::vector<WidePiece> pieces_;
    std::vector<std::size_t> begins_;
    std::vector<WideWork> works_;
    WideWork work_;
    Sharing sharing_;
    double expected_ns_ = 0;  // what the last frame would have taken one thread
};

// The kernels for an instruction set of instruction_sets().
const HierarchyKernels& hierarchy_kernels(InstructionSet instructions);
// Of the six planes.
std::array<KernelPlane, 6> kernel_planes(const Frustum& frustum);

}  // namespace swath
