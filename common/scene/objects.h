#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/geometry/box.h"
#include "common/scene/mesh.h"

namespace swath {

// An atom of partitioning: the triangles of one material whose centres fall in one octree cell (Samanta 2000,
// section 7, which has no materials). A triangle's centre is that of its bounding box, not the mean of its
// corners: the paper says centroid and does not define it, and this one comes closer to its number of objects
// (the Dragon at depth 4 has 1,259 cells with box centres, 1,261 with means, in float and in double alike,
// and 1,257 in the paper).
struct Object {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t first_leaf = 0;
    std::uint32_t leaf_count = 0;
    std::uint32_t material = 0;  // as in Mesh
    Box box;                     // of its whole triangles, not of the cell
    bool operator==(const Object&) const = default;
};

// An atom of culling: some triangles of one object that are near to one another.
struct Leaf {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    Box box;  // of its whole triangles
    bool operator==(const Leaf&) const = default;
};

// How finely to cut: to a depth of the octree, or to the depth that comes closest to a number of objects, and
// each object to leaves of a number of triangles.
struct Granularity {
    std::optional<int> depth = std::nullopt;  // 0 to kMaxOctreeDepth
    std::size_t objects = 1500;               // used when there is no depth
    // An object has as few leaves as hold this many at most, all of the same size but for one triangle.
    // Smaller ones drop more and take longer to cull (docs/benchmarks.md has figures).
    std::uint32_t leaf_triangles = 128;  // at least 1
};
inline constexpr int kMaxOctreeDepth = 10;

// A model cut into objects, and these into leaves. Triangles are stored by material, those of one in the
// order of their centres' Morton codes in the model's tight, non-cubic box, so that every object of every
// depth is a contiguous range, ascending object ids are ascending triangles and ascending materials,
// ascending leaves are ascending triangles too, and a picture does not depend on the depth. Vertices are
// numbered by first use. Immutable after build_objects; any thread may read it.
struct ObjectSet {
    Mesh mesh;
    std::vector<Object> objects;  // never empty; objects[id]
    std::vector<Leaf> leaves;     // never empty
    Box bounds;
    int depth = 0;
};

// Deterministic. `mesh` must be valid (see validate).
ObjectSet build_objects(Mesh mesh, const Granularity& granularity);

}  // namespace swath
