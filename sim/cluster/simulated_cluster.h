#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"
#include "common/base/clock.h"
#include "common/geometry/camera.h"
#include "common/scene/objects.h"
#include "common/timeline/timeline.h"

namespace swath::sim {

// A cluster on modelled machines, and the run that it does.
struct ClusterScenario {
    std::span<const Object> objects;
    std::span<const Camera> cameras;  // one per frame, at least one
    int width = 1280;
    int height = 960;
    Algorithm algorithm = Algorithm::kHybrid;
    std::size_t servers = 1;  // 1 to kMaxServers
    std::size_t frames_in_flight = 3;
    Hardware hardware;
    bool keep_timelines = false;
    std::function<void()> on_picture = {};  // called for each that is complete; may be empty
};

// The share of the run, 0 to 1, for which a resource was at work; where several machines have it, that of the
// busiest. The run includes its beginning, when the display has nothing yet, and its end: with few frames
// even the bottleneck's share is less than 1.
struct ResourceUse {
    std::string resource;  // "server graphics", "display network", ...
    double share = 0;
};
ResourceUse busiest(std::span<const ResourceUse> use);  // the first of equal ones; `use` is not empty

struct ClusterRunCosts {
    // Mean time from one complete picture to the next, once the pipeline is full: over the last frames of the
    // run, as many whole rounds of frames in flight as follow a first picture. If there is no such round,
    // over all of the run. Work done ahead of that first picture is missing: some per cent with five frames,
    // almost nothing with ten.
    double frame_s = 0;
    double latency_s = 0;  // mean, from the beginning of partitioning to the complete picture
    double single_s = 0;   // mean over frame_s's frames: one server draws everything and does nothing else
    std::vector<ResourceUse> use;          // in a fixed order
    std::vector<FrameTimeline> timelines;  // if wanted
    std::uint64_t events = 0;
};

// Simulates client, servers, network and display, all at work on their frames at once. The real programs'
// objects drive the machines (partitioner, Director, FrameSwap, Assembly); only durations are modelled.
// Deterministic. Thread-safe: calls share nothing.
//
// A server with compositing on its graphics card has one frame on the card at a time: drawing, swath reads
// and writes and the tile's read follow one another there. With compositing in host memory one thread draws
// and reads back, and another codes, composites and gathers, also while the next frame is drawn.
ClusterRunCosts simulate(const ClusterScenario& scenario);

}  // namespace swath::sim
