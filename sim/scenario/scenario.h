#pragma once
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "sim/experiment/experiment.h"
#include "sim/scenario/options.h"

namespace swath::sim {

// Loads everything that ScenarioOptions name, and combines it to experiments: by model, hardware, size,
// granularity, algorithm and servers. Experiments point into it. If there are several sizes, granularities or
// profiles, model names say which: "dragon (depth 5, 2560x1920)", "dragon (SAH 1500)". No two experiments
// have the same label: granularities that come to the same depth are one; otherwise equal names are an error.
class Scenario {
  public:
    static Result<Scenario> load(const ScenarioOptions& options);

    const std::vector<Experiment>& experiments() const { return experiments_; }
    // All that decides the results, one a line: people read them, and the journal tells runs apart by them.
    const std::vector<std::string>& settings() const { return settings_; }

  private:
    void add_settings(std::string_view lines);
    Status add_model(const ModelName& name, const ScenarioOptions& options);

    // Lists, because experiments point to their elements.
    std::list<StudyModel> models_;
    std::list<Paths> paths_;
    std::list<Hardware> hardware_;
    std::vector<Experiment> experiments_;
    std::vector<std::string> settings_;
};

}  // namespace swath::sim
