#include "common/resource/cull_and_sort.h"

#include "common/base/check.h"
#include "common/resource/parts.h"

namespace swath {
namespace {

// Shares of the objects between which scanning is the cheaper way, measured with 100,000, one and ten million
// objects in random places on one core, ids in the order of neighbourhood: below, the hierarchy leaves most
// boxes alone; above, it takes whole branches, and RankBitmap has little to mark. In between scanning takes
// 0.7 to 0.95 times as long. Where the ways cross depends on how fast memory is, and little is lost there.
constexpr double kScanFrom = 1.0 / 3;
constexpr double kScanTo = 5.0 / 6;

constexpr std::size_t kIdsPerPart = 1 << 15;

std::unique_ptr<Culler> make_scan(std::span<const Box> boxes, const KeyOrder& order, ThreadTeam& team) {
    std::vector<Box> by_rank;
    by_rank.reserve(boxes.size());
    for (const std::uint32_t id : order.ids()) by_rank.push_back(boxes[id]);
    return make_culler(CullAlgorithm::kWide, by_rank, team);
}

}  // namespace

CullAndSort::CullAndSort(std::span<const Box> boxes, std::span<const std::uint32_t> keys, ThreadTeam& team)
    : team_(team), sorter_(keys, team), hierarchy_(make_culler(CullAlgorithm::kWide, boxes, team)) {
    CHECK(boxes.size() == keys.size());
    if (!sorter_.order().ids_are_ranks()) scan_ = make_scan(boxes, sorter_.order(), team);
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
    Culler& culler = way_ == Way::kHierarchy ? *hierarchy_ : *scan_;
    const std::span<const std::uint32_t> visible = culler.cull(frustum);
    last_visible_ = visible.size();
    return way_ == Way::kHierarchy ? sorter_.sort(visible) : ids_of(visible);
}

std::span<const std::uint32_t> CullAndSort::ids_of(std::span<const std::uint32_t> ranks) {
    const std::uint32_t* const ids = sorter_.order().ids().data();
    std::uint32_t* const found = scanned_.room(ranks.size());
    const std::size_t parts = parts_for(ranks.size(), kIdsPerPart, team_);
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(ranks.size(), parts, part);
        for (std::size_t i = range.begin; i < range.end; ++i) found[i] = ids[ranks[i]];
    });
    return {found, ranks.size()};
}

}  // namespace swath
