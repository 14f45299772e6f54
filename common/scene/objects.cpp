#include "common/scene/objects.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/base/check.h"
#include "common/geometry/morton.h"

namespace swath {
namespace {

constexpr int kCodeBits = 3 * kMaxOctreeDepth;
static_assert(kMaxOctreeDepth == kMortonDepth);

// A triangle and the Morton code of its centre.
struct Key {
    std::uint32_t code;
    std::uint32_t triangle;
};

std::vector<Key> morton_keys(const Mesh& mesh, const Box& box) {
    const glm::dvec3 min(box.min);
    const glm::dvec3 size = glm::dvec3(box.max) - min;
    std::vector<Key> keys(mesh.triangle_count());
    for (std::size_t t = 0; t < keys.size(); ++t) {
        Box triangle;
        for (std::size_t corner = 0; corner < 3; ++corner)
            triangle.extend(mesh.vertices[mesh.indices[3 * t + corner]].position);
        const glm::dvec3 centre = 0.5 * (glm::dvec3(triangle.min) + glm::dvec3(triangle.max));
        keys[t].code = morton_code(centre, min, size);
        keys[t].triangle = static_cast<std::uint32_t>(t);
    }
    return keys;
}

// Stable, least significant digit first: triangles of one code keep the model's order.
void radix_sort(std::vector<Key>& keys) {
    constexpr int kDigitBits = 10;
    constexpr std::uint32_t kMask = (1u << kDigitBits) - 1;
    std::vector<Key> other(keys.size());
    for (int shift = 0; shift < kCodeBits; shift += kDigitBits) {
        std::array<std::size_t, (1u << kDigitBits)> place{};
        for (const Key& key : keys) ++place[key.code >> shift & kMask];
        std::size_t sum = 0;
        for (std::size_t& p : place) sum += std::exchange(p, sum);
        for (const Key& key : keys) other[place[key.code >> shift & kMask]++] = key;
        keys.swap(other);
    }
}

// The depth asked for, or the one whose number of occupied cells is closest to the number asked for; the
// shallower of two that are equally close.
int choose_depth(const std::vector<Key>& keys, const Granularity& granularity) {
    if (granularity.depth) return *granularity.depth;
    std::array<std::size_t, kMaxOctreeDepth + 1> cells{};
    cells.fill(1);
    for (std::size_t i = 1; i < keys.size(); ++i) {
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

// The mesh with its triangles in the order of `keys` and its vertices in the order of their first use.
Mesh reorder(const Mesh& mesh, const std::vector<Key>& keys) {
    constexpr std::uint32_t kUnused = 0xffff'ffff;
    static_assert(kMaxVertices < kUnused);
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), kUnused);
    Mesh result;
    result.indices.reserve(mesh.indices.size());
    result.vertices.reserve(mesh.vertices.size());
    for (const Key& key : keys) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t old = mesh.indices[3 * std::size_t{key.triangle} + corner];
            if (numbers[old] == kUnused) {
                numbers[old] = static_cast<std::uint32_t>(result.vertices.size());
                result.vertices.push_back(mesh.vertices[old]);
            }
            result.indices.push_back(numbers[old]);
        }
    }
    return result;
}

}  // namespace

ObjectSet build_objects(Mesh mesh, const Granularity& granularity) {
    CHECK(mesh.triangle_count() > 0u);
    CHECK(mesh.triangle_count() <= kMaxTriangles);
    CHECK(granularity.depth.value_or(0) >= 0);
    CHECK(granularity.depth.value_or(0) <= kMaxOctreeDepth);

    ObjectSet set;
    set.bounds = bounds(mesh);
    std::vector<Key> keys = morton_keys(mesh, set.bounds);
    radix_sort(keys);
    set.depth = choose_depth(keys, granularity);
    set.mesh = reorder(mesh, keys);

    const int shift = kCodeBits - 3 * set.depth;
    for (std::size_t t = 0; t < keys.size(); ++t) {
        if (t == 0 || keys[t].code >> shift != keys[t - 1].code >> shift)
            set.objects.push_back(
                {.first_triangle = static_cast<std::uint32_t>(t), .triangle_count = 0, .box = {}});
        Object& object = set.objects.back();
        ++object.triangle_count;
        for (std::size_t corner = 0; corner < 3; ++corner)
            object.box.extend(set.mesh.vertices[set.mesh.indices[3 * t + corner]].position);
    }
    return set;
}

}  // namespace swath
