#include "common/published/resource/radix_sort.h"

#include <algorithm>
#include <bit>

#include "common/base/check.h"
#include "common/base/parts.h"

namespace swath {
namespace {

constexpr std::size_t kRadixIdsPerPart = 1 << 14;
constexpr double kRadixIdNs = 2;  // about

// An entry moves from pass to pass: the rest of the key, above the id. The loops take arguments by value: the
// compiler would read references again after each counter that it writes.
std::uint64_t pack(std::uint32_t key, std::uint32_t id) { return std::uint64_t{key} << 32 | id; }
std::uint32_t id_of(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }
std::uint32_t key_of(std::uint64_t entry) { return static_cast<std::uint32_t>(entry >> 32); }

// Packs the part and counts its first kDigits digits.
template <std::size_t kDigits>
void pack_and_count(std::span<const std::uint32_t> visible, const std::uint32_t* keys, Part part,
                    RadixDigits digits, std::array<std::uint32_t*, RadixDigits::kMax> counts,
                    std::uint64_t* to) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
        const std::uint32_t id = visible[i];
        __builtin_prefetch(keys + visible[read_ahead(i, part)]);
        std::uint32_t key = keys[id];
        to[i] = pack(key, id);
        for (std::size_t digit = 0; digit < kDigits; ++digit) {
            ++counts[digit][key & ((1u << digits.bits[digit]) - 1)];
            key >>= digits.bits[digit];
        }
    }
}

void count_digit(const std::uint64_t* from, Part part, std::uint32_t mask, std::uint32_t* counts) {
    for (std::size_t i = part.begin; i < part.end; ++i) ++counts[key_of(from[i]) & mask];
}

void move_entries(const std::uint64_t* from, Part part, std::uint32_t mask, int bits,
                  std::uint32_t* positions, std::uint64_t* to) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
        const std::uint64_t entry = from[i];
        to[positions[key_of(entry) & mask]++] = pack(key_of(entry) >> bits, id_of(entry));
    }
}

void move_ids(const std::uint64_t* from, Part part, std::uint32_t mask, std::uint32_t* positions,
              std::uint32_t* to) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
        const std::uint64_t entry = from[i];
        to[positions[key_of(entry) & mask]++] = id_of(entry);
    }
}

}  // namespace

RadixDigits radix_digits(std::uint64_t points) {
    CHECK(points <= std::uint64_t{1} << 32);
    int left = points == 0 ? 0 : static_cast<int>(std::bit_width(points - 1));
    RadixDigits digits;
    digits.count = static_cast<std::size_t>((left + RadixDigits::kMaxBits - 1) / RadixDigits::kMaxBits);
    for (std::size_t i = 0; i < digits.count; ++i) {
        const auto remaining = static_cast<int>(digits.count - i);
        digits.bits[i] = (left + remaining - 1) / remaining;
        left -= digits.bits[i];
    }
    return digits;
}

RadixSort::RadixSort(std::span<const std::uint32_t> keys, std::uint64_t points, ThreadTeam& team,
                     SharingMode mode)
    : keys_(keys), digits_(radix_digits(points)), team_(team), sharing_(team, mode) {
    if (!keys.empty()) CHECK(std::uint64_t{*std::ranges::max_element(keys)} < points);
}

std::span<const std::uint32_t> RadixSort::sort(std::span<const std::uint32_t> visible) {
    const std::size_t size = visible.size();
    if (digits_.count == 0) return visible;
    const double work = kRadixIdNs * static_cast<double>(size);
    const std::size_t parts = std::min(parts_for(size, kRadixIdsPerPart, team_), sharing_.members(work));
    for (std::size_t digit = 0; digit < digits_.count; ++digit)
        histograms_[digit].resize(parts, std::size_t{1} << digits_.bits[digit]);
    std::uint64_t* from = packed_[0].room(size);
    std::uint64_t* to = digits_.count > 1 ? packed_[1].room(size) : nullptr;
    std::uint32_t* const sorted = sorted_.room(size);

    // A single part counts all digits in one pass. With several parts, each pass changes what is in them.
    const std::size_t counted = parts == 1 ? digits_.count : 1;
    run_parts(team_, parts, [&](std::size_t part) {
        std::array<std::uint32_t*, RadixDigits::kMax> counts{};
        for (std::size_t digit = 0; digit < counted; ++digit) {
            counts[digit] = histograms_[digit].row(part);
            std::fill_n(counts[digit], histograms_[digit].cells(), 0u);
        }
        const Part range = part_of(size, parts, part);
        if (counted == 1) pack_and_count<1>(visible, keys_.data(), range, digits_, counts, from);
        if (counted == 2) pack_and_count<2>(visible, keys_.data(), range, digits_, counts, from);
        if (counted == 3) pack_and_count<3>(visible, keys_.data(), range, digits_, counts, from);
    });
    for (std::size_t digit = 0; digit < digits_.count; ++digit) {
        Histograms& histograms = histograms_[digit];
        const int bits = digits_.bits[digit];
        const std::uint32_t mask = (1u << bits) - 1;
        if (digit >= counted)
            run_parts(team_, parts, [&](std::size_t part) {
                std::fill_n(histograms.row(part), histograms.cells(), 0u);
                count_digit(from, part_of(size, parts, part), mask, histograms.row(part));
            });
        histograms.to_positions(team_);
        const bool last = digit + 1 == digits_.count;
        run_parts(team_, parts, [&](std::size_t part) {
            const Part range = part_of(size, parts, part);
            if (last)
                move_ids(from, range, mask, histograms.row(part), sorted);
            else
                move_entries(from, range, mask, bits, histograms.row(part), to);
        });
        std::swap(from, to);
    }
    sharing_.done(work);
    return {sorted, size};
}

}  // namespace swath
