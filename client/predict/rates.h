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

// How fast this cluster is, learned from the frames that it has drawn. Of each frame every rate is one
// sample, all servers together, and the median of recent samples counts (see estimate.h); drawing and reading
// back have a part that each frame costs besides, as soon as frames were different enough to tell.
//
// Rates are of the spans' wall time: where programs share cores they contain the sharing, and a prediction
// holds for as much sharing as there was. They are of one renderer, size of picture and way to cull: after a
// change of those begin anew. Sans-I/O; not thread-safe.
class Rates {
  public:
    static constexpr std::size_t kEnoughFrames = 4;

    // A frame that is over: what was decided, by which algorithm from how many objects, and what came of it.
    // Spans and counters are as the machines reported them; what they left out teaches nothing.
    void add(const FramePlan& plan, const FrameTimeline& timeline, Algorithm algorithm, std::size_t objects);

    // The cluster as the cost model takes it, with compositing in host memory and culling. Nothing until
    // kEnoughFrames frames have shown something of the model. How many of a region's pixels are active
    // depends on the algorithm: the share is that of its own frames or, where there were none, of the others.
    // What only swaths could have taught is assumed until there are some. Drawing has no fill rate (its time
    // goes by triangles), reading back counts as the colour buffer's, and handing a tile to the connection
    // as part of gathering it. What the network takes is not learned: 0.
    std::optional<Hardware> hardware(Algorithm algorithm) const;

  private:
    struct Shares {
        RecentMedian swath;
        RecentMedian tile;
    };

    RecentLine render_;    // a server's, by triangles
    RecentLine readback_;  // a server's, by pixels of its content
    RecentMedian code_s_;  // for each pixel that is sent
    RecentMedian merge_s_;
    RecentMedian gather_s_;
    RecentMedian assemble_s_;
    RecentMedian client_;  // its time over that of a client that takes 1 s to transform an object
    RecentMedian swath_bytes_;
    RecentMedian tile_bytes_;
    std::map<Algorithm, Shares> shares_;
};

}  // namespace swath
