#include "client/predict/prediction.h"

#include <algorithm>
#include <numeric>

#include "client/cost/client_time.h"
#include "client/cost/frame_work.h"

namespace swath {

double MachinePrediction::sum_ms() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }

Prediction predict(const FramePlan& plan, std::span<const ProjectedObject> objects, Algorithm algorithm,
                   std::span<const Object> model, const Hardware& hardware) {
    const std::vector<ServerWork> work = frame_work(plan, objects, hardware);
    // A card's swaths are read from its buffers; a host's are coded.
    const bool on_host = hardware.server.compositing == Compositing::kHost;
    const Phase sending = on_host ? Phase::kSwap : Phase::kPixelRead;

    Prediction prediction;
    prediction.overlap = overlap_factor(plan, model);
    std::vector<MachinePrediction>& machines = prediction.machines;
    machines.resize(work.size() + 2);
    const auto add = [&](MachinePrediction& machine, Phase phase, double time_s) {
        machine.ms[static_cast<std::size_t>(phase)] += 1e3 * time_s;
    };
    machines.front().name = "client";
    machines.back().name = "display";
    add(machines.front(), Phase::kPartition, client_s(objects.size(), work.size(), algorithm, hardware));
    for (std::size_t s = 0; s < work.size(); ++s) {
        MachinePrediction& server = machines[1 + s];
        server.name = server_name(server_id(s));
        add(server, Phase::kRender, work[s].render_s);
        add(server, Phase::kPixelRead, work[s].read_s);
        add(server, Phase::kFinalRead, work[s].final_s);
        add(machines.back(), Phase::kAssemble, work[s].display_s);
        for (const SwathWork& swath : work[s].outgoing) {
            add(server, sending, swath.send_s);
            add(machines[1 + index(swath.peer)], Phase::kPixelWrite, swath.merge_s);
            prediction.swap_pixels += swath.pixels;
        }
    }
    for (const MachinePrediction& machine : machines)
        prediction.frame_ms = std::max(prediction.frame_ms, machine.sum_ms());
    return prediction;
}

std::vector<Comparison> compare(const PartitionInput& input, std::span<const Object> model,
                                std::span<const Contender> contenders, const Rates& rates) {
    std::vector<Comparison> comparisons;
    for (const auto& [algorithm, partitioner] : contenders)
        if (const auto hardware = rates.hardware(algorithm))
            comparisons.push_back({algorithm, predict(partitioner->partition(input), input.objects, algorithm,
                                                      model, *hardware)});
    return comparisons;
}

}  // namespace swath
