#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/geometry/box.h"
#include "common/scene/mesh.h"

namespace swath {

// An atom of partitioning: the triangles whose centres fall in one octree cell (Samanta 2000, section 7). A
// triangle's centre is that of its bounding box, not the mean of its corners: the paper says centroid and
// does not define it, and this one comes closer to its number of objects (the Dragon at depth 4 has 1,259
// cells with box centres, 1,261 with means, in float and in double alike, and 1,257 in the paper).
struct Object {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    Box box;  // of its whole triangles, not of the cell
    bool operator==(const Object&) const = default;
};

// How finely to cut: to a depth of the octree, or to the depth that comes closest to a number of objects.
struct Granularity {
    std::optional<int> depth;    // 0 to kMaxOctreeDepth
    std::size_t objects = 1500;  // used when there is no depth
};
inline constexpr int kMaxOctreeDepth = 10;

// A model cut into objects. Triangles are stored in the order of their centres' Morton codes in the model's
// tight, non-cubic box, so that every object of every depth is a contiguous range, ascending object ids are
// ascending triangles, and a picture does not depend on the depth. Vertices are numbered by first use.
// Immutable after build_objects; any thread may read it.
struct ObjectSet {
    Mesh mesh;
    std::vector<Object> objects;  // never empty; objects[id]
    Box bounds;
    int depth = 0;
};

// Deterministic. `mesh` must be valid (see validate).
ObjectSet build_objects(Mesh mesh, const Granularity& granularity);

}  // namespace swath
