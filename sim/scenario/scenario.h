#pragma once
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "sim/experiment/experiment.h"
#include "sim/scenario/options.h"

namespace swath::sim {

// Everything that ScenarioOptions name, loaded, and the experiments that they combine to: by model, hardware,
// size, granularity, algorithm and servers. Experiments point into it. Where there are several sizes,
// granularities or profiles, model names say which: "dragon (depth 5, 2560x1920)", "dragon (SAH 1500)". No
// two experiments have the same label: granularities that come to the same depth are one, all else of one
// name is an error.
class Scenario {
  public:
    static Result<Scenario> load(const ScenarioOptions& options);

    const std::vector<Experiment>& experiments() const { return experiments_; }
    // What decides the results, a line each, for people and to tell runs apart.
    const std::vector<std::string>& settings() const { return settings_; }

  private:
    void add_settings(std::string_view lines);
    Status add_model(const ModelName& name, const ScenarioOptions& options);

    // Lists, whose elements stay where they are.
    std::list<StudyModel> models_;
    std::list<Paths> paths_;
    std::list<Hardware> hardware_;
    std::vector<Experiment> experiments_;
    std::vector<std::string> settings_;
};

}  // namespace swath::sim
