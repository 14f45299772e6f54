#pragma once
#include <string>
#include <vector>

#include "client/partition/partitioner.h"
#include "common/program/cli.h"
#include "common/scene/objects.h"
#include "sim/experiment/model.h"

namespace swath::sim {

// A model's file, and its name in tables.
struct ModelName {
    std::string name;
    std::string file;
    bool operator==(const ModelName&) const = default;
};

// `run` and `sweep` simulate every combination of these.
struct ScenarioOptions {
    std::vector<ModelName> models;
    std::vector<Algorithm> algorithms;
    std::vector<std::size_t> servers;
    std::vector<std::string> hardware;  // built-in names or files
    std::vector<PictureSize> sizes;
    std::vector<Granularity> granularities;
    PathSpec path;
    std::size_t frames_in_flight = 3;
    std::size_t threads = 1;
};

// The flags as the user gave them. read() checks them and makes the options.
class ScenarioFlags {
  public:
    // With `many`, models, hardware, sizes and granularities are also lists.
    void add_to(CLI::App& app, bool many);
    Result<ScenarioOptions> read() const;

  private:
    std::vector<std::string> models_;
    std::vector<std::string> algorithms_{"hybrid"};
    std::vector<std::string> servers_{"8"};
    std::vector<std::string> hardware_{"paper-2000"};
    std::vector<std::string> sizes_{"1280x960"};
    std::vector<int> depths_;
    std::vector<std::size_t> objects_;
    std::string objects_by_ = "uniform";
    PathSpec path_;
    std::size_t frames_in_flight_ = 3;
    std::size_t threads_ = 0;
};

// Reads "NAME=FILE". FILE alone gets its name without folder and ending, builtin:NAME gets NAME.
Result<ModelName> parse_model_name(const std::string& text);
std::size_t threads_or_all(std::size_t wanted);  // 0 means as many as there are cores

}  // namespace swath::sim
