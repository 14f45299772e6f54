#include "common/cull/leaf_cull.h"

#include "common/base/check.h"
#include "common/geometry/frustum.h"

namespace swath {
namespace {

CullResult whole(const ObjectSet& scene, std::span<const ObjectId> group) {
    CullResult list;
    list.ranges = whole_objects(scene.objects, group);
    list.objects = group.size();
    list.visible.reserve(group.size());
    for (const ObjectId id : group) {
        const Object& object = scene.objects[id];
        list.visible.push_back(object.triangle_count);
        list.leaves += object.leaf_count;
        list.triangles += object.triangle_count;
    }
    return list;
}

}  // namespace

std::vector<Box> leaf_boxes(const ObjectSet& scene) {
    std::vector<Box> boxes;
    boxes.reserve(scene.leaves.size());
    for (const Leaf& leaf : scene.leaves) boxes.push_back(leaf.box);
    return boxes;
}

LeafCull::LeafCull(std::unique_ptr<Culler> culler, const ObjectSet& scene)
    : scene_(scene), culler_(std::move(culler)) {
    if (culler_ && scene.moves()) boxes_ = leaf_boxes(scene);
}

// Moves the leaves to the pose, unless they are there.
void LeafCull::pose(float pose) {
    if (boxes_.empty() || pose == pose_) return;
    pose_ = pose;
    for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i] = scene_.leaves[i].box_at(pose);
    culler_->refit(boxes_);
}

CullResult LeafCull::cull(std::span<const ObjectId> group, const View& view, const Rect& rect) {
    if (!group.empty()) CHECK(group.back() < scene_.objects.size());
    CullResult list;
    if (rect.empty() || group.empty()) {
        list.visible.resize(group.size());
        return list;
    }
    if (!culler_) return whole(scene_, group);

    pose(view.pose);
    const auto leaves = culler_->cull(make_frustum(view, rect, scene_.bounds_at(view.pose)));
    list.split_level = culler_->split_level();
    list.visible.reserve(group.size());
    std::size_t at = 0;  // both lists ascend
    for (const ObjectId id : group) {
        const Object& object = scene_.objects[id];
        const std::uint32_t end = object.first_leaf + object.leaf_count;
        std::uint32_t visible = 0;
        while (at < leaves.size() && leaves[at] < object.first_leaf) ++at;
        for (; at < leaves.size() && leaves[at] < end; ++at) {
            const Leaf& leaf = scene_.leaves[leaves[at]];
            if (visible > 0 &&
                list.ranges.back().first_triangle + list.ranges.back().triangle_count == leaf.first_triangle)
                list.ranges.back().triangle_count += leaf.triangle_count;
            else
                list.ranges.push_back({id, leaf.first_triangle, leaf.triangle_count});
            visible += leaf.triangle_count;
            ++list.leaves;
        }
        list.visible.push_back(visible);
        list.triangles += visible;
        list.objects += visible > 0 ? 1 : 0;
    }
    return list;
}

}  // namespace swath
