#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// What the cut by a SAH octree knows of a triangle.
struct SahTriangle {
    Box box;
    std::uint32_t code = 0;  // of its centre, in the model's box (common/geometry/morton.h)
    std::uint32_t material = 0;
};

// Cuts a model into the cells of a SAH octree, as many as give about `objects` objects (an object is what one
// cell has of one material): for each triangle the number of the cell that holds its centre. Cells are
// numbered from 0 in the tree's depth-first order, so that those with near numbers are near. Beginning with
// the whole model, the cell that costs most is cut until there are enough: with m materials there are at
// most 7 m objects more than asked for, and fewer only where no cell has triangles of two codes.
//
// Triangles of one code are in one cell: what decides is the centre of the code's own cell in `bounds`. With
// it the order of such triangles is the same in every cut (see build_objects). Which cells there are depends
// on the triangles and their order only; there is at least one triangle, and `objects` is at least 1.
std::vector<std::uint32_t> sah_cells(std::span<const SahTriangle> triangles, const Box& bounds,
                                     std::size_t objects);

}  // namespace swath
