#include "common/cull/wide/flat_scan.h"

#include <algorithm>

#include "common/cull/wide/wide_hierarchy.h"

namespace swath {
namespace {

constexpr double kBoxNs = 0.5;  // about the time that a box takes
constexpr std::size_t kScanPartsAMember = 16;

}  // namespace

FlatScan::FlatScan(const BoxBlocks& blocks, ThreadTeam& team, InstructionSet instructions, SharingMode mode)
    : blocks_(blocks),
      team_(team),
      kernels_(hierarchy_kernels(instructions)),
      ids_(blocks.size()),
      sharing_(team, mode) {}

std::span<const std::uint32_t> FlatScan::cull(const Frustum& frustum) {
    const std::array<KernelPlane, 6> planes = kernel_planes(frustum);
    const double expected_ns = kBoxNs * blocks_.size();
    const std::size_t members = sharing_.members(expected_ns);
    const std::size_t count = blocks_.block_count();
    const std::size_t parts = members == 1 ? 1 : std::min(count, kScanPartsAMember * members);
    const auto first_of = [&](std::size_t part) { return part * count / parts; };
    const auto scan = [&](std::size_t part) {
        const std::size_t first = first_of(part);
        const std::size_t last = first_of(part + 1);
        const std::size_t boxes = std::min(16 * last, std::size_t{blocks_.size()}) - 16 * first;
        std::uint32_t* const out = ids_.data() + 16 * first;
        const std::uint32_t* const end =
            kernels_.scan(blocks_.data() + kBlockFloats * first, static_cast<std::uint32_t>(boxes),
                          planes.data(), static_cast<std::uint32_t>(16 * first), out);
        return static_cast<std::size_t>(end - out);
    };
    std::span<const std::uint32_t> visible;
    if (members == 1) {
        visible = ids_.first(scan(0));
    } else {
        begins_.resize(parts);
        for (std::size_t part = 0; part < parts; ++part) begins_[part] = 16 * first_of(part);
        visible = ids_.share(team_, members, begins_, scan);
    }
    sharing_.done(expected_ns);
    return visible;
}

}  // namespace swath
