#pragma once
// See lanes.h. Two registers hold the sixteen lanes.
#include <immintrin.h>

#include <cstdint>

namespace swath::SWATH_KERNEL {
namespace {

struct Floats {
    __m256 low;
    __m256 high;
};
struct Words {
    __m256i low;
    __m256i high;
};

inline std::uint32_t sign_bits(__m256 low, __m256 high) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(low)) |
           static_cast<std::uint32_t>(_mm256_movemask_ps(high)) << 8;
}
inline __m256i from_bits(std::uint32_t eight) {
    const __m256i bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i spread = _mm256_set1_epi32(static_cast<int>(eight));
    return _mm256_cmpeq_epi32(_mm256_and_si256(spread, bits), bits);
}

inline Floats load(const float* from) { return {_mm256_loadu_ps(from), _mm256_loadu_ps(from + 8)}; }
inline Floats all(float value) { return {_mm256_set1_ps(value), _mm256_set1_ps(value)}; }
inline Floats add(Floats a, Floats b) { return {_mm256_add_ps(a.low, b.low), _mm256_add_ps(a.high, b.high)}; }
inline Floats subtract(Floats a, Floats b) {
    return {_mm256_sub_ps(a.low, b.low), _mm256_sub_ps(a.high, b.high)};
}
inline Floats divide(Floats a, Floats b) {
    return {_mm256_div_ps(a.low, b.low), _mm256_div_ps(a.high, b.high)};
}
inline Floats multiply(Floats a, Floats b) {
    return {_mm256_mul_ps(a.low, b.low), _mm256_mul_ps(a.high, b.high)};
}
inline Floats fused(Floats a, Floats x, Floats t) {
    return {_mm256_fmadd_ps(a.low, x.low, t.low), _mm256_fmadd_ps(a.high, x.high, t.high)};
}
inline Floats lower_of(Floats a, Floats b) {
    return {_mm256_min_ps(a.low, b.low), _mm256_min_ps(a.high, b.high)};
}
inline Floats higher_of(Floats a, Floats b) {
    return {_mm256_max_ps(a.low, b.low), _mm256_max_ps(a.high, b.high)};
}
inline float lowest(Floats a) {
    const __m256 eight = _mm256_min_ps(a.low, a.high);
    __m128 four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    four = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(four, _mm_movehdup_ps(four)));
}
inline float highest(Floats a) {
    const __m256 eight = _mm256_max_ps(a.low, a.high);
    __m128 four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    four = _mm_max_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_max_ss(four, _mm_movehdup_ps(four)));
}
inline std::uint32_t below_zero(Floats a) {
    const __m256 zero = _mm256_setzero_ps();
    return sign_bits(_mm256_cmp_ps(a.low, zero, _CMP_LT_OQ), _mm256_cmp_ps(a.high, zero, _CMP_LT_OQ));
}
inline std::uint32_t at_least_zero(Floats a) {
    const __m256 zero = _mm256_setzero_ps();
    return sign_bits(_mm256_cmp_ps(a.low, zero, _CMP_GE_OQ), _mm256_cmp_ps(a.high, zero, _CMP_GE_OQ));
}
inline std::uint32_t less(Floats a, Floats b) {
    return sign_bits(_mm256_cmp_ps(a.low, b.low, _CMP_LT_OQ), _mm256_cmp_ps(a.high, b.high, _CMP_LT_OQ));
}
inline std::uint32_t at_most(Floats a, Floats b) {
    return sign_bits(_mm256_cmp_ps(a.low, b.low, _CMP_LE_OQ), _mm256_cmp_ps(a.high, b.high, _CMP_LE_OQ));
}
inline std::uint32_t equal(Floats a, Floats b) {
    return sign_bits(_mm256_cmp_ps(a.low, b.low, _CMP_EQ_OQ), _mm256_cmp_ps(a.high, b.high, _CMP_EQ_OQ));
}
inline Floats absolute(Floats a) {
    const __m256 sign = _mm256_set1_ps(-0.0f);
    return {_mm256_andnot_ps(sign, a.low), _mm256_andnot_ps(sign, a.high)};
}
inline Floats where(std::uint32_t mask, Floats then, Floats otherwise) {
    return {_mm256_blendv_ps(otherwise.low, then.low, _mm256_castsi256_ps(from_bits(mask & 0xff))),
            _mm256_blendv_ps(otherwise.high, then.high, _mm256_castsi256_ps(from_bits(mask >> 8)))};
}

