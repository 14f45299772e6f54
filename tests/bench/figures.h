#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/result.h"

namespace swath::bench {

// The results of a benchmark: named figures with their noise, printed as a table and written as JSON.
class Figures {
  public:
    // Adds a figure: the samples' median, with the noise (max - min) / median. `bar` says, for people, what
    // it is compared with.
    void add(const std::string& name, std::vector<double> samples, const std::string& unit,
             const std::string& bar);
    // Adds a line for people.
    void note(const std::string& text) { notes_.push_back(text); }

    std::string to_text(const std::string& benchmark) const;  // with machine and commit
    std::string to_json() const;                              // {"figures": {name: number}}

  private:
    struct Figure {
        std::string name;
        double value;
        double noise;
        std::size_t samples;
        std::string unit;
        std::string bar;
    };
    std::vector<Figure> figures_;
    std::vector<std::string> notes_;
};

double median(std::vector<double> samples);

// The model to render, and how often: the Dragon for figures; a small built-in model, once, to see that a
// benchmark runs.
struct Effort {
    std::string model;
    int repetitions = 1;
    std::size_t frames = 2;
    bool smoke = false;
    std::filesystem::path out = {};  // folder for tables and plots; empty: none
};
// The Dragon from ../shared/models, else from models/, where script/fetch-models puts it. An error if it is
// missing and the benchmark needs it.
Result<Effort> full_effort(bool needs_model);
Effort smoke_effort();

// A program that has ended.
struct Finished {
    int exit_code = -1;
    double cpu_s = 0;  // of the program and all its descendants, user and system
    double wall_s = 0;
    std::string output;           // stdout
    double frames_per_s() const;  // from swath-client's summary; 0 without it
};
Finished run_program(const std::vector<std::string>& command);
std::string client_program();  // swath-client beside this program

// Each runs one benchmark. Errors: something is missing (a model, a program).
Status bench_culling(Figures& figures, const Effort& effort);  // draws plots
Status bench_octree(Figures& figures, const Effort& effort);   // draws plots
Status bench_cluster(Figures& figures, const Effort& effort);
Status bench_compose(Figures& figures, const Effort& effort);
Status bench_culling_render(Figures& figures, const Effort& effort);
Status bench_swap(Figures& figures, const Effort& effort);
Status bench_load(Figures& figures, const Effort& effort);
Status bench_peers(Figures& figures, const Effort& effort);
Status bench_raster(Figures& figures, const Effort& effort);
Status bench_simulator(Figures& figures, const Effort& effort);
Status bench_viewer(Figures& figures, const Effort& effort);

}  // namespace swath::bench
