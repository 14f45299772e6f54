#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/timeline/timeline.h"

namespace swath {

// The numbers of a run's table. A machine's means are over the frames that name it, so that a server that
// died half-way still shows what a frame cost it. The run's means are over all frames.
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
    double frames_per_s = 0;  // frames / (last end - first begin), or 0 if nothing took time
    // 0 to 1: the mean over frames of (max - mean) / max of the busy time of the frame's servers. Busy time
    // is the sum of all spans but waits. Frames in which no server was busy do not count.
    double imbalance = 0;
    double swap_pixels = 0;  // per frame, all servers
    double swap_bytes = 0;
    double tile_bytes = 0;
    double overlap_factor = 1;  // mean over frames
};

Summary summarise(std::span<const FrameTimeline> frames);

// The table as text of at most 100 columns: a row per machine and a column per phase that took time; of more
// than 16 servers only mean, minimum and maximum. Below it are the run's numbers, with triangles if any were
// counted.
std::string to_text(const Summary& summary);

}  // namespace swath
