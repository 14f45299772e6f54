#include "common/published/cull/wide_octree.h"

#include <algorithm>
#include <numeric>

#include "common/cull/wide/wide_hierarchy.h"

namespace swath {
namespace {

// About what testing a node and writing a leaf take, to tell large frames from small ones.
constexpr double kNodeNs = 0.4;
constexpr double kLeafNs = 0.05;

constexpr std::size_t kPartsAMember = 16;
constexpr std::size_t kNodesAMember = 64;

const OctreeKernels& octree_kernels(InstructionSet instructions) {
    switch (instructions) {
#if defined(__x86_64__)
        case InstructionSet::kAvx2:
            return avx2::kOctreeKernels;
        case InstructionSet::kAvx512:
            return avx512::kOctreeKernels;
#endif
        default:
            return portable::kOctreeKernels;
    }
}

}  // namespace

WideOctree::WideOctree(const UniformOctree& shape, ThreadTeam& team, InstructionSet instructions,
                       SharingMode mode)
    : shape_(shape),
      team_(team),
      kernels_(octree_kernels(instructions)),
      ids_(shape.leaf_count()),
      sharing_{Sharing(team, mode), Sharing(team, mode)} {}

std::span<const std::uint32_t> WideOctree::cull_same_nodes(const Frustum& frustum) {
    return cull(frustum, kSameNodes);
}

std::span<const std::uint32_t> WideOctree::cull(const Frustum& frustum) { return cull(frustum, kEarlyOut); }

std::span<const std::uint32_t> WideOctree::cull(const Frustum& frustum, Visit visit) {
    tested_ = 1;
    if (outside(frustum, shape_.box_of(0, 0))) return {};
    if (shape_.height() == 0) {
        *ids_.data() = 0;
        return ids_.first(1);
    }
    const std::array<KernelPlane, 6> planes = kernel_planes(frustum);
    OctreeWalk walk{planes.data(), shape_.height(), 1};
    const std::size_t members = sharing_[visit].members(expected_ns_[visit]);
    std::span<const std::uint32_t> visible;
    if (members > 1) {
        visible = cull_shared(walk, visit, members);
    } else {
        std::uint32_t root = 0;
        const std::uint32_t* const end =
            visit == kSameNodes ? kernels_.same_nodes(walk, 0, {&root, &root}, 1, ids_.data())
                                : kernels_.early_out(walk, 0, root, root, kAllPlanes, ids_.data());
        visible = ids_.first(static_cast<std::size_t>(end - ids_.data()));
        tested_ = walk.tested;
    }
    expected_ns_[visit] =
        kNodeNs * static_cast<double>(tested_) + kLeafNs * static_cast<double>(visible.size());
    sharing_[visit].done(expected_ns_[visit]);
    return visible;
}

std::span<const std::uint32_t> WideOctree::cull_shared(OctreeWalk walk, Visit visit, std::size_t members) {
    codes_[0].assign(1, 0);
    cells_[0].assign(1, 0);
    int level = 0;
    // Two levels are left to the members, so that they do most of the work.
    while (level < shape_.height() - 2 && codes_[0].size() < kNodesAMember * members) {
        for (auto* const list : {&codes_[1], &cells_[1]}) list->resize(8 * codes_[0].size());
        const std::uint32_t count = kernels_.expand(walk, level, {codes_[0].data(), cells_[0].data()},
                                                    static_cast<std::uint32_t>(codes_[0].size()),
                                                    {codes_[1].data(), cells_[1].data()});
        codes_[1].resize(count);
        cells_[1].resize(count);
        std::swap(codes_[0], codes_[1]);
        std::swap(cells_[0], cells_[1]);
        ++level;
    }
    const std::size_t count = codes_[0].size();
    const std::size_t parts = std::min(count, kPartsAMember * members);
    const auto first_of = [&](std::size_t part) { return part * count / parts; };
    begins_.resize(parts);
    tests_.resize(parts);
    for (std::size_t part = 0; part < parts; ++part)
        begins_[part] = std::size_t{codes_[0][first_of(part)]} << 3 * (shape_.height() - level);
    const auto visible = ids_.share(team_, members, begins_, [&](std::size_t part) {
        OctreeWalk mine{walk.planes, walk.height, 0};
        const std::size_t first = first_of(part);
        const std::size_t last = first_of(part + 1);
        std::uint32_t* const begin = ids_.data() + begins_[part];
        std::uint32_t* out = begin;
        if (visit == kSameNodes) {
            out = kernels_.same_nodes(mine, level, {codes_[0].data() + first, cells_[0].data() + first},
                                      static_cast<std::uint32_t>(last - first), out);
        } else {
            for (std::size_t i = first; i < last; ++i)
                out = kernels_.early_out(mine, level, codes_[0][i], cells_[0][i], kAllPlanes, out);
        }
        tests_[part] = mine.tested;
        return static_cast<std::size_t>(out - begin);
    });
    tested_ = std::accumulate(tests_.begin(), tests_.end(), walk.tested);
    return visible;
}

}  // namespace swath