inline Words load(const std::uint32_t* from) {
    return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)),
            _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + 8))};
}
inline void store(std::uint32_t* to, Words a) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.low);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 8), a.high);
}
inline void store(float* to, Floats a) {
    _mm256_storeu_ps(to, a.low);
    _mm256_storeu_ps(to + 8, a.high);
}
// Puts `first` into lanes 0 to 7 and `second` into lanes 8 to 15.
inline Words halves(std::uint32_t first, std::uint32_t second) {
    return {_mm256_set1_epi32(static_cast<int>(first)), _mm256_set1_epi32(static_cast<int>(second))};
}
inline Words all(std::uint32_t value) { return halves(value, value); }
inline Words add(Words a, Words b) {
    return {_mm256_add_epi32(a.low, b.low), _mm256_add_epi32(a.high, b.high)};
}
inline Words both(Words a, Words b) {
    return {_mm256_and_si256(a.low, b.low), _mm256_and_si256(a.high, b.high)};
}
template <int kBits>
inline Words shift_left(Words a) {
    return {_mm256_slli_epi32(a.low, kBits), _mm256_slli_epi32(a.high, kBits)};
}
template <int kBits>
inline Words shift_right(Words a) {
    return {_mm256_srli_epi32(a.low, kBits), _mm256_srli_epi32(a.high, kBits)};
}
inline Words set_bits_where(Words a, std::uint32_t mask, std::uint32_t bits) {
    const __m256i set = _mm256_set1_epi32(static_cast<int>(bits));
    return {_mm256_or_si256(a.low, _mm256_and_si256(from_bits(mask & 0xff), set)),
            _mm256_or_si256(a.high, _mm256_and_si256(from_bits(mask >> 8), set))};
}
inline std::uint32_t less(Words a, Words b) {
    // AVX2 compares signed numbers only.
    const __m256i half = _mm256_set1_epi32(static_cast<int>(0x80000000u));
    const auto of = [&](__m256i x, __m256i y) {
        return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_xor_si256(y, half), _mm256_xor_si256(x, half)));
    };
    return sign_bits(of(a.low, b.low), of(a.high, b.high));
}
inline Words where(std::uint32_t mask, Words then, Words otherwise) {
    return {_mm256_blendv_epi8(otherwise.low, then.low, from_bits(mask & 0xff)),
            _mm256_blendv_epi8(otherwise.high, then.high, from_bits(mask >> 8))};
}
inline std::uint32_t non_zero(Words a) {
    const __m256i zero = _mm256_setzero_si256();
    return ~sign_bits(_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.low, zero)),
                      _mm256_castsi256_ps(_mm256_cmpeq_epi32(a.high, zero))) &
           0xffff;
}
inline Floats to_floats(Words a) { return {_mm256_cvtepi32_ps(a.low), _mm256_cvtepi32_ps(a.high)}; }

inline Words subtract(Words a, Words b) {
    return {_mm256_sub_epi32(a.low, b.low), _mm256_sub_epi32(a.high, b.high)};
}
inline Words product(Words a, Words b) {
    return {_mm256_mullo_epi32(a.low, b.low), _mm256_mullo_epi32(a.high, b.high)};
}
inline Words lower_of(Words a, Words b) {
    return {_mm256_min_epi32(a.low, b.low), _mm256_min_epi32(a.high, b.high)};
}
inline Words higher_of(Words a, Words b) {
    return {_mm256_max_epi32(a.low, b.low), _mm256_max_epi32(a.high, b.high)};
}
inline Words either(Words a, Words b) {
    return {_mm256_or_si256(a.low, b.low), _mm256_or_si256(a.high, b.high)};
}
inline Words exclusive(Words a, Words b) {
    return {_mm256_xor_si256(a.low, b.low), _mm256_xor_si256(a.high, b.high)};
}
inline Words add_halves(Words a, Words b) {
    return {_mm256_add_epi16(a.low, b.low), _mm256_add_epi16(a.high, b.high)};
}
inline Words subtract_halves(Words a, Words b) {
    return {_mm256_sub_epi16(a.low, b.low), _mm256_sub_epi16(a.high, b.high)};
}
inline Words lower_halves(Words a, Words b) {
    return {_mm256_min_epi16(a.low, b.low), _mm256_min_epi16(a.high, b.high)};
}
inline Words higher_halves(Words a, Words b) {
    return {_mm256_max_epi16(a.low, b.low), _mm256_max_epi16(a.high, b.high)};
}
inline Words dot_halves(Words a, Words b) {
    return {_mm256_madd_epi16(a.low, b.low), _mm256_madd_epi16(a.high, b.high)};
}
inline Words magnitude(Words a) { return {_mm256_abs_epi32(a.low), _mm256_abs_epi32(a.high)}; }
template <int kBits>
inline Words shift_right_signed(Words a) {
    return {_mm256_srai_epi32(a.low, kBits), _mm256_srai_epi32(a.high, kBits)};
}
template <int kBits>
inline Words shift_left_halves(Words a) {
    return {_mm256_slli_epi16(a.low, kBits), _mm256_slli_epi16(a.high, kBits)};
}
template <int kBits>
inline Words shift_right_halves(Words a) {
    return {_mm256_srai_epi16(a.low, kBits), _mm256_srai_epi16(a.high, kBits)};
}
inline Words swap_halves(Words a) { return either(shift_left<16>(a), shift_right<16>(a)); }
inline Words rounded(Floats a) { return {_mm256_cvtps_epi32(a.low), _mm256_cvtps_epi32(a.high)}; }
inline Words load_shorts(const std::int16_t* from) {
    const __m256i both = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    return {_mm256_cvtepi16_epi32(_mm256_castsi256_si128(both)),
            _mm256_cvtepi16_epi32(_mm256_extracti128_si256(both, 1))};
}
inline Floats look_up(const float* table, Words at) {
    return {_mm256_i32gather_ps(table, at.low, 4), _mm256_i32gather_ps(table, at.high, 4)};
}
inline Words look_up(const std::uint32_t* table, Words at) {
    const int* const from = reinterpret_cast<const int*>(table);
    return {_mm256_i32gather_epi32(from, at.low, 4), _mm256_i32gather_epi32(from, at.high, 4)};
}
inline Floats look_up64(const float* table, Words at) { return look_up(table, at); }
inline Words look_up64(const std::uint32_t* table, Words at) { return look_up(table, at); }

