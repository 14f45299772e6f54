#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"
#include "client/predict/rates.h"
#include "common/plan/frame_plan.h"
#include "common/timeline/timeline.h"

namespace swath {

struct MachinePrediction {
    std::string name;
    std::array<double, kPhaseCount> ms{};  // culling is in kRender, sending a tile in kFinalRead
    double operator[](Phase phase) const { return ms[static_cast<std::size_t>(phase)]; }
    double sum_ms() const;
};

// The expected times of a frame: the cost model's work, added up. It has no waiting and no encoding.
struct Prediction {
    std::vector<MachinePrediction> machines;  // client, servers, display
    double frame_ms = 0;                      // the longest machine's sum: the paper's effective frame
    double overlap = 1;                       // triangles drawn over triangles of the model
    double swap_pixels = 0;                   // active ones, all servers
};

// `objects` are those that the plan was made from; `model` are the same unprojected. Thread-safe.
Prediction predict(const FramePlan& plan, std::span<const ProjectedObject> objects, Algorithm algorithm,
                   std::span<const Object> model, const Hardware& hardware);

// The caller keeps the partitioner, which has scratch space and, for sort-last, groups made once.
struct Contender {
    Algorithm algorithm = Algorithm::kHybrid;
    Partitioner* partitioner = nullptr;
};

struct Comparison {
    Algorithm algorithm = Algorithm::kHybrid;
    Prediction prediction;
};

// Predicts every contender's plan for the same view, objects and number of servers. Empty while the rates are
// not known. Runs every partitioner once: well under 5 ms with 1500 objects and 8 servers.
std::vector<Comparison> compare(const PartitionInput& input, std::span<const Object> model,
                                std::span<const Contender> contenders, const Rates& rates);

}  // namespace swath
