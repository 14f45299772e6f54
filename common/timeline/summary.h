#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/timeline/timeline.h"

namespace swath {

// What the run's table shows. A machine's means are over the frames that name it, so that a server that died
// half-way still shows what a frame cost it; those of the run are over all frames.
struct Summary {
    struct Machine {
        std::string name;
        std::size_t frames = 0;  // that name it
        std::array<double, kPhaseCount> mean_ms{};
        std::array<double, kPhaseCount> mean_cpu_ms{};
        std::array<double, kCounterCount> mean_count{};
    };
    std::vector<Machine> machines;  // in order of first appearance
    std::size_t frames = 0;
    double frames_per_s = 0;  // frames / (last end - first begin); 0 where nothing took time
    // 0 to 1: the mean over frames of (max - mean) / max of the busy time of the servers that the frame
    // names. Busy time is the sum of all spans but wait. Frames in which no server was busy don't count.
    double imbalance = 0;
    double swap_pixels = 0;  // per frame, all servers
    double swap_bytes = 0;
    double tile_bytes = 0;
    double overlap_factor = 1;  // mean over frames
};

Summary summarise(std::span<const FrameTimeline> frames);

// The table as text of at most 100 columns: a row per machine and a column per phase, without phases that
// nobody spent time in; of more than 16 servers only their mean, minimum and maximum. Below it the run's
// numbers; triangles only where somebody counted some.
std::string to_text(const Summary& summary);

}  // namespace swath
