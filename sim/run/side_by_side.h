#pragma once
#include <span>
#include <string>

#include "sim/experiment/experiment.h"

namespace swath::sim {

// The experiments' times as text: paper mode beside full mode, an experiment a line, at most 132 columns wide
// for short names, under a heading for every model. The last lines say what each mode is for.
std::string side_by_side(std::span<const Experiment> experiments, std::span<const Outcome> outcomes);

}  // namespace swath::sim
