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

// An implicit hierarchy of 16 children a node over boxes in their given order: 16 consecutive boxes make a
// node, 16 consecutive nodes make one above. It takes 25.6 bytes a box. Any order is right, but it is faster
// the nearer neighbours are (see common/geometry/morton.h).
//
// A node's 16 children are tested at once. A child outside of a plane is dropped with all below it, a child
// inside of a plane is not tested against it below, and a child inside of all planes becomes a range of ids.
// The answer is exactly that of outside(frustum, box) for each box, even if it is empty, infinite or NaN,
// because the plane test is monotone (see frustum.h) and nodes contain all corners of such boxes.
//
// One thread at a time. The team must outlive it and be idle when it is called; it takes part if that pays
// (see sharing.h).
class WideHierarchy {
  public:
    // At most 2^31 boxes. O(n).
    WideHierarchy(std::span<const Box> boxes, ThreadTeam& team,
                  InstructionSet instructions = best_instruction_set(),
                  SharingMode mode = SharingMode::kWhenItPays);

    // Moves the boxes. There must be as many as before. O(n), and allocates nothing.
    void refit(std::span<const Box> boxes);

    // The indices of the boxes that are not outside(frustum, box), ascending. Valid until the next call.
    std::span<const std::uint32_t> cull(const Frustum& frustum);

    // The number of nodes of 256 boxes that cross a plane, so that cull() would look into them. It estimates
    // the work of cull() for a 200th of a scan's.
    std::uint32_t crossing_nodes(const Frustum& frustum) const;

    // The work of the last cull().
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
    std::vector<WideLevel> levels_;           // the last has one block; empty if there are no boxes
    IdSlots ids_;
    std::vector<WidePiece> pieces_;
    std::vector<std::size_t> begins_;
    std::vector<WideWork> works_;
    WideWork work_;
    Sharing sharing_;
    double expected_ns_ = 0;  // what one thread would have taken for the last frame
};

// The kernels of an instruction set, which must be one of instruction_sets().
const HierarchyKernels& hierarchy_kernels(InstructionSet instructions);
std::array<KernelPlane, 6> kernel_planes(const Frustum& frustum);

}  // namespace swath
