#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/frustum.h"
#include "common/published/cull/member_lists.h"
#include "common/published/cull/walk_table.h"

namespace swath {

// The canonical culling of objects: A2SSB's ALGO5 with objects on the leaves, a recursion over nodes linked
// by pointers on one thread. A node's box is as tight as its objects allow, nodes without objects are absent,
// and no node is taken as wholly inside. Nodes lie in depth-first order and each leaf's objects are
// contiguous. It is a baseline for benchmarks, so it does not sort what it finds.
class ObjectOctree {
  public:
    // Copies the boxes, at most 2^31. The tree is the lowest with at most `boxes_per_leaf` to an occupied
    // leaf, on average.
    explicit ObjectOctree(std::span<const Box> boxes, double boxes_per_leaf = 8);
    ObjectOctree(const ObjectOctree&) = delete;
    ObjectOctree& operator=(const ObjectOctree&) = delete;

    // The indices of all boxes that are not outside of the frustum, each once, in any order. Valid until the
    // next call.
    std::span<const std::uint32_t> cull(const Frustum& frustum);

    int height() const { return height_; }
    std::size_t node_count() const { return nodes_.size(); }

  private:
    struct Build;
    CellBoxes contents_of_leaves() const { return {nullptr, boxes_.data(), ids_.data()}; }

    int height_ = 0;
    std::vector<BoxNode> nodes_;  // the root is first; empty if no boxes are in leaves
    std::size_t in_leaves_ = 0;   // boxes from here on are not finite and in no leaf
    std::vector<WalkBox> boxes_;
    std::vector<std::uint32_t> ids_;
    OwnedList<WalkList<std::uint32_t>> visible_;
};

}  // namespace swath
