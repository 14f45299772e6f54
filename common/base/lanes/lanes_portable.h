#pragma once
// See lanes.h. Vectors of four lanes, which SSE2 and NEON have, in the notation of GCC and Clang.
#include <cstdint>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace swath::SWATH_KERNEL {
namespace {

constexpr int kQuads = 4;
using FloatQuad = float __attribute__((vector_size(16)));
using WordQuad = std::uint32_t __attribute__((vector_size(16)));
using Truth = std::int32_t __attribute__((vector_size(16)));  // of a comparison: a lane is 0 or -1

struct Floats {
    FloatQuad v[kQuads];
};
struct Words {
    WordQuad v[kQuads];
};

// These make a value of one quad at a time: of(i) is quad i.
template <class Of>
inline Floats make_floats(Of of) {
    return {of(0), of(1), of(2), of(3)};
}
template <class Of>
inline Words make_words(Of of) {
    return {of(0), of(1), of(2), of(3)};
}
// Of comparisons.
template <class Of>
inline std::uint32_t make_mask(Of of) {
    const Truth quads[kQuads] = {of(0), of(1), of(2), of(3)};
#ifdef __SSE2__
    const auto bytes = [&](int i) { return reinterpret_cast<const __m128i&>(quads[i]); };
    const __m128i first = _mm_packs_epi32(bytes(0), bytes(1));
    const __m128i second = _mm_packs_epi32(bytes(2), bytes(3));
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(first, second)));
#else
    const Truth place{1, 2, 4, 8};
    const Truth bits = (quads[0] & place) | (quads[1] & (place << 4)) | (quads[2] & (place << 8)) |
                       (quads[3] & (place << 12));
    return static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}
// The converse: quad i of a mask.
inline Truth truth(std::uint32_t mask, int i) {
    const std::uint32_t bits = mask >> 4 * i;
    return (WordQuad{bits, bits, bits, bits} & WordQuad{1, 2, 4, 8}) != 0;
}

inline Floats load(const float* from) {
    Floats result;
    __builtin_memcpy(&result, from, sizeof result);
    return result;
}
inline Words load(const std::uint32_t* from) {
    Words result;
    __builtin_memcpy(&result, from, sizeof result);
    return result;
}
inline void store(float* to, const Floats& a) { __builtin_memcpy(to, &a, sizeof a); }
inline void store(std::uint32_t* to, const Words& a) { __builtin_memcpy(to, &a, sizeof a); }

inline Floats all(float value) {
    return make_floats([=](int) { return FloatQuad{value, value, value, value}; });
}
inline Floats add(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] + b.v[i]; });
}
inline Floats subtract(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] - b.v[i]; });
}
inline Floats divide(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] / b.v[i]; });
}
inline Floats multiply(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] * b.v[i]; });
}
inline Floats fused(const Floats& a, const Floats& x, const Floats& t) {
    Floats result;
    for (int i = 0; i < kQuads; ++i)
        for (int j = 0; j < 4; ++j) result.v[i][j] = __builtin_fmaf(a.v[i][j], x.v[i][j], t.v[i][j]);
    return result;
}
inline Floats lower_of(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline Floats higher_of(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline float lowest(const Floats& a) {
    float result = a.v[0][0];
    for (int i = 1; i < 16; ++i) result = a.v[i / 4][i % 4] < result ? a.v[i / 4][i % 4] : result;
    return result;
}
inline float highest(const Floats& a) {
    float result = a.v[0][0];
    for (int i = 1; i < 16; ++i) result = a.v[i / 4][i % 4] > result ? a.v[i / 4][i % 4] : result;
    return result;
}
inline std::uint32_t below_zero(const Floats& a) {
    return make_mask([&](int i) { return a.v[i] < 0.0f; });
}
inline std::uint32_t at_least_zero(const Floats& a) {
    return make_mask([&](int i) { return a.v[i] >= 0.0f; });
}
inline std::uint32_t less(const Floats& a, const Floats& b) {
    return make_mask([&](int i) { return a.v[i] < b.v[i]; });
}
inline std::uint32_t at_most(const Floats& a, const Floats& b) {
    return make_mask([&](int i) { return a.v[i] <= b.v[i]; });
}
inline std::uint32_t equal(const Floats& a, const Floats& b) {
    return make_mask([&](int i) { return a.v[i] == b.v[i]; });
}
inline Floats absolute(const Floats& a) {
    return make_floats([&](int i) { return FloatQuad(WordQuad(a.v[i]) & 0x7fffffffu); });
}
inline Floats where(std::uint32_t mask, const Floats& then, const Floats& otherwise) {
    return make_floats([&](int i) { return truth(mask, i) ? then.v[i] : otherwise.v[i]; });
}

// Puts `first` into lanes 0 to 7 and `second` into lanes 8 to 15.
inline Words halves(std::uint32_t first, std::uint32_t second) {
    return make_words([=](int i) {
        const std::uint32_t value = i < 2 ? first : second;
        return WordQuad{value, value, value, value};
    });
}
inline Words all(std::uint32_t value) { return halves(value, value); }
inline Words add(const Words& a, const Words& b) {
    return make_words([&](int i) { return a.v[i] + b.v[i]; });
}
inline Words both(const Words& a, const Words& b) {
    return make_words([&](int i) { return a.v[i] & b.v[i]; });
}
template <int kBits>
inline Words shift_left(const Words& a) {
    return make_words([&](int i) { return a.v[i] << kBits; });
}
template <int kBits>
inline Words shift_right(const Words& a) {
    return make_words([&](int i) { return a.v[i] >> kBits; });
}
inline Words set_bits_where(const Words& a, std::uint32_t mask, std::uint32_t bits) {
    return make_words([&](int i) { return a.v[i] | (WordQuad(truth(mask, i)) & bits); });
}
inline std::uint32_t less(const Words& a, const Words& b) {
    return make_mask([&](int i) { return a.v[i] < b.v[i]; });
}
inline Words where(std::uint32_t mask, const Words& then, const Words& otherwise) {
    return make_words([&](int i) { return truth(mask, i) ? then.v[i] : otherwise.v[i]; });
}
inline std::uint32_t non_zero(const Words& a) {
    return make_mask([&](int i) { return a.v[i] != 0; });
}
inline Floats to_floats(const Words& a) {
    return make_floats([&](int i) { return __builtin_convertvector(a.v[i], FloatQuad); });
}

inline std::uint32_t* packed(std::uint32_t* out, const Words& a, std::uint32_t mask) {
    std::uint32_t lanes[16];
    store(lanes, a);
    for (; mask != 0; mask &= mask - 1) *out++ = lanes[__builtin_ctz(mask)];
    return out;
}

// store and packed of lanes 0 to 7 alone. They write no more than the next 8 places.
inline void store8(std::uint32_t* to, const Words& a) { __builtin_memcpy(to, &a, sizeof a / 2); }
inline std::uint32_t* packed8(std::uint32_t* out, const Words& a, std::uint32_t mask) {
    return packed(out, a, mask);
}

}  // namespace
}  // namespace swath::SWATH_KERNEL
