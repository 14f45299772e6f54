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
    return make_floats([&](int i) { return __builtin_convertvector(Truth(a.v[i]), FloatQuad); });
}

using Halves = std::int16_t __attribute__((vector_size(16)));
using HalvesModulo = std::uint16_t __attribute__((vector_size(16)));

inline Words subtract(const Words& a, const Words& b) {
    return make_words([&](int i) { return a.v[i] - b.v[i]; });
}
inline Words product(const Words& a, const Words& b) {
    return make_words([&](int i) { return a.v[i] * b.v[i]; });
}
inline Words either(const Words& a, const Words& b) {
    return make_words([&](int i) { return a.v[i] | b.v[i]; });
}
inline Words exclusive(const Words& a, const Words& b) {
    return make_words([&](int i) { return a.v[i] ^ b.v[i]; });
}
inline Words lower_of(const Words& a, const Words& b) {
    return make_words([&](int i) { return Truth(a.v[i]) < Truth(b.v[i]) ? a.v[i] : b.v[i]; });
}
inline Words higher_of(const Words& a, const Words& b) {
    return make_words([&](int i) { return Truth(a.v[i]) > Truth(b.v[i]) ? a.v[i] : b.v[i]; });
}
inline Words add_halves(const Words& a, const Words& b) {
    return make_words([&](int i) { return WordQuad(HalvesModulo(a.v[i]) + HalvesModulo(b.v[i])); });
}
inline Words subtract_halves(const Words& a, const Words& b) {
    return make_words([&](int i) { return WordQuad(HalvesModulo(a.v[i]) - HalvesModulo(b.v[i])); });
}
inline Words lower_halves(const Words& a, const Words& b) {
    return make_words(
        [&](int i) { return WordQuad(Halves(a.v[i]) < Halves(b.v[i]) ? Halves(a.v[i]) : Halves(b.v[i])); });
}
inline Words higher_halves(const Words& a, const Words& b) {
    return make_words(
        [&](int i) { return WordQuad(Halves(a.v[i]) > Halves(b.v[i]) ? Halves(a.v[i]) : Halves(b.v[i])); });
}
inline Words dot_halves(const Words& a, const Words& b) {
    return make_words([&](int i) {
#ifdef __SSE2__
        return WordQuad(_mm_madd_epi16(__m128i(a.v[i]), __m128i(b.v[i])));
#else
        const Truth x = Truth(a.v[i]);
        const Truth y = Truth(b.v[i]);
        return WordQuad((x << 16 >> 16) * (y << 16 >> 16) + (x >> 16) * (y >> 16));
#endif
    });
}
inline Words magnitude(const Words& a) {
    return make_words([&](int i) {
        const WordQuad sign = WordQuad(Truth(a.v[i]) >> 31);
        return (a.v[i] ^ sign) - sign;
    });
}
template <int kBits>
inline Words shift_right_signed(const Words& a) {
    return make_words([&](int i) { return WordQuad(Truth(a.v[i]) >> kBits); });
}
template <int kBits>
inline Words shift_left_halves(const Words& a) {
    return make_words([&](int i) { return WordQuad(HalvesModulo(a.v[i]) << kBits); });
}
template <int kBits>
inline Words shift_right_halves(const Words& a) {
    return make_words([&](int i) { return WordQuad(Halves(a.v[i]) >> kBits); });
}
inline Words swap_halves(const Words& a) { return either(shift_left<16>(a), shift_right<16>(a)); }
inline Words rounded(const Floats& a) {
    return make_words([&](int i) {
#ifdef __SSE2__
        return WordQuad(_mm_cvtps_epi32(__m128(a.v[i])));
#else
        WordQuad result;
        for (int j = 0; j < 4; ++j)
            result[j] = static_cast<std::uint32_t>(static_cast<std::int32_t>(__builtin_rintf(a.v[i][j])));
        return result;
#endif
    });
}
inline Words load_shorts(const std::int16_t* from) {
    Words result;
    for (int i = 0; i < 16; ++i)
        result.v[i / 4][i % 4] = static_cast<std::uint32_t>(static_cast<std::int32_t>(from[i]));
    return result;
}
inline Floats look_up(const float* table, const Words& at) {
    return make_floats([&](int i) {
        return FloatQuad{table[at.v[i][0]], table[at.v[i][1]], table[at.v[i][2]], table[at.v[i][3]]};
    });
}
inline Words look_up(const std::uint32_t* table, const Words& at) {
    return make_words([&](int i) {
        return WordQuad{table[at.v[i][0]], table[at.v[i][1]], table[at.v[i][2]], table[at.v[i][3]]};
    });
}
inline Floats look_up64(const float* table, const Words& at) { return look_up(table, at); }
inline Words look_up64(const std::uint32_t* table, const Words& at) { return look_up(table, at); }

