#pragma once
#include "common/base/instruction_set.h"
#include "common/geometry/frustum.h"
#include "common/published/cull/walk_table.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// The walks for an instruction set, which must be one of instruction_sets(). AVX-512 adds nothing to them.
const WalkTable& walk_table(InstructionSet set);
inline const WalkTable& best_walk_table() { return walk_table(best_instruction_set()); }

WalkPlanes walk_planes(const Frustum& frustum);
WalkBox walk_box(const Box& box);

ComputedNode computed_node(const UniformOctree& tree, int level, std::uint32_t code);

}  // namespace swath
