#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/box.h"
#include "common/geometry/morton.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// Boxes in the order of the cells of a uniform octree that their centres lie in. The octree's cube has its
// low corner at `origin` and edges of `side` and contains all centres. Boxes that are not finite have no
// place.
struct CellOrder {
    glm::dvec3 origin{0};
    double side = 1;
    // Ascending by code, of the cell at level UniformOctree::kMaxHeight, in the papers' child order; with the
    // box's index.
    std::vector<MortonKey> placed;
    std::vector<std::uint32_t> unplaced;
    // Cells with a box in them, by level.
    std::array<std::size_t, UniformOctree::kMaxHeight + 1> occupied{};

    // The lowest tree, no higher than `highest`, that has at most `boxes_per_leaf` to an occupied leaf.
    int height_for(double boxes_per_leaf, int highest) const;
};

CellOrder cell_order(std::span<const Box> boxes);

}  // namespace swath
