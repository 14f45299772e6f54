#pragma once
#include <string>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "sim/scenario/options.h"

namespace swath::sim {

struct RunOptions {
    ScenarioOptions scenario;
    std::string csv;       // file for the table; empty: none
    std::string timeline;  // FILE.csv or FILE.json for the only experiment's first path; empty: none
};

// Errors say which options do not go together.
Status check(const RunOptions& options);
// `swath-sim run`: simulates one scenario and prints paper mode and full mode side by side. What takes longer
// than some seconds shows its progress.
Status run(const RunOptions& options, const Clock& clock);

}  // namespace swath::sim
