#pragma once
#include <cstddef>
#include <map>
#include <optional>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"
#include "client/predict/estimate.h"
#include "common/plan/frame_plan.h"
#include "common/timeline/timeline.h"

namespace swath {

// Learns this cluster's speed from the frames that it has drawn. A frame gives one sample of each rate, over
// all servers together, and the median of recent samples counts (see estimate.h). Drawing and reading back
// also have a fixed part a frame, as soon as frames differed enough to tell.
//
// Rates are of wall time: where programs share cores they include the sharing, and a prediction holds for as
// much sharing as there was. They hold for one renderer, picture size and culling; begin with a new object
// after a change of those. Sans-I/O; not thread-safe.
class Rates {
  public:
    static constexpr std::size_t kEnoughFrames = 4;

    // Learns from a frame that is over: its plan, by which algorithm from how many objects, and its timeline.
    // Spans or counters that a machine did not report teach nothing.
    void add(const FramePlan& plan, const FrameTimeline& timeline, Algorithm algorithm, std::size_t objects);

    // The cluster as hardware with compositing in host memory and culling; none until kEnoughFrames frames
    // have shown something of the model. The active share of a region depends on the algorithm: it comes from
    // that algorithm's frames or, if there were none, from the others'. Rates that only swaths can teach are
    // assumed until there are some. Drawing has no fill rate (its time goes by triangles), reading back
    // counts as the colour buffer's, and handing a tile to the connection as part of gathering it. The
    // network's times are not learned: 0.
    std::optional<Hardware> hardware(Algorithm algorithm) const;

  private:
    struct Shares {
        RecentMedian swath;
        RecentMedian tile;
    };

    RecentLine render_;    // per server, by triangles
    RecentLine readback_;  // per server, by pixels of its content
    RecentMedian code_s_;  // per pixel sent
    RecentMedian merge_s_;
    RecentMedian gather_s_;
    RecentMedian assemble_s_;
    RecentMedian client_;  // over the time of a client that takes 1 s to project an object
    RecentMedian swath_bytes_;
    RecentMedian tile_bytes_;
    std::map<Algorithm, Shares> shares_;
};

}  // namespace swath
