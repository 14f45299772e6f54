#pragma once
#include <memory>
#include <span>

#include "common/cull/culler.h"
#include "common/published/cull/published_walk.h"

namespace swath {

// Makes a culler of a published algorithm over the boxes' octree (object_cells.h). Each member of the team
// also tests the boxes of the leaves that it finds and a share of those in no leaf.
std::unique_ptr<Culler> make_octree_culler(PublishedAlgorithm algorithm, std::span<const Box> boxes,
                                           ThreadTeam& team);

}  // namespace swath
