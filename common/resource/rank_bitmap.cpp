#include "common/resource/rank_bitmap.h"

#include "common/base/check.h"
#include "common/resource/bitmap_kernel.h"
#include "common/resource/parts.h"

namespace swath {
namespace {

constexpr std::size_t kIdsPerPart = 1 << 15;

}  // namespace

RankBitmap::Kernel RankBitmap::kernel_for(InstructionSet set) {
#if defined(__x86_64__)
    if (set == InstructionSet::kAvx512) return {avx512::merge_bits, avx512::count_bits, avx512::expand_bits};
    if (set == InstructionSet::kAvx2) return {avx2::merge_bits, avx2::count_bits, avx2::expand_bits};
#endif
    CHECK(set == InstructionSet::kPortable);
    return {portable::merge_bits, portable::count_bits, portable::expand_bits};
}

RankBitmap::RankBitmap(const KeyOrder& order, ThreadTeam& team, InstructionSet set)
    : order_(order), team_(team), kernel_(kernel_for(set)) {}

std::span<const std::uint32_t> RankBitmap::sort(std::span<const std::uint32_t> visible) {
    const std::size_t words = (order_.size() + 63) / 64;
    const std::size_t parts = parts_for(visible.size(), kIdsPerPart, team_);
    while (bitmaps_.size() < parts) bitmaps_.emplace_back(words);
    std::uint32_t* const sorted = sorted_.room(visible.size());

    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(visible.size(), parts, part);
        std::uint64_t* const bitmap = bitmaps_[part].data();
        const std::uint32_t* const ranks = order_.ranks().data();
        for (std::size_t i = range.begin; i < range.end; ++i) {
            __builtin_prefetch(ranks + visible[read_ahead(i, range)]);
            const std::uint32_t rank = ranks[visible[i]];
            bitmap[rank / 64] |= std::uint64_t{1} << rank % 64;
        }
    });
    std::uint64_t* const merged = bitmaps_[0].data();
    const std::uint32_t* const ids = order_.ids().data();
    if (parts == 1) {
        kernel_.expand(merged, words, ids, sorted, visible.size());
        return {sorted, visible.size()};
    }

    firsts_.assign(parts + 1, 0);
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(words, parts, part);
        const std::size_t count = range.end - range.begin;
        for (std::size_t other = 1; other < parts; ++other)
            kernel_.merge(merged + range.begin, bitmaps_[other].data() + range.begin, count);
        firsts_[part + 1] = kernel_.count(merged + range.begin, count);
    });
    for (std::size_t part = 0; part < parts; ++part) firsts_[part + 1] += firsts_[part];
    CHECK(firsts_[parts] == visible.size());
    run_parts(team_, parts, [&](std::size_t part) {
        const Part range = part_of(words, parts, part);
        kernel_.expand(merged + range.begin, range.end - range.begin, ids + 64 * range.begin,
                       sorted + firsts_[part], firsts_[part + 1] - firsts_[part]);
    });
    return {sorted, visible.size()};
}

}  // namespace swath
