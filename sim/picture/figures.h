#pragma once
#include <span>
#include <vector>

#include "common/image/picture.h"
#include "common/plan/frame_plan.h"
#include "common/scene/objects.h"

namespace swath::sim {

// Samanta 2000's visualizations of a partition. `frame` is render_view of the plan's view, and the plan's ids
// are those of `objects`.

// Objects in more than one group, ascending; sort-first draws these several times.
std::vector<ObjectId> replicated_objects(const FramePlan& plan, std::size_t object_count);

// Figure 10a: highlights the boxes of replicated objects, and draws tile borders.
Picture replication_figure(Picture frame, const FramePlan& plan, std::span<const Object> objects);
// Figure 10b and c: shows transferred pixels in transparent white, the more often the whiter, and tile
// borders.
Picture transfer_figure(Picture frame, const FramePlan& plan);
// Figure 14, top: draws the boxes of all objects.
Picture boxes_figure(Picture frame, const View& view, std::span<const Object> objects);
// Figure 14, bottom: shows tiles in their servers' colours, and overlap regions in transparent white.
Picture overlap_figure(Picture frame, const FramePlan& plan);

}  // namespace swath::sim
