#include "common/scene/objects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "common/base/check.h"
#include "common/geometry/morton.h"
#include "common/scene/sah_objects.h"

namespace swath {
namespace {

constexpr int kCodeBits = 3 * kMaxOctreeDepth;
static_assert(kMaxOctreeDepth == kMortonDepth);

// The box of `count` triangles from `first` on, at a pose.
Box box_of(const Mesh& mesh, std::uint32_t first, std::uint32_t count, float pose) {
    Box box;
    for (std::size_t i = 3 * std::size_t{first}; i < 3 * (std::size_t{first} + count); ++i)
        box.extend(posed(mesh, mesh.indices[i], pose));
    return box;
}

// The Morton codes of the triangles' centres.
std::vector<MortonKey> morton_keys(const Mesh& mesh, const Box& box) {
    const glm::dvec3 min(box.min);
    const glm::dvec3 size = glm::dvec3(box.max) - min;
    std::vector<MortonKey> keys(mesh.triangle_count());
    for (std::size_t t = 0; t < keys.size(); ++t) {
        const Box triangle = box_of(mesh, static_cast<std::uint32_t>(t), 1, 0);
        const glm::dvec3 centre = 0.5 * (glm::dvec3(triangle.min) + glm::dvec3(triangle.max));
        keys[t].code = morton_code(centre, min, size);
        keys[t].index = static_cast<std::uint32_t>(t);
    }
    return keys;
}

// Sorts stably by material, then by code.
void sort(std::vector<MortonKey>& keys, const Mesh& mesh) {
    sort_by_code(keys);
    if (mesh.materials.empty()) return;
    std::vector<MortonKey> by_material(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        by_material[i] = {mesh.materials[keys[i].index], static_cast<std::uint32_t>(i)};
    sort_by_code(by_material, static_cast<int>(std::bit_width(*std::ranges::max_element(mesh.materials))));
    std::vector<MortonKey> sorted;
    sorted.reserve(keys.size());
    for (const MortonKey& material : by_material) sorted.push_back(keys[material.index]);
    keys = std::move(sorted);
}

// The depth asked for, or the one whose number of objects (the occupied cells of each material) is closest to
// the number asked for; the shallower of two that are equally close.
int choose_depth(const std::vector<MortonKey>& keys, const Mesh& mesh, const Granularity& granularity) {
    if (granularity.depth) return *granularity.depth;
    std::array<std::size_t, kMaxOctreeDepth + 1> cells{};
    cells.fill(1);
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (mesh.material(keys[i - 1].index) != mesh.material(keys[i].index)) {
            for (std::size_t& count : cells) ++count;
            continue;
        }
        const std::uint32_t difference = keys[i - 1].code ^ keys[i].code;
        for (int depth = kMaxOctreeDepth; depth > 0 && difference >> (kCodeBits - 3 * depth) != 0; --depth)
            ++cells[static_cast<std::size_t>(depth)];
    }
    const auto distance = [&](int depth) {
        const std::size_t count = cells[static_cast<std::size_t>(depth)];
        return count > granularity.objects ? count - granularity.objects : granularity.objects - count;
    };
    int best = 0;
    for (int depth = 1; depth <= kMaxOctreeDepth; ++depth)
        if (distance(depth) < distance(best)) best = depth;
    return best;
}

// Takes keys sorted by sort(), replaces their codes by the numbers of SAH octree cells, and sorts by those.
void sort_by_sah_cells(std::vector<MortonKey>& keys, const Mesh& mesh, const Box& box, std::size_t objects) {
    std::vector<SahTriangle> triangles(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        triangles[i] = {box_of(mesh, keys[i].index, 1, 0), keys[i].code, mesh.material(keys[i].index)};
    const std::vector<std::uint32_t> cells = sah_cells(triangles, box, objects);
    CHECK(cells.size() == keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        CHECK(cells[i] >> kMortonBits == 0u);
        keys[i].code = cells[i];
    }
    sort(keys, mesh);
}

// The mesh with its triangles in the order of `keys` and its vertices in the order of their first use.
Mesh reorder(const Mesh& mesh, const std::vector<MortonKey>& keys) {
    constexpr std::uint32_t kUnused = 0xffff'ffff;
    static_assert(kMaxVertices < kUnused);
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), kUnused);
    Mesh result;
    result.indices.reserve(mesh.indices.size());
    result.vertices.reserve(mesh.vertices.size());
    result.materials.reserve(mesh.materials.size());
    result.motion.reserve(mesh.motion.size());
    for (const MortonKey& key : keys) {
        if (!mesh.materials.empty()) result.materials.push_back(mesh.materials[key.index]);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t old = mesh.indices[3 * std::size_t{key.index} + corner];
            if (numbers[old] == kUnused) {
                numbers[old] = static_cast<std::uint32_t>(result.vertices.size());
                result.vertices.push_back(mesh.vertices[old]);
                if (!mesh.motion.empty()) result.motion.push_back(mesh.motion[old]);
            }
            result.indices.push_back(numbers[old]);
        }
    }
    return result;
}

