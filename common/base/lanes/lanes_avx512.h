#pragma once
// See lanes.h. One register holds the sixteen lanes.
#include <cstdint>

// GCC 12 warns about registers that its own header leaves undefined on purpose.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace swath::SWATH_KERNEL {
namespace {

struct Floats {
    __m512 v;
};
struct Words {
    __m512i v;
};

inline Floats load(const float* from) { return {_mm512_loadu_ps(from)}; }
inline Floats all(float value) { return {_mm512_set1_ps(value)}; }
inline Floats add(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Floats divide(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Floats fused(Floats a, Floats x, Floats t) { return {_mm512_fmadd_ps(a.v, x.v, t.v)}; }
inline Floats lower_of(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats higher_of(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline float lowest(Floats a) { return _mm512_reduce_min_ps(a.v); }
inline float highest(Floats a) { return _mm512_reduce_max_ps(a.v); }
inline std::uint32_t below_zero(Floats a) { return _mm512_cmp_ps_mask(a.v, _mm512_setzero_ps(), _CMP_LT_OQ); }
inline std::uint32_t at_least_zero(Floats a) {
    return _mm512_cmp_ps_mask(a.v, _mm512_setzero_ps(), _CMP_GE_OQ);
}
inline std::uint32_t less(Floats a, Floats b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
inline std::uint32_t at_most(Floats a, Floats b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ); }
inline std::uint32_t equal(Floats a, Floats b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ); }
inline Floats absolute(Floats a) { return {_mm512_abs_ps(a.v)}; }
inline Floats where(std::uint32_t mask, Floats then, Floats otherwise) {
    return {_mm512_mask_mov_ps(otherwise.v, static_cast<__mmask16>(mask), then.v)};
}

inline Words load(const std::uint32_t* from) { return {_mm512_loadu_si512(from)}; }
inline void store(std::uint32_t* to, Words a) { _mm512_storeu_si512(to, a.v); }
inline void store(float* to, Floats a) { _mm512_storeu_ps(to, a.v); }
inline Words all(std::uint32_t value) { return {_mm512_set1_epi32(static_cast<int>(value))}; }
inline Words add(Words a, Words b) { return {_mm512_add_epi32(a.v, b.v)}; }
inline Words both(Words a, Words b) { return {_mm512_and_si512(a.v, b.v)}; }
template <int kBits>
inline Words shift_left(Words a) {
    return {_mm512_slli_epi32(a.v, kBits)};
}
template <int kBits>
inline Words shift_right(Words a) {
    return {_mm512_srli_epi32(a.v, kBits)};
}
inline Words set_bits_where(Words a, std::uint32_t mask, std::uint32_t bits) {
    return {_mm512_mask_or_epi32(a.v, static_cast<__mmask16>(mask), a.v,
                                 _mm512_set1_epi32(static_cast<int>(bits)))};
}
inline std::uint32_t less(Words a, Words b) { return _mm512_cmplt_epu32_mask(a.v, b.v); }
inline Words where(std::uint32_t mask, Words then, Words otherwise) {
    return {_mm512_mask_blend_epi32(static_cast<__mmask16>(mask), otherwise.v, then.v)};
}
inline std::uint32_t non_zero(Words a) { return _mm512_test_epi32_mask(a.v, a.v); }
inline Floats to_floats(Words a) { return {_mm512_cvtepi32_ps(a.v)}; }
// Puts `first` into lanes 0 to 7 and `second` into lanes 8 to 15.
inline Words halves(std::uint32_t first, std::uint32_t second) {
    const __m512i low = _mm512_set1_epi32(static_cast<int>(first));
    return {_mm512_mask_set1_epi32(low, 0xff00, static_cast<int>(second))};
}

inline Words subtract(Words a, Words b) { return {_mm512_sub_epi32(a.v, b.v)}; }
inline Words product(Words a, Words b) { return {_mm512_mullo_epi32(a.v, b.v)}; }
inline Words lower_of(Words a, Words b) { return {_mm512_min_epi32(a.v, b.v)}; }
inline Words higher_of(Words a, Words b) { return {_mm512_max_epi32(a.v, b.v)}; }
inline Words either(Words a, Words b) { return {_mm512_or_si512(a.v, b.v)}; }
inline Words exclusive(Words a, Words b) { return {_mm512_xor_si512(a.v, b.v)}; }
inline Words add_halves(Words a, Words b) { return {_mm512_add_epi16(a.v, b.v)}; }
inline Words subtract_halves(Words a, Words b) { return {_mm512_sub_epi16(a.v, b.v)}; }
inline Words lower_halves(Words a, Words b) { return {_mm512_min_epi16(a.v, b.v)}; }
inline Words higher_halves(Words a, Words b) { return {_mm512_max_epi16(a.v, b.v)}; }
inline Words dot_halves(Words a, Words b) { return {_mm512_madd_epi16(a.v, b.v)}; }
inline Words magnitude(Words a) { return {_mm512_abs_epi32(a.v)}; }
template <int kBits>
inline Words shift_right_signed(Words a) {
    return {_mm512_srai_epi32(a.v, kBits)};
}
template <int kBits>
inline Words shift_left_halves(Words a) {
    return {_mm512_slli_epi16(a.v, kBits)};
}
template <int kBits>
inline Words shift_right_halves(Words a) {
    return {_mm512_srai_epi16(a.v, kBits)};
}
inline Words swap_halves(Words a) { return {_mm512_rol_epi32(a.v, 16)}; }
inline Words rounded(Floats a) { return {_mm512_cvtps_epi32(a.v)}; }
inline Words load_shorts(const std::int16_t* from) {
    return {_mm512_cvtepi16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)))};
}
inline Floats look_up(const float* table, Words at) { return {_mm512_i32gather_ps(at.v, table, 4)}; }
inline Words look_up(const std::uint32_t* table, Words at) {
    return {_mm512_i32gather_epi32(at.v, table, 4)};
}
inline Words look_up64(const std::uint32_t* table, Words at) {
    const __m512i low = _mm512_permutex2var_epi32(load(table).v, at.v, load(table + 16).v);
    const __m512i high = _mm512_permutex2var_epi32(load(table + 32).v, at.v, load(table + 48).v);
    return {_mm512_mask_mov_epi32(low, _mm512_test_epi32_mask(at.v, _mm512_set1_epi32(32)), high)};
}
inline Floats look_up64(const float* table, Words at) {
    return {_mm512_castsi512_ps(look_up64(reinterpret_cast<const std::uint32_t*>(table), at).v)};
}

struct Truths {
    __mmask16 v;
};
inline Truths negative(Words a) { return {_mm512_movepi32_mask(a.v)}; }
inline Truths is_less(Words a, Words b) { return {_mm512_cmplt_epi32_mask(a.v, b.v)}; }
inline Truths is_less(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Truths is_equal(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
inline Truths both(Truths a, Truths b) { return {_kand_mask16(a.v, b.v)}; }
inline Truths either(Truths a, Truths b) { return {_kor_mask16(a.v, b.v)}; }
// Those of `a` that are none of `b`.
inline Truths without(Truths a, Truths b) { return {_kandn_mask16(b.v, a.v)}; }
inline bool any(Truths a) { return a.v != 0; }
inline std::uint32_t bits(Truths a) { return a.v; }
inline Floats load_rows(const float* first, const float* second) {
    return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(first)), _mm256_loadu_ps(second), 1)};
}
inline Words load_rows(const std::uint32_t* first, const std::uint32_t* second) {
    return {_mm512_inserti32x8(
        _mm512_castsi256_si512(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(first))),
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(second)), 1)};
}
inline void store_rows_where(float* first, float* second, Truths where, Floats a) {
    _mm256_mask_storeu_ps(first, static_cast<__mmask8>(where.v), _mm512_castps512_ps256(a.v));
    _mm256_mask_storeu_ps(second, static_cast<__mmask8>(where.v >> 8), _mm512_extractf32x8_ps(a.v, 1));
}
inline void store_rows_where(std::uint32_t* first, std::uint32_t* second, Truths where, Words a) {
    _mm256_mask_storeu_epi32(first, static_cast<__mmask8>(where.v), _mm512_castsi512_si256(a.v));
    _mm256_mask_storeu_epi32(second, static_cast<__mmask8>(where.v >> 8), _mm512_extracti32x8_epi32(a.v, 1));
}

inline std::uint32_t* packed(std::uint32_t* out, Words a, std::uint32_t mask) {
    // Compressing into a register first is many times faster on some processors than straight into memory.
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), a.v));
    return out + __builtin_popcount(mask);
}

// store and packed of lanes 0 to 7 alone. They write no more than the next 8 places.
inline void store8(std::uint32_t* to, Words a) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_castsi512_si256(a.v));
}
inline std::uint32_t* packed8(std::uint32_t* out, Words a, std::uint32_t mask) {
    store8(out, {_mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), a.v)});
    return out + __builtin_popcount(mask);
}

}  // namespace
}  // namespace swath::SWATH_KERNEL
