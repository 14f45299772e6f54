#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// The Morton code of a point in a box: the box's cell that it is in, of 2^kMortonDepth along each axis, with
// the axes' bits interleaved, x lowest. Points next to each other in the order of their codes are near.
inline constexpr int kMortonDepth = 10;
inline constexpr int kMortonBits = 3 * kMortonDepth;

struct MortonKey {
    std::uint32_t code;
    std::uint32_t index;
};

// The lowest ten bits of three numbers, taken in turn: bit i of `first` becomes bit 3 i, that of `second` the
// one above it.
std::uint32_t interleave(std::uint32_t first, std::uint32_t second, std::uint32_t third);

// In double the sums and quotients of floats are as good as exact, so that which side of a cell's border a
// point falls on is a property of the model and not of rounding. Points outside count as on the border.
std::uint32_t morton_code(const glm::dvec3& point, const glm::dvec3& min, const glm::dvec3& size);

// By the lowest `bits` bits of the code; keys that are equal in these keep their order. O(n).
void sort_by_code(std::vector<MortonKey>& keys, int bits = kMortonBits);

// The order of the boxes' centres in the box around them: element i is the box that comes i-th. Boxes that
// are empty or not finite come first. At most 2^32 boxes. O(n).
std::vector<std::uint32_t> morton_order(std::span<const Box> boxes);

}  // namespace swath
