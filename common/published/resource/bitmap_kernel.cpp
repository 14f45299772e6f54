#include "common/published/resource/bitmap_kernel.h"

#if defined(SWATH_KERNEL_avx2) || defined(SWATH_KERNEL_avx512)
#include <immintrin.h>
#endif

namespace swath::SWATH_KERNEL {
namespace {

std::uint32_t* expand_word(std::uint64_t word, const std::uint32_t* values, std::uint32_t* out) {
    for (; word != 0; word &= word - 1) *out++ = values[__builtin_ctzll(word)];
    return out;
}

// The same for a word with at least 64 places left, of which it may spoil those that it does not need.
#if defined(SWATH_KERNEL_avx512)
std::uint32_t* expand_roomy_word(std::uint64_t word, const std::uint32_t* values, std::uint32_t* out) {
    for (int i = 0; i < 64; i += 16) {
        const auto mask = static_cast<__mmask16>(word >> i);
        _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(mask, _mm512_loadu_si512(values + i)));
        out += __builtin_popcount(mask);
    }
    return out;
}
#elif defined(SWATH_KERNEL_avx2)
std::uint32_t* expand_roomy_word(std::uint64_t word, const std::uint32_t* values, std::uint32_t* out) {
    for (int i = 0; i < 64; i += 8) {
        const std::uint64_t mask = word >> i & 0xff;
        // A byte of ones for each bit, and with them the numbers of the bits that are set.
        const std::uint64_t bytes = _pdep_u64(mask, 0x0101010101010101) * 0xff;
        const std::uint64_t lanes = _pext_u64(0x0706050403020100, bytes);
        const __m256i picked = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(lanes)));
        const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values + i));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_permutevar8x32_epi32(eight, picked));
        out += __builtin_popcountll(mask);
    }
    return out;
}
#else
std::uint32_t* expand_roomy_word(std::uint64_t word, const std::uint32_t* values, std::uint32_t* out) {
    return expand_word(word, values, out);
}
#endif

}  // namespace

void merge_bits(std::uint64_t* into, std::uint64_t* from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        into[i] |= from[i];
        from[i] = 0;
    }
}

void invert_bits(std::uint64_t* words, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) words[i] = ~words[i];
}

std::size_t count_bits(const std::uint64_t* words, std::size_t count) {
    std::size_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) bits += static_cast<std::size_t>(__builtin_popcountll(words[i]));
    return bits;
}

void expand_bits(std::uint64_t* words, std::size_t count, const std::uint32_t* values, std::uint32_t* out,
                 std::size_t room) {
    const std::uint32_t* const end = out + room;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t word = words[i];
        if (word == 0) continue;
        words[i] = 0;
        // A last word that is cut short has less than 64 places left, so nothing is read beyond the values.
        out = end - out >= 64 ? expand_roomy_word(word, values + 64 * i, out)
                              : expand_word(word, values + 64 * i, out);
    }
}

}  // namespace swath::SWATH_KERNEL
