#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/cull/culler.h"
#include "common/geometry/camera.h"
#include "common/scene/draw_run.h"
#include "common/scene/objects.h"

namespace swath {

// What of a group is to be drawn.
struct DrawList {
    std::vector<DrawRun> runs;           // ascending; as few as there can be
    std::vector<std::uint32_t> visible;  // triangles in the runs of each object, by its place in the group
    std::uint64_t objects = 0;           // that have a run
    std::uint64_t leaves = 0;
    std::uint64_t triangles = 0;
    std::optional<int> split_level;  // as Culler::split_level()
    bool operator==(const DrawList&) const = default;
};

// The boxes of a model's leaves at pose 0.
std::vector<Box> leaf_boxes(const ObjectSet& scene);

// Culls the leaves of a model, frame by frame. One thread at a time; the scene must outlive it.
class LeafCull {
  public:
    // A culler of leaf_boxes(scene), or null to cull nothing.
    LeafCull(std::unique_ptr<Culler> culler, const ObjectSet& scene);

    // Those leaves of `group` (ascending ids, each below the number of objects) that may cover a pixel centre
    // of `rect`: all but those whose boxes at the view's pose are outside make_frustum(view, rect, bounds of
    // the scene at that pose). Nothing if `rect` is empty. Always culls the whole model, whatever the group:
    // that takes microseconds. A new pose of a model that moves comes first: O(leaves).
    DrawList cull(std::span<const ObjectId> group, const View& view, const Rect& rect);

  private:
    void pose(float pose);

    const ObjectSet& scene_;
    std::vector<Box> boxes_;  // of the leaves at pose_; empty if the model does not move, or none culls
    float pose_ = 0;          // of boxes_ and culler_
    std::unique_ptr<Culler> culler_;  // null: none
};

}  // namespace swath
