#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/scene/objects.h"

namespace swath {

// A range of triangles of one object that are drawn together, and the id that their pixels get.
struct TriangleRange {
    ObjectId object = 0;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    bool operator==(const TriangleRange&) const = default;
};

// The ranges of whole objects, in the order of `ids`. Every id must be below objects.size().
inline std::vector<TriangleRange> whole_objects(std::span<const Object> objects,
                                                std::span<const ObjectId> ids) {
    std::vector<TriangleRange> ranges;
    ranges.reserve(ids.size());
    for (const ObjectId id : ids)
        ranges.push_back({id, objects[id].first_triangle, objects[id].triangle_count});
    return ranges;
}

}  // namespace swath
