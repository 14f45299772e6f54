#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "sim/scenario/options.h"

namespace swath::sim {

struct StudyOptions {
    std::vector<std::string> names;  // of studies
    // If empty, or if it has one of the paper's models, the paper's missing models are looked for in models/,
    // and the Hand gets its stand-in.
    std::vector<ModelName> models;
    std::map<std::string, double> zooms;  // by model, in place of the paper's
    std::string hardware = "paper-2000";
    std::size_t frames = 50;
    std::uint64_t seed = 1;
    std::size_t seeds = 5;
    std::size_t threads = 1;
    bool quiet = false;
    std::filesystem::path out;
};

// The studies of Samanta 2000, sections 7.1 to 7.6: "feasibility", "scalability", "sort-first", "sort-last",
// "resolution", "granularity".
std::vector<std::string> study_names();

// The flags as the user gave them. read() checks them and makes the options.
class StudyFlags {
  public:
    void add_to(CLI::App& app);
    Result<StudyOptions> read() const;

  private:
    std::vector<std::string> names_;
    std::vector<std::string> models_;
    std::vector<std::string> zooms_;
    StudyOptions options_;
    std::size_t threads_ = 0;
};

// Runs the named studies in the paper's order. Writes tables, plots and pictures into `out`, with an
// index.html that shows them. Deterministic, whatever the number of threads. Takes long; shows progress.
Status run_studies(const StudyOptions& options);

}  // namespace swath::sim
