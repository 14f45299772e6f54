#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/base/result.h"
#include "common/geometry/box.h"

namespace swath {

// 24 bytes, laid out as the renderer uploads it and as the model cache stores it (little-endian).
struct Vertex {
    glm::vec3 position{0};
    std::array<std::int16_t, 3> normal{0, 0, 32767};  // signed normalised, unit length
    std::uint16_t padding = 0;
    std::array<std::uint8_t, 4> colour{200, 200, 200, 255};  // RGBA; alpha is kept and not used
    bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 24);

// Indexed triangles: three indices each, every one below vertices.size(). A value.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    // What each triangle is drawn with, as numbers of the model's own; empty: all with one, number 0.
    std::vector<std::uint32_t> materials;
    // Of a model that moves, how far each vertex goes from pose 0 to pose 1; empty: nothing moves. Normals
    // and colours stay as they are: parts move, they do not bend.
    std::vector<glm::vec3> motion;

    std::size_t triangle_count() const { return indices.size() / 3; }
    std::uint32_t material(std::size_t triangle) const { return materials.empty() ? 0 : materials[triangle]; }
    bool operator==(const Mesh&) const = default;
};

// The limits of a mesh: indices are 32 bits, and a triangle count fits in 31.
inline constexpr std::size_t kMaxVertices = 0xffff'fff0;
inline constexpr std::size_t kMaxTriangles = 0x7fff'fff0;
inline constexpr std::uint32_t kMaxMaterials = 1u << 20;  // numbers are below it
// The largest size of a coordinate: the squared diagonal of a model of this size still fits in a float.
inline constexpr float kMaxCoordinate = 1e18f;

// Where a vertex is at a pose of 0 to 1. Product and sum are rounded one after the other, so that it is the
// same bits on every machine.
inline glm::vec3 posed(const Mesh& mesh, std::uint32_t vertex, float pose) {
    const glm::vec3& at = mesh.vertices[vertex].position;
    return mesh.motion.empty() ? at : at + pose * mesh.motion[vertex];
}

// Why this mesh cannot be rendered, as one line, or success: no triangles, an index out of range, a
// coordinate that is not finite or above kMaxCoordinate, at pose 1 too, a motion or a material number for
// some only, or a number above its limit. The line says how many there are and names the first. Zero-area
// triangles and unreferenced vertices are allowed.
Status validate(const Mesh& mesh);

// The direction of `n`, which need not have unit length; +z where it has none (zero or not finite).
std::array<std::int16_t, 3> pack_normal(const glm::vec3& n);

// Replaces every normal by the area-weighted mean of its triangles' normals, summed in the order of the
// triangles; +z for a vertex without a triangle of positive area. Indices must be in range.
void compute_normals(Mesh& mesh);

// The box of the triangles at a pose: vertices that none of them uses do not count. Indices must be in range.
Box bounds(const Mesh& mesh, float pose = 0);

}  // namespace swath
