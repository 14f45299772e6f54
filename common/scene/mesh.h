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

    std::size_t triangle_count() const { return indices.size() / 3; }
    bool operator==(const Mesh&) const = default;
};

// The limits of a mesh: indices are 32 bits, and a triangle count fits in 31.
inline constexpr std::size_t kMaxVertices = 0xffff'fff0;
inline constexpr std::size_t kMaxTriangles = 0x7fff'fff0;

// Why this mesh cannot be rendered, as one line, or success: no triangles, an index out of range, a
// coordinate that is not finite, or so large that its square overflows. Zero-area triangles are allowed.
Status validate(const Mesh& mesh);

std::array<std::int16_t, 3> pack_normal(const glm::vec3& n);

// Replaces every normal by the area-weighted mean of its triangles' normals.
void compute_normals(Mesh& mesh);

Box bounds(const Mesh& mesh);

}  // namespace swath
