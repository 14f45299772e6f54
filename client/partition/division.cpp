#include "client/partition/division.h"

#include <algorithm>
#include <limits>

#include "common/base/check.h"

namespace swath {

FramePlan begin_plan(const PartitionInput& input, std::vector<Item>& items) {
    CHECK(input.servers >= 1u);
    CHECK(input.servers <= kMaxServers);
    CHECK(input.objects.size() <= kMaxObjects);
    const Rect viewport = input.view.viewport();
    CHECK(!viewport.empty());

    items.resize(input.objects.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const ProjectedObject& object = input.objects[i];
        CHECK(!object.box.empty());
        CHECK(viewport.contains(object.box));
        items[i] = {{object.box.x0, object.box.y0},
                    {object.box.x1, object.box.y1},
                    object.work,
                    static_cast<ObjectId>(i),
                    object.visible};
    }
    FramePlan plan;
    plan.frame = input.frame;
    plan.view = input.view;
    plan.servers.resize(input.servers);
    return plan;
}

ServerShare share_of(std::span<const Item> items, const Rect& tile) {
    ServerShare share;
    if (!tile.empty()) share.tile = {tile};
    share.group.resize(items.size());
    constexpr int kMost = std::numeric_limits<int>::max();
    Rect visible{kMost, kMost, 0, 0};
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        share.group[i] = item.id;
        if (!item.visible) continue;
        visible = {std::min(visible.x0, item.low[0]), std::min(visible.y0, item.low[1]),
                   std::max(visible.x1, item.high[0]), std::max(visible.y1, item.high[1])};
    }
    if (!visible.empty()) share.content = visible;
    return share;
}

Rect bounds_of(std::span<const ProjectedObject> objects) {
    Rect bounds;
    for (const ProjectedObject& object : objects) bounds = bounding(bounds, object.box);
    return bounds;
}

}  // namespace swath