// Cuts an object's range of triangles into leaves of even size, and sets its leaves and boxes.
void add_leaves(ObjectSet& set, Object& object, std::uint32_t leaf_triangles) {
    const std::uint64_t count = object.triangle_count;
    const std::uint64_t leaves = (count + leaf_triangles - 1) / leaf_triangles;
    object.first_leaf = static_cast<std::uint32_t>(set.leaves.size());
    object.leaf_count = static_cast<std::uint32_t>(leaves);
    for (std::uint64_t i = 0; i < leaves; ++i) {
        const auto begin = static_cast<std::uint32_t>(count * i / leaves);
        const auto end = static_cast<std::uint32_t>(count * (i + 1) / leaves);
        Leaf& leaf = set.leaves.emplace_back();
        leaf.first_triangle = object.first_triangle + begin;
        leaf.triangle_count = end - begin;
        leaf.box = box_of(set.mesh, leaf.first_triangle, leaf.triangle_count, 0);
        object.box.extend(leaf.box);
        if (set.mesh.motion.empty()) continue;
        leaf.end_box = box_of(set.mesh, leaf.first_triangle, leaf.triangle_count, 1);
        object.end_box.extend(leaf.end_box);
    }
}

}  // namespace

Granularity granularity_of(const Cut& cut) {
    Granularity granularity;
    granularity.by = cut.by;
    if (cut.by == ObjectsBy::kSah)
        granularity.objects = cut.objects;
    else
        granularity.depth = cut.depth;
    return granularity;
}

std::string to_string(const Cut& cut) {
    return cut.by == ObjectsBy::kSah ? fmt::format("SAH octree, {} asked for", cut.objects)
                                     : fmt::format("octree depth {}", cut.depth);
}

ObjectSet build_objects(Mesh mesh, const Granularity& granularity) {
    CHECK(mesh.triangle_count() > 0u);
    CHECK(mesh.triangle_count() <= kMaxTriangles);
    CHECK(granularity.depth.value_or(0) >= 0);
    CHECK(granularity.depth.value_or(0) <= kMaxOctreeDepth);
    CHECK(granularity.leaf_triangles > 0u);
    if (granularity.by == ObjectsBy::kSah) {
        CHECK(granularity.objects > 0u);
        CHECK(granularity.depth.has_value() == false);
    }

    ObjectSet set;
    set.bounds = bounds(mesh);
    std::vector<MortonKey> keys = morton_keys(mesh, set.bounds);
    sort(keys, mesh);
    // From here on a key's code is that of its cell.
    set.cut.by = granularity.by;
    if (granularity.by == ObjectsBy::kSah) {
        set.cut.objects = granularity.objects;
        sort_by_sah_cells(keys, mesh, set.bounds, granularity.objects);
    } else {
        set.cut.depth = choose_depth(keys, mesh, granularity);
        const int shift = kCodeBits - 3 * set.cut.depth;
        for (MortonKey& key : keys) key.code >>= shift;
    }
    set.mesh = reorder(mesh, keys);

    const auto begins = [&](std::size_t t) {
        return t == 0 || keys[t].code != keys[t - 1].code || set.mesh.material(t) != set.mesh.material(t - 1);
    };
    for (std::size_t t = 0; t < keys.size(); ++t) {
        if (begins(t)) {
            Object& object = set.objects.emplace_back();
            object.first_triangle = static_cast<std::uint32_t>(t);
            object.material = set.mesh.material(t);
        }
        ++set.objects.back().triangle_count;
    }
    for (Object& object : set.objects) {
        add_leaves(set, object, granularity.leaf_triangles);
        set.end_bounds.extend(object.end_box);
    }
    return set;
}

}  // namespace swath
