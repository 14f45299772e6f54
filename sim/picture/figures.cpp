#include "sim/picture/figures.h"

#include <utility>

#include "common/base/check.h"
#include "sim/picture/layers.h"

namespace swath::sim {
namespace {

// The model is dimmed, so that the layers over it stand out.
constexpr double kBrightness = 0.6;
constexpr double kTint = 0.32;
constexpr Ink kReplicated{{255, 196, 46}, 0.95};
constexpr Ink kBoxes{{130, 205, 255}, 0.8};

}  // namespace

std::vector<ObjectId> replicated_objects(const FramePlan& plan, std::size_t object_count) {
    std::vector<unsigned> groups(object_count);
    for (const ServerShare& share : plan.servers)
        for (const ObjectId id : share.group) {
            CHECK(id < object_count);
            ++groups[id];
        }
    std::vector<ObjectId> replicated;
    for (std::size_t id = 0; id < object_count; ++id)
        if (groups[id] > 1) replicated.push_back(static_cast<ObjectId>(id));
    return replicated;
}

Picture replication_figure(Picture frame, const FramePlan& plan, std::span<const Object> objects) {
    std::vector<Box> boxes;
    for (const ObjectId id : replicated_objects(plan, objects.size()))
        boxes.push_back(objects[id].box_at(plan.view.pose));
    Picture picture = with_tile_borders(dimmed(std::move(frame), kBrightness), plan);
    return with_wireframes(std::move(picture), boxes, plan.view, kReplicated);
}

Picture transfer_figure(Picture frame, const FramePlan& plan) {
    return with_tile_borders(with_transfers(dimmed(std::move(frame), kBrightness), plan), plan);
}

Picture boxes_figure(Picture frame, const View& view, std::span<const Object> objects) {
    std::vector<Box> boxes;
    for (const Object& object : objects) boxes.push_back(object.box_at(view.pose));
    return with_wireframes(dimmed(std::move(frame), kBrightness), boxes, view, kBoxes);
}

Picture overlap_figure(Picture frame, const FramePlan& plan) {
    Picture picture = with_tile_tints(dimmed(std::move(frame), kBrightness), plan, kTint);
    return with_tile_borders(with_transfers(std::move(picture), plan), plan);
}

}  // namespace swath::sim
