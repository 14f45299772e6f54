#include "common/cull/wide/wide_culler.h"

namespace swath {
namespace {

// So many blocks of a scan take as long as one of a walk, which reads here and there, decides and calls. We
// measured 1.5 to 2.2 in caches and up to 3 beyond.
constexpr double kWalkCost = 2.5;
// A scan of at most so many blocks is over before a walk has begun.
constexpr std::uint32_t kFewBlocks = 64;

}  // namespace

WideCuller::WideCuller(std::span<const Box> boxes, ThreadTeam& team, InstructionSet instructions)
    : hierarchy_(boxes, team, instructions), scan_(hierarchy_.blocks(), team, instructions) {}

void WideCuller::refit(std::span<const Box> boxes) {
    hierarchy_.refit(boxes);
    small_ = false;  // the last frame says nothing of boxes that have moved
}

bool WideCuller::better_scanned(const Frustum& frustum) {
    if (hierarchy_.blocks().block_count() <= kFewBlocks) return true;
    const double nodes = hierarchy_.crossing_nodes(frustum);
    const double walked = nodes + nodes * static_cast<double>(kBlockBoxes) * crossing_part_;
    return kWalkCost * walked > hierarchy_.blocks().block_count();
}

std::span<const std::uint32_t> WideCuller::cull(const Frustum& frustum) {
    // Most frames are like the last, so a small one is not followed by the question.
    scanned_ = !small_ && better_scanned(frustum);
    if (scanned_) return scan_.cull(frustum);
    const auto visible = hierarchy_.cull(frustum);
    const WideWork& work = hierarchy_.work();
    const auto walked = static_cast<double>(work.inner_blocks + work.leaf_blocks);
    const std::uint32_t blocks = hierarchy_.blocks().block_count();
    small_ = blocks > kFewBlocks && 2 * kWalkCost * walked < blocks;
    if (work.inner_blocks > 0)
        crossing_part_ =
            static_cast<double>(work.leaf_blocks) / static_cast<double>(kBlockBoxes * work.inner_blocks);
    return visible;
}

}  // namespace swath
