#include "common/published/octree/uniform_octree.h"

#include "common/base/check.h"
#include "common/geometry/morton.h"

namespace swath {
namespace {

// Undoes interleave(): moves every third bit, from the lowest on, next to each other.
std::uint32_t gather(std::uint32_t v) {
    v &= 0x09249249u;
    v = (v | v >> 2) & 0x030c30c3u;
    v = (v | v >> 4) & 0x0300f00fu;
    v = (v | v >> 8) & 0x030000ffu;
    return (v | v >> 16) & 0x000003ffu;
}

}  // namespace

std::uint32_t octree_code(const OctreeCell& cell) { return interleave(cell.x, cell.z, cell.y); }

OctreeCell octree_cell(std::uint32_t code) { return {gather(code), gather(code >> 2), gather(code >> 1)}; }

UniformOctree::UniformOctree(int height) : height_(height) {
    CHECK(height >= 0);
    CHECK(height <= kMaxHeight);
}

std::uint64_t UniformOctree::node_count() const { return ((std::uint64_t{8} << 3 * height_) - 1) / 7; }

Box UniformOctree::box_of(int level, std::uint32_t code) const {
    const OctreeCell cell = octree_cell(code);
    const float size = static_cast<float>(1u << (height_ - level));
    const glm::vec3 low = size * glm::vec3(cell.x, cell.y, cell.z);
    return {low, low + size};
}

}  // namespace swath
