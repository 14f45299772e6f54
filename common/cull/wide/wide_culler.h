#pragma once
#include <cstdint>
#include <span>

#include "common/cull/culler.h"
#include "common/cull/wide/flat_scan.h"
#include "common/cull/wide/wide_hierarchy.h"

namespace swath {

// The hierarchy, and the flat scan for frames in which it would have to look at so much that scanning
// everything is quicker: boxes in an order in which neighbours are far from each other. Which one it takes
// follows from counts, never from a clock, and shows in nothing but the time.
class WideCuller final : public Culler {
  public:
    WideCuller(std::span<const Box> boxes, ThreadTeam& team,
               InstructionSet instructions = best_instruction_set());

    std::span<const std::uint32_t> cull(const Frustum& frustum) override;
    // O(n), and allocates nothing. Boxes that have lost their order are the more often scanned.
    void refit(std::span<const Box> boxes) override;
    bool scanned() const { return scanned_; }  // the last frame was a flat scan

  private:
    bool better_scanned(const Frustum& frustum);

    WideHierarchy hierarchy_;
    FlatScan scan_;
    bool scanned_ = false;
    bool small_ = false;  // the last frame tested but a little of the hierarchy
    // Of the blocks below a node of 256 boxes that crosses a plane, the part that does so too: what tells a
    // good order from a bad one. From the last frame that shows it; this is about a good one's.
    double crossing_part_ = 0.4;
};

}  // namespace swath
