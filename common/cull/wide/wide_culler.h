#pragma once
#include <cstdint>
#include <span>

#include "common/cull/culler.h"
#include "common/cull/wide/flat_scan.h"
#include "common/cull/wide/wide_hierarchy.h"

namespace swath {

// The culler that we use: the hierarchy, or the flat scan for frames in which the hierarchy would test so
// much that scanning all is quicker, as with boxes whose neighbours in order are far away. The choice follows
// from counts, never from a clock, and changes nothing but the time.
class WideCuller final : public Culler {
  public:
    WideCuller(std::span<const Box> boxes, ThreadTeam& team,
               InstructionSet instructions = best_instruction_set());

    std::span<const std::uint32_t> cull(const Frustum& frustum) override;
    // O(n), and allocates nothing. The more boxes lose their order, the more often they are scanned.
    void refit(std::span<const Box> boxes) override;
    bool scanned() const { return scanned_; }  // the last frame was a flat scan

  private:
    bool better_scanned(const Frustum& frustum);

    WideHierarchy hierarchy_;
    FlatScan scan_;
    bool scanned_ = false;
    bool small_ = false;  // the last frame tested little of the hierarchy
    // The part of the blocks below a crossing node of 256 boxes that cross a plane, too, in the last frame
    // that showed it. It tells a good order, of which it is about this, from a bad one.
    double crossing_part_ = 0.4;
};

}  // namespace swath
