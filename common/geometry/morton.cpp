#include "common/geometry/morton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace swath {
namespace {

constexpr double kCells = 1 << kMortonDepth;  // an axis

// Moves bit i of the low ten bits to bit 3 i.
std::uint32_t spread(std::uint32_t bits) {
    bits &= 0x3ff;
    bits = (bits | bits << 16) & 0x030000ff;
    bits = (bits | bits << 8) & 0x0300f00f;
    bits = (bits | bits << 4) & 0x030c30c3;
    bits = (bits | bits << 2) & 0x09249249;
    return bits;
}

std::uint32_t cell(double point, double min, double size) {
    if (!(size > 0)) return 0;  // a flat axis
    const double at = (point - min) / size * kCells;
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, kCells - 1));
}

bool proper(const Box& box) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) return false;
    return !box.empty();
}

}  // namespace

std::uint32_t interleave(std::uint32_t first, std::uint32_t second, std::uint32_t third) {
    return spread(first) | spread(second) << 1 | spread(third) << 2;
}

std::uint32_t morton_code(const glm::dvec3& point, const glm::dvec3& min, const glm::dvec3& size) {
    return interleave(cell(point.x, min.x, size.x), cell(point.y, min.y, size.y),
                      cell(point.z, min.z, size.z));
}

void sort_by_code(std::vector<MortonKey>& keys, int bits) {
    // A radix sort, least significant digit first.
    constexpr int kDigitBits = 10;
    constexpr std::uint32_t kMask = (1u << kDigitBits) - 1;
    std::vector<MortonKey> other(keys.size());
    for (int shift = 0; shift < bits; shift += kDigitBits) {
        std::array<std::size_t, (1u << kDigitBits)> place{};
        for (const MortonKey& key : keys) ++place[key.code >> shift & kMask];
        std::size_t sum = 0;
        for (std::size_t& p : place) sum += std::exchange(p, sum);
        for (const MortonKey& key : keys) other[place[key.code >> shift & kMask]++] = key;
        keys.swap(other);
    }
}

std::vector<std::uint32_t> morton_order(std::span<const Box> boxes) {
    Box around;
    for (const Box& box : boxes)
        if (proper(box)) around.extend(box);
    const glm::dvec3 min(around.min);
    const glm::dvec3 size = glm::dvec3(around.max) - min;
    std::vector<MortonKey> keys(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        keys[i] = {0, static_cast<std::uint32_t>(i)};
        if (proper(boxes[i]))
            keys[i].code =
                morton_code(0.5 * (glm::dvec3(boxes[i].min) + glm::dvec3(boxes[i].max)), min, size);
    }
    sort_by_code(keys);
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].index;
    return order;
}

}  // namespace swath
