#include "common/octree/uniform_octree.h"

#include "common/base/check.h"

namespace swath {
namespace {

// Moves bit i of ten bits to bit 3i, and back.
std::uint32_t spread(std::uint32_t v) {
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
}

std::uint32_t gather(std::uint32_t v) {
    v &= 0x09249249u;
    v = (v | v >> 2) & 0x030c30c3u;
    v = (v | v >> 4) & 0x0300f00fu;
    v = (v | v >> 8) & 0x030000ffu;
    return (v | v >> 16) & 0x000003ffu;
}

}  // namespace

std::uint32_t morton_code(const OctreeCell& cell) {
    return spread(cell.x) | spread(cell.z) << 1 | spread(cell.y) << 2;
}

OctreeCell morton_cell(std::uint32_t code) { return {gather(code), gather(code >> 2), gather(code >> 1)}; }

UniformOctree::UniformOctree(int height) : height_(height) {
    CHECK(height >= 0);
    CHECK(height <= kMaxHeight);
}

std::uint64_t UniformOctree::node_count() const { return ((std::uint64_t{8} << 3 * height_) - 1) / 7; }

Box UniformOctree::box_of(int level, std::uint32_t code) const {
    const OctreeCell cell = morton_cell(code);
    const float size = static_cast<float>(1u << (height_ - level));
    const glm::vec3 low = size * glm::vec3(cell.x, cell.y, cell.z);
    return {low, low + size};
}

}  // namespace swath
