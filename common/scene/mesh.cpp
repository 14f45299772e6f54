#include "common/scene/mesh.h"

#include <cmath>

namespace swath {
namespace {

// Computes in double, so that squares of the largest coordinates do not overflow and those of the smallest do
// not vanish.
std::array<std::int16_t, 3> pack(const glm::dvec3& n) {
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 32767};
    const auto component = [&](double value) {
        const double scaled = value / length * 32767.0;
        return static_cast<std::int16_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
    };
    return {component(n.x), component(n.y), component(n.z)};
}

bool usable(const glm::vec3& point) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(point[axis]) || std::abs(point[axis]) > kMaxCoordinate) return false;
    return true;
}

// Counts things of a kind and keeps the index of the first.
struct Tally {
    std::size_t count = 0;
    std::size_t first = 0;

    void add(std::size_t at) {
        if (count++ == 0) first = at;
    }
};

}  // namespace

Status validate(const Mesh& mesh) {
    if (mesh.indices.empty()) return fail("no triangles");
    if (mesh.indices.size() % 3 != 0) return fail("{} indices, not three a triangle", mesh.indices.size());
    if (mesh.triangle_count() > kMaxTriangles)
        return fail("{} triangles, the limit is {}", mesh.triangle_count(), kMaxTriangles);
    if (mesh.vertices.size() > kMaxVertices)
        return fail("{} vertices, the limit is {}", mesh.vertices.size(), kMaxVertices);

    Tally outside;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        if (mesh.indices[i] >= mesh.vertices.size()) outside.add(i);
    if (outside.count > 0)
        return fail("{} indices out of range, the first in triangle {}: {} of {} vertices", outside.count,
                    outside.first / 3, mesh.indices[outside.first], mesh.vertices.size());

    if (!mesh.materials.empty() && mesh.materials.size() != mesh.triangle_count())
        return fail("{} material numbers for {} triangles", mesh.materials.size(), mesh.triangle_count());
    Tally unknown;
    for (std::size_t t = 0; t < mesh.materials.size(); ++t)
        if (mesh.materials[t] >= kMaxMaterials) unknown.add(t);
    if (unknown.count > 0)
        return fail("{} material numbers out of range, the first of triangle {}: {}, the limit is {}",
                    unknown.count, unknown.first, mesh.materials[unknown.first], kMaxMaterials - 1);

    Tally wild;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (!usable(mesh.vertices[i].position)) wild.add(i);
    if (wild.count > 0) {
        const glm::vec3& p = mesh.vertices[wild.first].position;
        return fail("{} vertices not finite or beyond {}, the first is vertex {}: {} {} {}", wild.count,
                    kMaxCoordinate, wild.first, p.x, p.y, p.z);
    }

    if (!mesh.motion.empty() && mesh.motion.size() != mesh.vertices.size())
        return fail("{} motions for {} vertices", mesh.motion.size(), mesh.vertices.size());
    Tally lost;
    for (std::size_t i = 0; i < mesh.motion.size(); ++i)
        if (!usable(posed(mesh, static_cast<std::uint32_t>(i), 1))) lost.add(i);
    if (lost.count > 0) {
        const glm::vec3& m = mesh.motion[lost.first];
        return fail(
            "{} vertices move to where they are not finite or beyond {}, the first is vertex {}: by {} {} {}",
            lost.count, kMaxCoordinate, lost.first, m.x, m.y, m.z);
    }
    return {};
}

std::array<std::int16_t, 3> pack_normal(const glm::vec3& n) { return pack(glm::dvec3(n)); }

void compute_normals(Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.vertices.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i];
        const std::uint32_t b = mesh.indices[i + 1];
        const std::uint32_t c = mesh.indices[i + 2];
        const glm::dvec3 origin(mesh.vertices[a].position);
        // Its length, twice the triangle's area, is its weight.
        const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.vertices[b].position) - origin,
                                             glm::dvec3(mesh.vertices[c].position) - origin);
        sums[a] += normal;
        sums[b] += normal;
        sums[c] += normal;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) mesh.vertices[i].normal = pack(sums[i]);
}

Box bounds(const Mesh& mesh, float pose) {
    Box box;
    for (const std::uint32_t i : mesh.indices) box.extend(posed(mesh, i, pose));
    return box;
}

}  // namespace swath
