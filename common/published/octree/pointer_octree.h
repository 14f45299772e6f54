#pragma once
#include <cstdint>
#include <vector>

#include "common/published/octree/octree_node.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// The order of a stored octree's nodes in memory. The A2SSB chapter's results on caches (section 3.8) depend
// on it: walks in the order of the nodes are fast, walks over scattered nodes are not.
enum class AllocationOrder {
    kDepthFirst,    // as a recursive builder allocates them
    kBreadthFirst,  // level by level
    kRandom,        // as after many insertions and removals
};

// The uniform octree with every node stored and linked by pointers, which the canonical algorithms walk. It
// takes 96 bytes a node (8 levels: 230 MB; 9: 1.84 GB). Immutable, so any number of threads may read it.
class PointerOctree {
  public:
    static constexpr int kMaxHeight = 8;

    // Only kRandom uses `seed`.
    PointerOctree(const UniformOctree& shape, AllocationOrder order, std::uint64_t seed = 1);
    // Nodes point at each other.
    PointerOctree(const PointerOctree&) = delete;
    PointerOctree& operator=(const PointerOctree&) = delete;

    const UniformOctree& shape() const { return shape_; }
    const OctreeNode& root() const { return *root_; }

  private:
    UniformOctree shape_;
    std::vector<OctreeNode> nodes_;
    const OctreeNode* root_;
};

}  // namespace swath
