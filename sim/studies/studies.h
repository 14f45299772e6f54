#pragma once
#include "common/base/result.h"
#include "sim/studies/context.h"

namespace swath::sim {

// Each runs one study, and writes its files and its section of the page.
Status feasibility(StudyContext& context);  // section 7.1: Table 1, figure 6
Status scalability(StudyContext& context);  // section 7.2: figures 7, 8, 9
Status sort_first(StudyContext& context);   // section 7.3: figure 10a
Status sort_last(StudyContext& context);    // section 7.4: figures 10b and 10c
Status resolution(StudyContext& context);   // section 7.5: figure 11
Status granularity(StudyContext& context);  // section 7.6: figures 12, 13, 14

// A stack of the server's phases for every algorithm and number of servers, as in figures 8 and 11.
Bars server_bars(const Results& results, const std::string& model, const std::string& title);

}  // namespace swath::sim
