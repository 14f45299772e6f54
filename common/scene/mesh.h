#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/base/result.h"
#include "common/geometry/box.h"

namespace swath {

// A vertex of 24 bytes, as the renderer uploads it and the model cache stores it (little-endian).
struct Vertex {
    glm::vec3 position{0};
    std::array<std::int16_t, 3> normal{0, 0, 32767};  // signed normalised, unit length
    std::uint16_t padding = 0;
    std::array<std::uint8_t, 4> colour{200, 200, 200, 255};  // RGBA; alpha is kept but not used
    bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 24);

// Indexed triangles: three indices each, every one below vertices.size(). A value.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    // Each triangle's material, as the model numbers them. Empty: all have number 0.
    std::vector<std::uint32_t> materials;
    // Each vertex's movement from pose 0 to pose 1. Empty: nothing moves. Normals and colours stay: parts
    // move but do not bend.
    std::vector<glm::vec3> motion;

    std::size_t triangle_count() const { return indices.size() / 3; }
    std::uint32_t material(std::size_t triangle) const { return materials.empty() ? 0 : materials[triangle]; }
    bool operator==(const Mesh&) const = default;
};

// The limits of a mesh: indices have 32 bits, and a number of triangles fits in 31.
inline constexpr std::size_t kMaxVertices = 0xffff'fff0;
inline constexpr std::size_t kMaxTriangles = 0x7fff'fff0;
inline constexpr std::uint32_t kMaxMaterials = 1u << 20;  // numbers are below it
// The largest absolute value of a coordinate: a float can hold the squared diagonal of such a model.
inline constexpr float kMaxCoordinate = 1e18f;

// A vertex's position at a pose, 0 to 1. Product and sum are each rounded, so that every machine gets the
// same bits.
inline glm::vec3 posed(const Mesh& mesh, std::uint32_t vertex, float pose) {
    const glm::vec3& at = mesh.vertices[vertex].position;
    return mesh.motion.empty() ? at : at + pose * mesh.motion[vertex];
}

// Fails if this mesh cannot be rendered: it has no triangles, an index is out of range, a coordinate at pose
// 0 or 1 is not finite or beyond kMaxCoordinate, only some vertices have a motion or some triangles a
// material, or a number is above its limit. The error says how many such there are and names the first.
// Triangles without area and unused vertices are allowed.
Status validate(const Mesh& mesh);

// The direction of `n`, of any length, as Vertex holds it. +z if it has none (zero or not finite).
std::array<std::int16_t, 3> pack_normal(const glm::vec3& n);

// Replaces every vertex's normal by the area-weighted mean of its triangles' normals, summed in their order.
// A vertex without a triangle of positive area gets +z. Indices must be in range.
void compute_normals(Mesh& mesh);

// The box around all triangles at a pose; unused vertices do not count. Indices must be in range.
Box bounds(const Mesh& mesh, float pose = 0);

}  // namespace swath
