#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/geometry/box.h"
#include "common/geometry/frustum.h"

namespace swath::bench {

// Bullet's btDbvt and its walk of one frustum, collideKDOP (Bullet 3.24, with plane masks and inside
// early-out). The tree is ours: every node halves its boxes across the longest side of their centres, and
// nodes lie in memory in the order of a depth-first walk. Bullet's own optimizeTopDown takes 15 s for a
// million boxes and makes a slower tree; halving the boxes in Morton order makes one that takes a fifth
// longer.
class BulletTree {
  public:
    explicit BulletTree(std::span<const Box> boxes);
    ~BulletTree();
    BulletTree(const BulletTree&) = delete;
    BulletTree& operator=(const BulletTree&) = delete;

    // Indices of boxes that are not outside, in the order of the walk; valid until the next call. Bullet's
    // sums are not fused: see settle_rounding().
    std::span<const std::uint32_t> cull(const Frustum& frustum);

  private:
    struct Nodes;
    std::unique_ptr<Nodes> nodes_;
    std::vector<std::uint32_t> visible_;
};

// `ids` without the boxes that rounding decides: a box whose distance to a plane is 0 but for a rounding
// error is in if our plane expression says that it is not outside(), whatever `ids` say. Ascending.
std::vector<std::uint32_t> settle_rounding(std::span<const std::uint32_t> ids, std::span<const Box> boxes,
                                           const Frustum& frustum);

}  // namespace swath::bench
