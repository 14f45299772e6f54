#include "common/published/resource/resource_array.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/base/parts.h"

namespace swath {

Result<ResourceArray> ResourceArray::make(std::uint64_t points) {
    if (points > kMaxPoints)
        return fail("resource array: {} points, of which it can have {}", points, kMaxPoints);
    return ResourceArray(static_cast<std::size_t>(points));
}

void ResourceArray::add(std::uint32_t key, std::uint32_t id) {
    Entry& entry = entries_[key];
    ++entry.c;
    entry.L.push_back(id);
}

void ResourceArray::clear() {
    for (Entry& entry : entries_) {
        entry.c = 0;
        entry.L.clear();
    }
}

void merge(std::span<ResourceArray> arrays, ThreadTeam& team, ResourceArray& merged) {
    for (const ResourceArray& array : arrays) CHECK(array.points() == merged.points());
    run_parts(team, team.size(), [&](std::size_t member) {
        const Part range = part_of(merged.points(), team.size(), member);
        for (std::size_t point = range.begin; point < range.end; ++point) {
            ResourceArray::Entry& into = merged.entries_[point];
            into.c = 0;
            into.L.clear();
            for (ResourceArray& array : arrays) {
                ResourceArray::Entry& from = array.entries_[point];
                if (from.c == 0) continue;
                if (into.c == 0)
                    std::swap(into.L, from.L);
                else
                    into.L.insert(into.L.end(), from.L.begin(), from.L.end());
                into.c += from.c;
                from.c = 0;
                from.L.clear();
            }
        }
    });
}

Result<LiteralSort> LiteralSort::make(std::span<const std::uint32_t> keys, std::uint64_t points,
                                      ThreadTeam& team) {
    SWATH_TRY(ResourceArray empty, ResourceArray::make(points));
    if (!keys.empty()) CHECK(std::uint64_t{*std::ranges::max_element(keys)} < points);
    return LiteralSort(keys, std::move(empty), team);
}

LiteralSort::LiteralSort(std::span<const std::uint32_t> keys, ResourceArray empty, ThreadTeam& team)
    : keys_(keys), team_(team), arrays_(team.size(), empty), merged_(std::move(empty)) {}

std::span<const std::uint32_t> LiteralSort::sort(std::span<const std::uint32_t> visible) {
    run_parts(team_, team_.size(), [&](std::size_t member) {
        const Part range = part_of(visible.size(), team_.size(), member);
        for (std::size_t i = range.begin; i < range.end; ++i)
            arrays_[member].add(keys_[visible[i]], visible[i]);
    });
    merge(arrays_, team_, merged_);
    sorted_.clear();
    sorted_.reserve(visible.size());
    for (std::size_t point = 0; point < merged_.points(); ++point) {
        if (merged_.count(static_cast<std::uint32_t>(point)) == 0) continue;
        const std::span<const std::uint32_t> list = merged_.list(static_cast<std::uint32_t>(point));
        sorted_.insert(sorted_.end(), list.begin(), list.end());
    }
    return sorted_;
}

}  // namespace swath
