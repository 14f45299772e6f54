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