// A lane is 0 or -1.
struct Truths {
    Truth v[kQuads];
};
template <class Of>
inline Truths make_truths(Of of) {
    return {of(0), of(1), of(2), of(3)};
}
inline Truths negative(const Words& a) {
    return make_truths([&](int i) { return Truth(a.v[i]) < 0; });
}
inline Truths is_less(const Words& a, const Words& b) {
    return make_truths([&](int i) { return Truth(a.v[i]) < Truth(b.v[i]); });
}
inline Truths is_less(const Floats& a, const Floats& b) {
    return make_truths([&](int i) { return a.v[i] < b.v[i]; });
}
inline Truths is_equal(const Floats& a, const Floats& b) {
    return make_truths([&](int i) { return a.v[i] == b.v[i]; });
}
inline Truths both(const Truths& a, const Truths& b) {
    return make_truths([&](int i) { return a.v[i] & b.v[i]; });
}
inline Truths either(const Truths& a, const Truths& b) {
    return make_truths([&](int i) { return a.v[i] | b.v[i]; });
}
// Those of `a` that are none of `b`.
inline Truths without(const Truths& a, const Truths& b) {
    return make_truths([&](int i) { return a.v[i] & ~b.v[i]; });
}
inline std::uint32_t bits(const Truths& a) {
    return make_mask([&](int i) { return a.v[i]; });
}
inline bool any(const Truths& a) {
    const Truth all = a.v[0] | a.v[1] | a.v[2] | a.v[3];
#ifdef __SSE2__
    return _mm_movemask_epi8(__m128i(all)) != 0;
#else
    return (all[0] | all[1] | all[2] | all[3]) != 0;
#endif
}
template <class Vector, class Number>
inline Vector rows(const Number* first, const Number* second) {
    Vector result;
    __builtin_memcpy(&result, first, sizeof result / 2);
    __builtin_memcpy(reinterpret_cast<char*>(&result) + sizeof result / 2, second, sizeof result / 2);
    return result;
}
inline Floats load_rows(const float* first, const float* second) { return rows<Floats>(first, second); }
inline Words load_rows(const std::uint32_t* first, const std::uint32_t* second) {
    return rows<Words>(first, second);
}
inline void store_rows_where(std::uint32_t* first, std::uint32_t* second, const Truths& where,
                             const Words& a) {
    const Words old = load_rows(first, second);
    const Words result = make_words([&](int i) { return where.v[i] ? a.v[i] : old.v[i]; });
    __builtin_memcpy(first, &result, sizeof result / 2);
    __builtin_memcpy(second, reinterpret_cast<const char*>(&result) + sizeof result / 2, sizeof result / 2);
}
inline void store_rows_where(float* first, float* second, const Truths& where, const Floats& a) {
    const Floats old = load_rows(first, second);
    const Floats result = make_floats([&](int i) { return where.v[i] ? a.v[i] : old.v[i]; });
    __builtin_memcpy(first, &result, sizeof result / 2);
    __builtin_memcpy(second, reinterpret_cast<const char*>(&result) + sizeof result / 2, sizeof result / 2);
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
