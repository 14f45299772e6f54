#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// A Morton code is a point's cell in a box, of 2^kMortonDepth cells along each axis, with the axes' bits
// interleaved, x lowest. Points that are neighbours in the order of codes are near each other.
inline constexpr int kMortonDepth = 10;
inline constexpr int kMortonBits = 3 * kMortonDepth;

struct MortonKey {
    std::uint32_t code;
    std::uint32_t index;
};

// Interleaves the lowest ten bits of each: bit i of `first` becomes bit 3 i, of `second` bit 3 i + 1, of
// `third` bit 3 i + 2.
std::uint32_t interleave(std::uint32_t first, std::uint32_t second, std::uint32_t third);

// The code of a point in the box at `min`. Sums and quotients of floats are as good as exact in double, so
// the model and not rounding decides on which side of a cell's border a point falls. A point outside of the
// box gets the nearest cell.
std::uint32_t morton_code(const glm::dvec3& point, const glm::dvec3& min, const glm::dvec3& size);

// Sorts stably by the lowest `bits` bits of the code. O(n).
void sort_by_code(std::vector<MortonKey>& keys, int bits = kMortonBits);

// Sorts boxes by the Morton codes of their centres in the box around all: element i is the index of the i-th
// box. Boxes that are empty or not finite get code 0. At most 2^32 boxes. O(n).
std::vector<std::uint32_t> morton_order(std::span<const Box> boxes);

}  // namespace swath
