#pragma once
#include <span>
#include <string>

#include "sim/experiment/experiment.h"

namespace swath::sim {

// The experiments' times for people: what the paper counts beside what the whole cluster does. A row each, at
// most 132 columns wide for short names; a heading for every model.
std::string side_by_side(std::span<const Experiment> experiments, std::span<const Outcome> outcomes);

}  // namespace swath::sim
