#pragma once
#include <span>
#include <string>

#include "common/timeline/timeline.h"

namespace swath {

// What the run's table shows: per machine the mean milliseconds of each phase and mean counters per frame,
// and for the run frames per second (first begin to last end), the imbalance (mean over frames of (max -
// mean) / max of the servers' busy time, every phase but wait), the mean swapped pixels and bytes a frame,
// and the mean overlap factor.
struct Summary {
    struct Machine {
        std::string name;
        std::array<double, kPhaseCount> mean_ms{};
        std::array<double, kPhaseCount> mean_cpu_ms{};
        std::array<double, kCounterCount> mean_count{};
    };
    std::vector<Machine> machines;  // in order of first appearance
    std::size_t frames = 0;
    double frames_per_s = 0;
    double imbalance = 0;    // 0 to 1
    double swap_pixels = 0;  // per frame, all servers
    double swap_bytes = 0;
    double tile_bytes = 0;
    double overlap_factor = 1;
};

Summary summarise(std::span<const FrameTimeline> frames);

// The table as text of at most 100 columns: phases that nobody spent time in are left out.
std::string to_text(const Summary& summary);

}  // namespace swath
