#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"
#include "common/geometry/camera.h"
#include "sim/cluster/simulated_cluster.h"
#include "sim/cost/paper_frame.h"
#include "sim/experiment/model.h"
#include "sim/table/table.h"

namespace swath::sim {

// A model on some hardware, partitioned by one algorithm for a number of servers; a row of a study.
struct Experiment {
    const StudyModel* model = nullptr;
    const Paths* paths = nullptr;
    const Hardware* hardware = nullptr;
    Algorithm algorithm = Algorithm::kHybrid;
    std::size_t servers = 1;
    int width = 1280;
    int height = 960;
    std::size_t frames_in_flight = 3;
    bool full = true;  // simulate machines and network, too
    // Labels in the table.
    std::string algorithm_name;
    std::string model_name;
    Row label() const { return {algorithm_name, model_name, servers, {}, 0}; }
};

// Means of simulated runs.
class FullMeans {
  public:
    void add(const ClusterRunCosts& run);
    void add(const FullMeans& other);
    bool empty() const { return runs_ == 0; }

    double frame_s() const { return frame_s_ / runs_; }
    double latency_s() const { return latency_s_ / runs_; }
    double speedup() const { return frame_s_ > 0 ? single_s_ / frame_s_ : 0; }
    std::vector<ResourceUse> use() const;
    ResourceUse bottleneck() const;  // the busiest

    // full_frame and full_latency in ms, full_speedup, and busy_RESOURCE in per cent, with the labels of
    // `of`.
    std::vector<Row> rows(const Row& of) const;

  private:
    double runs_ = 0;
    double frame_s_ = 0;
    double latency_s_ = 0;
    double single_s_ = 0;
    std::vector<ResourceUse> use_;  // sums
};

struct Outcome {
    PaperMeans paper;
    FullMeans full;  // empty if not asked for
};
std::vector<Row> table1_rows(const Experiment& experiment, const Outcome& outcome);
std::vector<Row> all_rows(const Experiment& experiment, const Outcome& outcome);

// Runs experiments on `threads` threads (at least 1). Calls `on_done` with the index of each one that is
// complete, and `on_frame` for each frame of full mode, from one thread at a time. Outcomes do not depend on the
// number of threads.
std::vector<Outcome> run_experiments(std::span<const Experiment> experiments, std::size_t threads,
                                     const std::function<void(std::size_t, const Outcome&)>& on_done,
                                     const std::function<void()>& on_frame = {});

}  // namespace swath::sim
