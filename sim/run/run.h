#pragma once
#include <string>

#include "common/base/result.h"
#include "sim/scenario/options.h"

namespace swath::sim {

struct RunOptions {
    ScenarioOptions scenario;
    std::string csv;       // file for the table; none if empty
    std::string timeline;  // FILE.csv or FILE.json, of the one experiment's first path; none if empty
};

// What is wrong with the options together.
Status check(const RunOptions& options);
// `swath-sim run`: simulates one scenario and prints paper mode and full mode side by side.
Status run(const RunOptions& options);

}  // namespace swath::sim