// A lane holds if its sign bit is set.
struct Truths {
    __m256i low;
    __m256i high;
};
inline Truths negative(Words a) { return {a.low, a.high}; }
inline Truths is_less(Words a, Words b) {
    return {_mm256_cmpgt_epi32(b.low, a.low), _mm256_cmpgt_epi32(b.high, a.high)};
}
inline Truths is_less(Floats a, Floats b) {
    return {_mm256_castps_si256(_mm256_cmp_ps(a.low, b.low, _CMP_LT_OQ)),
            _mm256_castps_si256(_mm256_cmp_ps(a.high, b.high, _CMP_LT_OQ))};
}
inline Truths is_equal(Floats a, Floats b) {
    return {_mm256_castps_si256(_mm256_cmp_ps(a.low, b.low, _CMP_EQ_OQ)),
            _mm256_castps_si256(_mm256_cmp_ps(a.high, b.high, _CMP_EQ_OQ))};
}
inline Truths both(Truths a, Truths b) {
    return {_mm256_and_si256(a.low, b.low), _mm256_and_si256(a.high, b.high)};
}
inline Truths either(Truths a, Truths b) {
    return {_mm256_or_si256(a.low, b.low), _mm256_or_si256(a.high, b.high)};
}
// Those of `a` that are none of `b`.
inline Truths without(Truths a, Truths b) {
    return {_mm256_andnot_si256(b.low, a.low), _mm256_andnot_si256(b.high, a.high)};
}
inline bool any(Truths a) {
    return _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_or_si256(a.low, a.high))) != 0;
}
inline std::uint32_t bits(Truths a) {
    return sign_bits(_mm256_castsi256_ps(a.low), _mm256_castsi256_ps(a.high));
}
inline Floats load_rows(const float* first, const float* second) {
    return {_mm256_loadu_ps(first), _mm256_loadu_ps(second)};
}
inline Words load_rows(const std::uint32_t* first, const std::uint32_t* second) {
    return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(first)),
            _mm256_loadu_si256(reinterpret_cast<const __m256i*>(second))};
}
inline void store_rows_where(float* first, float* second, Truths where, Floats a) {
    _mm256_maskstore_ps(first, where.low, a.low);
    _mm256_maskstore_ps(second, where.high, a.high);
}
inline void store_rows_where(std::uint32_t* first, std::uint32_t* second, Truths where, Words a) {
    _mm256_maskstore_epi32(reinterpret_cast<int*>(first), where.low, a.low);
    _mm256_maskstore_epi32(reinterpret_cast<int*>(second), where.high, a.high);
}

inline std::uint32_t* packed_half(std::uint32_t* out, __m256i a, std::uint32_t mask) {
    // `lanes` lists the numbers of the set bits, one byte each.
    const std::uint64_t bytes = _pdep_u64(mask, 0x0101010101010101) * 0xff;
    const std::uint64_t lanes = _pext_u64(0x0706050403020100, bytes);
    const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(lanes)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_permutevar8x32_epi32(a, order));
    return out + __builtin_popcount(mask);
}
inline std::uint32_t* packed(std::uint32_t* out, Words a, std::uint32_t mask) {
    return packed_half(packed_half(out, a.low, mask & 0xff), a.high, mask >> 8);
}
// store and packed of lanes 0 to 7 alone. They write no more than the next 8 places.
inline void store8(std::uint32_t* to, Words a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.low); }
inline std::uint32_t* packed8(std::uint32_t* out, Words a, std::uint32_t mask) {
    return packed_half(out, a.low, mask);
}

}  // namespace
}  // namespace swath::SWATH_KERNEL
