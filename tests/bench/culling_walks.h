#pragma once
#include <memory>
#include <string>

#include "common/published/cull/published_walk.h"
#include "tests/bench/race.h"

namespace swath::bench {

// Adds a published algorithm as a runner. The leaves of every member stay where it left them, since these
// algorithms do not join them.
void add_walk(Race& race, std::string name, std::shared_ptr<PublishedWalk> walk, const Frustum& frustum);

// Finds the split level of the shortest frames, and forces it.
int force_best_split_level(PublishedWalk& walk, const Frustum& frustum, int height);

}  // namespace swath::bench
