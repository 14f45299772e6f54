#include "common/cull/wide/wide_hierarchy.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"

namespace swath {
namespace {

// About what testing a block and writing an id take, to tell large frames from small ones.
constexpr double kBlockNs = 6;
constexpr double kIdNs = 0.05;

// There are more parts than members, so that none waits long for the last, and enough blocks for the parts.
constexpr std::size_t kHierarchyPartsAMember = 16;
constexpr std::size_t kBlocksAMember = 64;

}  // namespace

const HierarchyKernels& hierarchy_kernels(InstructionSet instructions) {
    switch (instructions) {
#if defined(__x86_64__)
        case InstructionSet::kAvx2:
            return avx2::kHierarchyKernels;
        case InstructionSet::kAvx512:
            return avx512::kHierarchyKernels;
#endif
        default:
            return portable::kHierarchyKernels;
    }
}

std::array<KernelPlane, 6> kernel_planes(const Frustum& frustum) {
    std::array<KernelPlane, 6> planes;
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const glm::vec4& plane = frustum.planes[k];
        planes[k] = {plane.x, plane.y, plane.z, plane.w, {}, {}};
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const bool up = plane[static_cast<int>(axis)] >= 0;  // as in frustum.h
            planes[k].p[axis] = 16 * axis + (up ? 48 : 0);
            planes[k].n[axis] = 16 * axis + (up ? 0 : 48);
        }
    }
    return planes;
}

WideHierarchy::WideHierarchy(std::span<const Box> boxes, ThreadTeam& team, InstructionSet instructions,
                             SharingMode mode)
    : team_(team),
      kernels_(hierarchy_kernels(instructions)),
      boxes_(boxes),
      ids_(boxes.size()),
      sharing_(team, mode) {
    if (boxes_.size() == 0) return;
    levels_.push_back({boxes_.data(), boxes_.size()});
    while (levels_.back().count > kBlockBoxes) {
        const std::uint32_t count = (levels_.back().count + 15) / 16;
        inner_.emplace_back((count + std::size_t{15}) / 16 * kBlockFloats);
        levels_.push_back({inner_.back().data(), count});
    }
    CHECK(levels_.size() <= std::size_t{kMaxWideLevels});
    bound_nodes();
}

void WideHierarchy::refit(std::span<const Box> boxes) {
    boxes_.assign(boxes);
    bound_nodes();
}

void WideHierarchy::bound_nodes() {
    for (std::size_t level = 0; level < inner_.size(); ++level)
        kernels_.bound(levels_[level].blocks, levels_[level].count, level == 0, inner_[level].data());
}

std::span<const std::uint32_t> WideHierarchy::cull(const Frustum& frustum) {
    if (levels_.empty()) return {};
    const std::array<KernelPlane, 6> planes = kernel_planes(frustum);
    WideWalk walk{levels_.data(), planes.data(), {}};
    const std::size_t members = sharing_.members(expected_ns_);
    std::span<const std::uint32_t> visible;
    if (members > 1) {
        visible = cull_shared(walk, members);
    } else {
        const int top = static_cast<int>(levels_.size()) - 1;
        const std::uint32_t* const end = kernels_.walk(walk, top, {0, kAllPlanes}, ids_.data());
        visible = ids_.first(static_cast<std::size_t>(end - ids_.data()));
        work_ = walk.work;
    }
    expected_ns_ = kBlockNs * static_cast<double>(work_.inner_blocks + work_.leaf_blocks) +
                   kIdNs * static_cast<double>(visible.size());
    sharing_.done(expected_ns_);
    return visible;
}

std::uint32_t WideHierarchy::crossing_nodes(const Frustum& frustum) const {
    if (levels_.size() < 3) return static_cast<std::uint32_t>(levels_.size() / 2);
    const std::array<KernelPlane, 6> planes = kernel_planes(frustum);
    WideWalk walk{levels_.data(), planes.data(), {}};
    return kernels_.crossing(walk, static_cast<int>(levels_.size()) - 1, {0, kAllPlanes});
}

// The highest level with enough blocks, else 0.
int WideHierarchy::split_level(std::size_t members) const {
    int level = static_cast<int>(levels_.size()) - 1;
    while (level > 0 &&
           levels_[static_cast<std::size_t>(level)].count / kBlockBoxes < kBlocksAMember * members)
        --level;
    return level;
}

std::span<const std::uint32_t> WideHierarchy::cull_shared(WideWalk walk, std::size_t members) {
    const int top = static_cast<int>(levels_.size()) - 1;
    const int split = split_level(members);
    pieces_.resize((levels_[static_cast<std::size_t>(split)].count + 15) / 16);
    const WidePiece* const end = kernels_.pieces(walk, top, {0, kAllPlanes}, split, pieces_.data());
    work_ = walk.work;

    const auto count = static_cast<std::size_t>(end - pieces_.data());
    const std::size_t parts = std::min(count, kHierarchyPartsAMember * members);
    const auto first_of = [&](std::size_t part) { return part * count / parts; };
    begins_.resize(parts);
    works_.resize(parts);
    for (std::size_t part = 0; part < parts; ++part)
        begins_[part] = std::size_t{pieces_[first_of(part)].block} << 4 * (split + 1);
    const auto visible = ids_.share(team_, members, begins_, [&](std::size_t part) {
        WideWalk mine{walk.levels, walk.planes, {}};
        std::uint32_t* const begin = ids_.data() + begins_[part];
        std::uint32_t* out = begin;
        for (std::size_t i = first_of(part); i < first_of(part + 1); ++i)
            out = kernels_.walk(mine, split, pieces_[i], out);
        works_[part] = mine.work;
        return static_cast<std::size_t>(out - begin);
    });
    for (const WideWork& work : works_) {
        work_.inner_blocks += work.inner_blocks;
        work_.leaf_blocks += work.leaf_blocks;
    }
    return visible;
}

}  // namespace swath
