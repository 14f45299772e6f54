#pragma once
#include <memory>
#include <string>

#include "common/cull/published/published_walk.h"
#include "tests/bench/race.h"

namespace swath::bench {

// A published algorithm as a runner. Every member's leaves stay where it left them: to join them is no part
// of these algorithms.
void add_walk(Race& race, std::string name, std::shared_ptr<PublishedWalk> walk, const Frustum& frustum);

// The split level at which the walk's frames are shortest; forces it.
int force_best_split_level(PublishedWalk& walk, const Frustum& frustum, int height);

}  // namespace swath::bench
