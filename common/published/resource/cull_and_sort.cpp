#include "common/published/resource/cull_and_sort.h"

#include <vector>

#include "common/base/check.h"
#include "common/base/parts.h"

namespace swath {
namespace {

// Shares of the objects between which scanning is the cheaper way: below, the hierarchy leaves most boxes
// alone; above, it takes whole branches, and RankBitmap has little to mark. Measured on one core with objects
// in random places, ids in the order of neighbourhood: from 0.3 (100,000 objects) or 0.45 (a million) up to
// 0.85, scanning took 0.65 to 0.95 times as long. With ten million, memory is the limit, and it is from 0.55
// to 0.75. Where the ways cross, little is lost by taking the other.
constexpr double kScanFrom = 0.4;
constexpr double kScanTo = 0.8;

constexpr std::size_t kRanksPerPart = 1 << 15;

std::vector<Box> in_order(std::span<const Box> boxes, std::span<const std::uint32_t> ids) {
    std::vector<Box> ordered;
    ordered.reserve(ids.size());
    for (const std::uint32_t id : ids) ordered.push_back(boxes[id]);
    return ordered;
}

}  // namespace

CullAndSort::CullAndSort(std::span<const Box> boxes, std::span<const std::uint32_t> keys, ThreadTeam& team)
    : team_(team), sorter_(keys, team), hierarchy_(boxes, team) {
    CHECK(boxes.size() == keys.size());
    const KeyOrder& order = sorter_.order();
    if (!order.ids_are_ranks()) scan_ = std::make_unique<Scan>(in_order(boxes, order.ids()), team);
}

CullAndSort::Way CullAndSort::next_way() const {
    const auto objects = static_cast<double>(sorter_.order().size());
    const auto visible = static_cast<double>(last_visible_);
    const bool scan = visible > kScanFrom * objects && visible < kScanTo * objects;
    return scan_ != nullptr && scan ? Way::kScan : Way::kHierarchy;
}

std::span<const std::uint32_t> CullAndSort::cull(const Frustum& frustum) { return cull(frustum, next_way()); }

std::span<const std::uint32_t> CullAndSort::cull(const Frustum& frustum, Way way) {
    way_ = scan_ == nullptr ? Way::kHierarchy : way;
    const std::span<const std::uint32_t> visible =
        way_ == Way::kHierarchy ? hierarchy_.cull(frustum) : scan_->scan.cull(frustum);
    last_visible_ = visible.size();
    return way_ == Way::kHierarchy ? sorter_.sort(visible) : ids_of(visible);
}

std::span<const std::uint32_t> CullAndSort::ids_of(std::span<const std::uint32_t> ranks) {
    const std::uint32_t* const ids = sorter_.order().ids().data();
    std::uint32_t* const found = scanned_.room(ranks.size());
    const std::size_t parts = parts_for(ranks.size(), kRanksPerPart, team_);
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(ranks.size(), parts, part);
        for (std::size_t i = range.begin; i < range.end; ++i) found[i] = ids[ranks[i]];
    });
    return {found, ranks.size()};
}

}  // namespace swath
