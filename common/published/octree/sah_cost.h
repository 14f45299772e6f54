#pragma once
#include "common/octree/sah/sah_tree.h"

namespace swath {

// The expected cost of a ray that crosses the tree's box and hits nothing: `traversal` for each inner node
// and `intersection` for each triangle of a leaf, times the chance of meeting its box, by surface areas
// (MacDonald and Booth; equation 1 of the SAH octree paper is one step of it). A node that is cut across
// several axes counts as the kd nodes that do the same, so that octrees and kd-trees compare. 0 for a box
// without area.
double sah_cost(const SahTree& tree, double traversal, double intersection);

}  // namespace swath
