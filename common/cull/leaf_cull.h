#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/cull/culler.h"
#include "common/geometry/camera.h"
#include "common/scene/objects.h"
#include "common/scene/triangle_range.h"

namespace swath {

// The part of a group that is to be drawn, and its counts.
struct CullResult {
    std::vector<TriangleRange> ranges;   // ascending, and as few as possible
    std::vector<std::uint32_t> visible;  // for each object of the group, the triangles in its ranges
    std::uint64_t objects = 0;           // objects with a range
    std::uint64_t leaves = 0;
    std::uint64_t triangles = 0;
    std::optional<int> split_level;  // as Culler::split_level()
    bool operator==(const CullResult&) const = default;
};

// The boxes of a model's leaves at pose 0.
std::vector<Box> leaf_boxes(const ObjectSet& scene);

// Culls the leaves of a model for each frame. One thread at a time. The scene must outlive it.
class LeafCull {
  public:
    // A culler of leaf_boxes(scene), or null to cull nothing.
    LeafCull(std::unique_ptr<Culler> culler, const ObjectSet& scene);

    // The leaves of `group` (ascending ids, each below the number of objects) that may cover a pixel centre
    // of `rect`: all but those whose boxes at the view's pose are outside of make_frustum(view, rect, bounds
    // of the scene at that pose). Nothing if `rect` is empty. It culls the whole model, whatever the group,
    // which takes microseconds. If a moving model has a new pose, it first moves the boxes: O(leaves).
    CullResult cull(std::span<const ObjectId> group, const View& view, const Rect& rect);

  private:
    void pose(float pose);

    const ObjectSet& scene_;
    std::vector<Box> boxes_;  // of the leaves at pose_; empty if the model does not move or nothing is culled
    float pose_ = 0;          // of boxes_ and culler_
    std::unique_ptr<Culler> culler_;  // null: draws everything
};

}  // namespace swath
