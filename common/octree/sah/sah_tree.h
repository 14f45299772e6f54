#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// A node of a SahTree, 16 bytes. An inner one is cut along one axis (as in a kd-tree), two or all three (an
// octree node) by a plane each, and has 2, 4 or 8 children, which stand together. A leaf lists triangles.
struct SahNode {
    std::array<float, 3> plane;  // of the axes that are cut
    std::uint32_t link;  // bits 0 to 2: the axes that are cut, none for a leaf; from bit 3: the first child

    static SahNode leaf(std::uint32_t first, std::uint32_t count) {
        return {{std::bit_cast<float>(first), std::bit_cast<float>(count), 0.0f}, 0};
    }
    static SahNode inner(const std::array<float, 3>& plane, std::uint32_t axes, std::uint32_t first_child) {
        return {plane, first_child << 3 | axes};
    }

    bool is_leaf() const { return axes() == 0; }
    std::uint32_t axes() const { return link & 7; }
    bool cuts(int axis) const { return (link >> axis & 1) != 0; }
    // A child's place is first_child() plus a number with a bit for each axis that is cut, x's lowest: set
    // where the child is above the plane.
    std::uint32_t first_child() const { return link >> 3; }
    std::uint32_t child_count() const { return 1u << std::popcount(axes()); }
    // Of a leaf: its part of SahTree::triangles.
    std::uint32_t first() const { return std::bit_cast<std::uint32_t>(plane[0]); }
    std::uint32_t count() const { return std::bit_cast<std::uint32_t>(plane[1]); }
};
static_assert(sizeof(SahNode) == 16);
// What a link can point at.
inline constexpr std::size_t kMaxSahNodes = std::size_t{1} << 29;

// A division of space for ray casting: an octree at the top whose planes are chosen by the surface area
// heuristic, and kd-trees below; or one kd-tree. A triangle stands in every leaf whose box its own box
// overlaps. A value, deep-copied and immutable once built; any thread may read it.
struct SahTree {
    Box box;                     // of all triangles
    std::vector<SahNode> nodes;  // nodes[0] is the root
    std::vector<std::uint32_t> triangles;

    std::size_t bytes() const {
        return nodes.size() * sizeof(SahNode) + triangles.size() * sizeof(std::uint32_t);
    }
};

// What a ray that crosses the tree's box is expected to cost, if it hits nothing: `traversal` for each inner
// node and `intersection` for each triangle of a leaf, each times the chance of meeting its box, by surface
// areas (MacDonald and Booth; equation 1 of the SAH octree paper is one step of it). A node that is cut along
// several axes counts as the kd nodes that do the same, so that octrees and kd-trees compare. 0 for a box
// without area, which no ray meets.
double sah_cost(const SahTree& tree, double traversal, double intersection);

}  // namespace swath
