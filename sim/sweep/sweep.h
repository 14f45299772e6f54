#pragma once
#include <filesystem>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "sim/scenario/options.h"
#include "sim/scenario/scenario.h"

namespace swath::sim {

struct SweepOptions {
    ScenarioOptions scenario;
    std::filesystem::path out;  // folder for the table and the journal; made if missing
    bool quiet = false;
};

struct SweepResult {
    std::filesystem::path table;
    std::size_t experiments = 0;
    std::size_t from_before = 0;  // experiments that were complete when the sweep began
};

// Runs the scenario's experiments that are not complete in the journal in `options.out`, and writes the table
// of all of them. The table depends neither on threads nor on interruptions. An error before the first
// experiment changes nothing in the folder; a later one loses nothing that is complete.
Result<SweepResult> run_sweep(const Scenario& scenario, const SweepOptions& options, const Clock& clock);

// The command `swath-sim sweep`.
Status sweep(const SweepOptions& options, const Clock& clock);

}  // namespace swath::sim
