#pragma once
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/geometry/camera.h"
#include "common/scene/objects.h"

namespace swath {

// The objects of `group` (ascending ids) that may touch a pixel, in the same order: all but those certainly
// outside the view's frustum. Every id must be below objects.size(). Pure.
std::vector<ObjectId> cull(std::span<const Object> objects, std::span<const ObjectId> group,
                           const View& view);

}  // namespace swath
