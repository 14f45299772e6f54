#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
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
    Box end_box = {};            // at pose 1; empty if the model does not move
    // Around it at a pose of 0 to 1.
    Box box_at(float pose) const { return swath::box_at(box, end_box, pose); }
    bool operator==(const Object&) const = default;
};

// An atom of culling: some triangles of one object that are near to one another.
struct Leaf {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    Box box;           // of its whole triangles
    Box end_box = {};  // at pose 1; empty if the model does not move
    Box box_at(float pose) const { return swath::box_at(box, end_box, pose); }
    bool operator==(const Leaf&) const = default;
};

// What an object is a cell of: the uniform octree, all of one depth, or an octree whose planes follow the
// surface area heuristic (common/scene/sah_objects.h).
enum class ObjectsBy : std::uint8_t { kUniform, kSah };
std::string_view name_of(ObjectsBy by);
Result<ObjectsBy> parse_objects_by(std::string_view name);

// How finely to cut: to a depth of the uniform octree, or to the depth that comes closest to a number of
// objects, or to about so many cells of the SAH octree, which has no one depth; and each object to leaves of
// a number of triangles.
struct Granularity {
    std::optional<int> depth = std::nullopt;  // 0 to kMaxOctreeDepth; not with kSah
    std::size_t objects = 1500;               // used when there is no depth; with kSah at least 1
    // An object has as few leaves as hold this many at most, all of the same size but for one triangle.
    // Smaller ones drop more and take longer to cull (docs/benchmarks.md has figures).
    std::uint32_t leaf_triangles = 128;  // at least 1
    ObjectsBy by = ObjectsBy::kUniform;
};
inline constexpr int kMaxOctreeDepth = 10;
inline constexpr std::size_t kMaxObjectsAsked = 1'000'000;

// How a model was cut: all that it takes to cut it so again, on every machine. A value.
struct Cut {
    ObjectsBy by = ObjectsBy::kUniform;
    int depth = 0;            // kUniform: of the octree
    std::size_t objects = 0;  // kSah: the number asked for
    bool operator==(const Cut&) const = default;
};
Granularity granularity_of(const Cut& cut);
// For people: "octree depth 4".
std::string to_string(const Cut& cut);

// A model cut into objects, and these into leaves. Triangles are stored by material, those of one cell by
// cell and in a cell in the order of their centres' Morton codes in the model's tight, non-cubic box. So
// every object is a contiguous range, ascending object ids are ascending triangles and ascending materials,
// and ascending leaves are ascending triangles too. Cells of the uniform octree follow the Morton codes
// themselves: there a picture does not depend on the depth. Vertices are numbered by first use. What moves is
// cut as it is at pose 0. Immutable after build_objects; any thread may read it.
struct ObjectSet {
    Mesh mesh;
    std::vector<Object> objects;  // never empty; objects[id]
    std::vector<Leaf> leaves;     // never empty
    Box bounds;                   // at pose 0
    Box end_bounds = {};          // at pose 1; empty if nothing moves
    Cut cut;

    bool moves() const { return !end_bounds.empty(); }
    // Around all leaves' and objects' boxes at a pose.
    Box bounds_at(float pose) const { return box_at(bounds, end_bounds, pose); }
    // Around the model at every pose.
    Box swept_bounds() const {
        Box box = bounds;
        box.extend(end_bounds);
        return box;
    }
};

// Deterministic, and the same whether the mesh is the model's or that of a set that was cut from it before:
// triangles with one Morton code and material always keep their order. `mesh` must be valid (see validate).
ObjectSet build_objects(Mesh mesh, const Granularity& granularity);

}  // namespace swath
