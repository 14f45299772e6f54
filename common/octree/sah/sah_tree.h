#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// A node of a SahTree, 16 bytes. An inner node is cut by a plane across one axis (a kd-tree's node), two or
// all three (an octree's) and has 2, 4 or 8 children, which are contiguous. A leaf lists triangles.
struct SahNode {
    std::array<float, 3> plane;  // of the axes that are cut; of a leaf: first() and count() as bits
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
    // A child's index is first_child() plus a number with one bit for each axis that is cut, x's lowest. The
    // bit is set if the child is above the plane.
    std::uint32_t first_child() const { return link >> 3; }
    std::uint32_t child_count() const { return 1u << std::popcount(axes()); }
    // first() and count() are a leaf's part of SahTree::triangles.
    std::uint32_t first() const { return std::bit_cast<std::uint32_t>(plane[0]); }
    std::uint32_t count() const { return std::bit_cast<std::uint32_t>(plane[1]); }
};
static_assert(sizeof(SahNode) == 16);
// The most nodes that a link can tell apart.
inline constexpr std::size_t kMaxSahNodes = std::size_t{1} << 29;

// A division of space for ray casting: an octree whose planes are chosen by the surface area heuristic, with
// kd-trees below, or one kd-tree. A triangle stands in every leaf whose box its own box overlaps. A value,
// immutable once built; any thread may read it.
struct SahTree {
    Box box;                     // of all triangles
    std::vector<SahNode> nodes;  // nodes[0] is the root
    std::vector<std::uint32_t> triangles;

    std::size_t bytes() const {
        return nodes.size() * sizeof(SahNode) + triangles.size() * sizeof(std::uint32_t);
    }
};

}  // namespace swath
