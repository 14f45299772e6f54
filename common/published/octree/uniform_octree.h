#pragma once
#include <cstdint>

#include "common/geometry/box.h"

namespace swath {

// A cell on one level of a uniform octree, counted from the cube's low corner.
struct OctreeCell {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t z = 0;
    bool operator==(const OctreeCell&) const = default;
};

// A cell's Morton code: three bits a level, the root's child in the highest. A triple is the papers' child
// number: 1 = x, 2 = z, 4 = y (A2SSB, figures 3.7 and 3.8), unlike common/geometry/morton.h. Coordinates are
// below 2^10.
std::uint32_t octree_code(const OctreeCell& cell);
OctreeCell octree_cell(std::uint32_t code);

// The uniform octree of both culling papers (ADSB, section 3; A2SSB, section 3.5): it has every node down to
// the level of leaves. It is implicit: a node is its level (0 is the root) and its Morton code, below
// 8^level, so the children of (l, c) are (l + 1, 8c) to (l + 1, 8c + 7). The papers count levels: "k levels"
// is height k - 1. The cube is [0, 2^height]^3 in leaf edges, so that every box is exact in single precision.
class UniformOctree {
  public:
    static constexpr int kMaxHeight = 10;  // codes are 32 bits

    // `height` is 0 to kMaxHeight; at 0 the root is the only leaf.
    explicit UniformOctree(int height);

    int height() const { return height_; }
    float edge() const { return static_cast<float>(1u << height_); }
    std::uint32_t leaf_count() const { return 1u << 3 * height_; }
    // (8^(height + 1) - 1) / 7: ADSB, appendix A; A2SSB, equation 14.
    std::uint64_t node_count() const;
    // The level is at most height(), the code below 8^level.
    Box box_of(int level, std::uint32_t code) const;

  private:
    int height_;
};

}  // namespace swath
