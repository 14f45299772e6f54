#pragma once
#include <filesystem>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "sim/scenario/options.h"
#include "sim/scenario/scenario.h"

namespace swath::sim {

struct SweepOptions {
    ScenarioOptions scenario;
    std::filesystem::path out;  // folder for the table and the journal; made if it is missing
    bool quiet = false;
};

struct SweepResult {
    std::filesystem::path table;
    std::size_t experiments = 0;
    std::size_t from_before = 0;  // of these, complete when the sweep began
};

// Runs those of the scenario's experiments that the journal in `options.out` has not complete, and writes the
// table of all of them, which depends neither on threads nor on interruptions. Errors before the first
// experiment leave what is in the folder as it is; later ones lose nothing that is complete.
Result<SweepResult> run_sweep(const Scenario& scenario, const SweepOptions& options, const Clock& clock);

// `swath-sim sweep`.
Status sweep(const SweepOptions& options, const Clock& clock);

}  // namespace swath::sim
