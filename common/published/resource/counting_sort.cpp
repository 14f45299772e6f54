#include "common/published/resource/counting_sort.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/parts.h"

namespace swath {
namespace {

constexpr std::size_t kCountedIdsPerPart = 1 << 14;
constexpr double kCountedIdNs = 2;  // about

}  // namespace

CountingSort::CountingSort(std::span<const std::uint32_t> keys, std::uint64_t points, ThreadTeam& team,
                           SharingMode mode)
    : keys_(keys), points_(static_cast<std::size_t>(points)), team_(team), sharing_(team, mode) {
    if (!keys.empty()) CHECK(std::uint64_t{*std::ranges::max_element(keys)} < points);
}

std::span<const std::uint32_t> CountingSort::sort(std::span<const std::uint32_t> visible) {
    // A part with fewer ids than points would spend its time on counters.
    const double work = kCountedIdNs * static_cast<double>(visible.size());
    const std::size_t parts = std::min(
        parts_for(visible.size(), std::max(kCountedIdsPerPart, points_), team_), sharing_.members(work));
    const std::uint32_t* const keys = keys_.data();
    std::uint32_t* const sorted = sorted_.room(visible.size());
    histograms_.resize(parts, points_);
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(visible.size(), parts, part);
        std::uint32_t* const counts = histograms_.row(part);
        std::fill_n(counts, points_, 0u);
        for (std::size_t i = range.begin; i < range.end; ++i) {
            __builtin_prefetch(keys + visible[read_ahead(i, range)]);
            ++counts[keys[visible[i]]];
        }
    });
    histograms_.to_positions(team_);
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(visible.size(), parts, part);
        std::uint32_t* const positions = histograms_.row(part);
        for (std::size_t i = range.begin; i < range.end; ++i) {
            __builtin_prefetch(keys + visible[read_ahead(i, range)]);
            const std::uint32_t id = visible[i];
            sorted[positions[keys[id]]++] = id;
        }
    });
    sharing_.done(work);
    return {sorted, visible.size()};
}

}  // namespace swath
