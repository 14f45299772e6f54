#include "common/published/resource/rank_bitmap.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/parts.h"
#include "common/published/resource/bitmap_kernel.h"

namespace swath {
namespace {

constexpr std::size_t kBitmapIdsPerPart = 1 << 15;
constexpr double kBitmapIdNs = 1;  // about

}  // namespace

RankBitmap::Kernel RankBitmap::kernel_for(InstructionSet set) {
#if defined(__x86_64__)
    if (set == InstructionSet::kAvx512)
        return {avx512::merge_bits, avx512::invert_bits, avx512::count_bits, avx512::expand_bits};
    if (set == InstructionSet::kAvx2)
        return {avx2::merge_bits, avx2::invert_bits, avx2::count_bits, avx2::expand_bits};
#endif
    CHECK(set == InstructionSet::kPortable);
    return {portable::merge_bits, portable::invert_bits, portable::count_bits, portable::expand_bits};
}

RankBitmap::RankBitmap(const KeyOrder& order, ThreadTeam& team, InstructionSet set, SharingMode mode)
    : order_(order), team_(team), sharing_(team, mode), kernel_(kernel_for(set)) {}

// Marks the ranks of ids.
void RankBitmap::mark(std::span<const std::uint32_t> ids, std::uint64_t* bitmap) const {
    const std::uint32_t* const ranks = order_.ranks().data();
    const Part all{0, ids.size()};
    for (std::size_t i = 0; i < ids.size(); ++i) {
        __builtin_prefetch(ranks + ids[read_ahead(i, all)]);
        const std::uint32_t rank = ranks[ids[i]];
        bitmap[rank / 64] |= std::uint64_t{1} << rank % 64;
    }
}

// Marks the ranks of the ids from `begin` to `end` that are not in `ids`.
void RankBitmap::mark_gaps(std::span<const std::uint32_t> ids, std::uint32_t begin, std::uint32_t end,
                           std::uint64_t* bitmap) const {
    const std::uint32_t* const ranks = order_.ranks().data();
    std::uint32_t next = begin;
    const auto mark_until = [&](std::uint32_t id) {
        for (; next < id; ++next) bitmap[ranks[next] / 64] |= std::uint64_t{1} << ranks[next] % 64;
    };
    for (const std::uint32_t id : ids) {
        if (id != next) mark_until(id);
        next = id + 1;
    }
    mark_until(end);
}

std::span<const std::uint32_t> RankBitmap::sort(std::span<const std::uint32_t> visible) {
    const std::size_t objects = order_.size();
    const std::size_t words = (objects + 63) / 64;
    const double work = kBitmapIdNs * static_cast<double>(visible.size());
    const std::size_t parts =
        std::min(parts_for(visible.size(), kBitmapIdsPerPart, team_), sharing_.members(work));
    const bool inverse = visible.size() > objects / 2;
    while (bitmaps_.size() < parts) bitmaps_.emplace_back(words);
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(visible.size(), parts, part);
        const std::span<const std::uint32_t> ids = visible.subspan(range.begin, range.end - range.begin);
        if (!inverse) return mark(ids, bitmaps_[part].data());
        // A part's gaps are those before its ids; the last part has those behind them, too.
        mark_gaps(ids, part == 0 ? 0 : visible[range.begin - 1] + 1,
                  part + 1 == parts ? static_cast<std::uint32_t>(objects) : ids.back() + 1,
                  bitmaps_[part].data());
    });

    firsts_.assign(parts + 1, 0);
    std::uint64_t* const merged = bitmaps_[0].data();
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(words, parts, part);
        const std::size_t count = range.end - range.begin;
        for (std::size_t other = 1; other < parts; ++other)
            kernel_.merge(merged + range.begin, bitmaps_[other].data() + range.begin, count);
        if (inverse) {
            kernel_.invert(merged + range.begin, count);
            if (part + 1 == parts && objects % 64 != 0)
                merged[words - 1] &= (std::uint64_t{1} << objects % 64) - 1;
        }
        firsts_[part + 1] = kernel_.count(merged + range.begin, count);
    });
    for (std::size_t part = 0; part < parts; ++part) firsts_[part + 1] += firsts_[part];
    CHECK(firsts_[parts] == visible.size());

    std::uint32_t* const sorted = sorted_.room(visible.size());
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(words, parts, part);
        kernel_.expand(merged + range.begin, range.end - range.begin, order_.ids().data() + 64 * range.begin,
                       sorted + firsts_[part], firsts_[part + 1] - firsts_[part]);
    });
    sharing_.done(work);
    return {sorted, visible.size()};
}

}  // namespace swath
