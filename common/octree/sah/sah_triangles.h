#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace swath {

// A view of the triangles that a tree is built over: three indices each, into positions of three floats that
// are `stride` bytes apart.
struct SahTriangles {
    const std::byte* positions = nullptr;
    std::size_t stride = 0;
    std::size_t position_count = 0;
    std::span<const std::uint32_t> indices;

    std::size_t count() const { return indices.size() / 3; }
};

}  // namespace swath
