#include "common/cull/frustum_cull.h"

#include "common/geometry/frustum.h"

namespace swath {

std::vector<ObjectId> cull(std::span<const Object> objects, std::span<const ObjectId> group,
                           const View& view) {
    const Frustum frustum = make_frustum(view);
    std::vector<ObjectId> visible;
    visible.reserve(group.size());
    for (const ObjectId id : group)
        if (!outside(frustum, objects[id].box)) visible.push_back(id);
    return visible;
}

}  // namespace swath
