#pragma once
#include <cstddef>
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

// Tests every box, 16 at once. A hierarchy must beat it, and it is best where the boxes' order makes a
// hierarchy useless. O(n), limited by reading 24 bytes a box. The contracts are WideHierarchy's.
class FlatScan {
  public:
    // `blocks` must outlive it.
    FlatScan(const BoxBlocks& blocks, ThreadTeam& team, InstructionSet instructions = best_instruction_set(),
             SharingMode mode = SharingMode::kWhenItPays);

    // The indices of the boxes that are not outside(frustum, box), ascending. Valid until the next call.
    std::span<const std::uint32_t> cull(const Frustum& frustum);

  private:
    const BoxBlocks& blocks_;
    ThreadTeam& team_;
    const HierarchyKernels& kernels_;
    IdSlots ids_;
    Sharing sharing_;
    std::vector<std::size_t> begins_;
};

}  // namespace swath
