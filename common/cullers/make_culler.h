#pragma once
#include <memory>
#include <span>

#include "common/base/thread_team.h"
#include "common/cull/cull_algorithm.h"
#include "common/cull/culler.h"
#include "common/cull/leaf_cull.h"
#include "common/geometry/box.h"
#include "common/scene/objects.h"

namespace swath {

// Makes a culler, or null for kNone. It copies what it needs of `boxes`, which should come in an order in
// which neighbours are near, as leaves of an ObjectSet do: any order is right, but a bad one is slow. At most
// 2^31 boxes. The team must outlive the culler and be idle when it is called.
std::unique_ptr<Culler> make_culler(CullAlgorithm algorithm, std::span<const Box> boxes, ThreadTeam& team);

// Makes what culls the leaves of `scene`. Scene and team must outlive it.
LeafCull make_leaf_cull(CullAlgorithm algorithm, const ObjectSet& scene, ThreadTeam& team);

}  // namespace swath
