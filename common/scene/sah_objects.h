#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// A triangle as sah_cells() needs it.
struct SahTriangle {
    Box box;
    std::uint32_t code = 0;  // of its centre, in the model's box (common/geometry/morton.h)
    std::uint32_t material = 0;
};

// Cuts a model into cells of a SAH octree that make about `objects` objects, at least 1 (an object is one
// cell's triangles of one material). Returns for each triangle, of which there must be one or more, the
// number of its cell. Numbers count from 0 in the tree's depth-first order, so cells of near numbers are
// near. Beginning with the whole model, it cuts the cell that costs most until there are enough: with m
// materials there are at most 7 m objects too many, and too few only if no cell has triangles of two codes.
//
// All triangles of one code are in one cell, by the centre of the code's own cell in `bounds`, so that their
// order is the same in every cut (see build_objects). Cells depend on the triangles and their order only.
std::vector<std::uint32_t> sah_cells(std::span<const SahTriangle> triangles, const Box& bounds,
                                     std::size_t objects);

}  // namespace swath
