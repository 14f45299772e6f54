#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/box.h"
#include "common/geometry/morton.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// Boxes in the order of the cells of a uniform octree in which their centres lie. The octree's cube has its
// low corner at `origin` and edges of `side` and contains all centres. Boxes that are not finite are
// unplaced.
struct CellOrder {
    glm::dvec3 origin{0};
    double side = 1;
    // The boxes' indices, ascending by the code of the cell on level UniformOctree::kMaxHeight, in the
    // papers' child order.
    std::vector<MortonKey> placed;
    std::vector<std::uint32_t> unplaced;
    // The number of cells with a box, by level.
    std::array<std::size_t, UniformOctree::kMaxHeight + 1> occupied{};

    // The height of the lowest tree, at most `highest`, with at most `boxes_per_leaf` boxes to an occupied
    // leaf.
    int height_for(double boxes_per_leaf, int highest) const;
};

CellOrder cell_order(std::span<const Box> boxes);

}  // namespace swath
