#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "common/base/thread_team.h"
#include "common/cull/wide/box_blocks.h"
#include "common/cull/wide/flat_scan.h"
#include "common/cull/wide/wide_culler.h"
#include "common/geometry/box.h"
#include "common/geometry/frustum.h"
#include "common/published/resource/resource_sorter.h"
#include "common/published/resource/scratch.h"

namespace swath {

// Finds what a frame draws, in the order of resources: ADSB's RenderNodes together with its sections 8.2 and
// 8.3. Two ways give the same answer. A hierarchy of boxes finds few visible objects fast, but not in order.
// Testing every box always costs the same, but the boxes can lie in the order of their keys, and then nothing
// is left to sort. The cheaper way depends on how much is visible, so each frame goes by the one before.
//
// One thread at a time. The team must outlive it and be idle when it is called.
class CullAndSort {
  public:
    enum class Way {
        kHierarchy,  // cull(), then ResourceSorter
        kScan,       // every box, in the order of the keys
    };

    // Object `id` has boxes[id] and keys[id]. Copies what it needs. Neighbouring ids should be near each
    // other in space, as for WideCuller.
    CullAndSort(std::span<const Box> boxes, std::span<const std::uint32_t> keys, ThreadTeam& team);

    // The ids of all boxes that are not outside(frustum, box), by (key, id). Valid until the next call.
    std::span<const std::uint32_t> cull(const Frustum& frustum);
    // Does the same in a given way.
    std::span<const std::uint32_t> cull(const Frustum& frustum, Way way);

    // The way of the next cull(frustum): kHierarchy before the first.
    Way next_way() const;
    // The way of the last one.
    Way way() const { return way_; }
    const ResourceSorter& sorter() const { return sorter_; }

  private:
    std::span<const std::uint32_t> ids_of(std::span<const std::uint32_t> ranks);

    ThreadTeam& team_;
    ResourceSorter sorter_;
    WideCuller hierarchy_;
    // The boxes by rank. Null if ids are ranks.
    struct Scan {
        Scan(std::span<const Box> by_rank, ThreadTeam& team) : boxes(by_rank), scan(boxes, team) {}
        BoxBlocks boxes;
        FlatScan scan;
    };
    std::unique_ptr<Scan> scan_;
    Scratch<std::uint32_t> scanned_;
    std::size_t last_visible_ = 0;
    Way way_ = Way::kHierarchy;
};

}  // namespace swath
