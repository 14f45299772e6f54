#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/base/names.h"
#include "common/geometry/box.h"
#include "common/scene/mesh.h"

namespace swath {

// The unit of partitioning: the triangles of one material whose centres lie in one octree cell (Samanta 2000,
// section 7, which has no materials). The centre is that of a triangle's bounding box. The paper says
// centroid and does not define it; box centres come closer to its number of objects than the means of corners
// do (the Dragon at depth 4: 1,257 in the paper, 1,259 with box centres, 1,261 with means).
struct Object {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t first_leaf = 0;
    std::uint32_t leaf_count = 0;
    std::uint32_t material = 0;  // as in Mesh
    Box box;                     // of its whole triangles, not of the cell
    Box end_box = {};            // at pose 1; empty if the model does not move
    // Contains the object at a pose, 0 to 1.
    Box box_at(float pose) const { return swath::box_at(box, end_box, pose); }
    bool operator==(const Object&) const = default;
};

// The unit of culling: triangles of one object that are near each other.
struct Leaf {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    Box box;           // of its whole triangles
    Box end_box = {};  // at pose 1; empty if the model does not move
    Box box_at(float pose) const { return swath::box_at(box, end_box, pose); }
    bool operator==(const Leaf&) const = default;
};

// The octree whose cells objects are: the uniform one, all at one depth, or one whose planes follow the
// surface area heuristic (common/scene/sah_objects.h).
enum class ObjectsBy : std::uint8_t { kUniform, kSah };
template <>
inline constexpr auto kNames<ObjectsBy> = names_of<ObjectsBy>("", {{ObjectsBy::kUniform, "uniform"},
                                                                   {ObjectsBy::kSah, "sah"}});

// The fineness of the cut of a model into objects, and of these into leaves.
struct Granularity {
    // The depth of the uniform octree, 0 to kMaxOctreeDepth. Without it, the depth that comes closest to
    // `objects`. Not with kSah, whose octree has no one depth.
    std::optional<int> depth = std::nullopt;
    std::size_t objects = 1500;  // wished; with kSah at least 1
    // An object has as few leaves as can hold at most this many triangles each; their sizes differ by one at
    // most. Smaller leaves drop more and take longer to cull (docs/benchmarks.md has figures).
    std::uint32_t leaf_triangles = 128;  // at least 1
    ObjectsBy by = ObjectsBy::kUniform;
};
inline constexpr int kMaxOctreeDepth = 10;
inline constexpr std::size_t kMaxObjectsAsked = 1'000'000;

// The cut of a model into objects: all that every machine needs to repeat it. A value.
struct Cut {
    ObjectsBy by = ObjectsBy::kUniform;
    int depth = 0;            // of the octree, with kUniform
    std::size_t objects = 0;  // asked for, with kSah
    bool operator==(const Cut&) const = default;
};
Granularity granularity_of(const Cut& cut);
// A text for people, like "octree depth 4".
std::string to_string(const Cut& cut);

// A model cut into objects, and these into leaves. Triangles are sorted by material, then by cell, then by
// the Morton code of their centre in the model's tight, non-cubic box. So every object and every leaf is one
// range of triangles, and ascending objects and leaves have ascending triangles and materials. The uniform
// octree's cells follow the Morton codes, so its depth does not change a picture. Vertices are numbered by
// first use. A moving model is cut as it is at pose 0. Immutable after build_objects; any thread may read it.
struct ObjectSet {
    Mesh mesh;
    std::vector<Object> objects;  // never empty; objects[id]
    std::vector<Leaf> leaves;     // never empty
    Box bounds;                   // at pose 0
    Box end_bounds = {};          // at pose 1; empty if nothing moves
    Cut cut;

    bool moves() const { return !end_bounds.empty(); }
    // Contains the boxes of all leaves and objects at a pose.
    Box bounds_at(float pose) const { return box_at(bounds, end_bounds, pose); }
    // Contains the model at every pose.
    Box swept_bounds() const {
        Box box = bounds;
        box.extend(end_bounds);
        return box;
    }
};

// Cuts a model. `mesh` must be valid (see validate). Deterministic, and the same for the mesh of a set that
// was cut before, because triangles of one Morton code and material keep their order.
ObjectSet build_objects(Mesh mesh, const Granularity& granularity);

}  // namespace swath
