#pragma once
// See lanes.h. Plain arrays, which the compiler vectorises as it can.
#include <cstdint>

namespace swath::SWATH_KERNEL {
namespace {

struct Floats {
    float v[16];
};
struct Words {
    std::uint32_t v[16];
};

// These make a value of one lane at a time: of(i) is lane i.
template <class Of>
inline Floats make_floats(Of of) {
    Floats result;
    for (int i = 0; i < 16; ++i) result.v[i] = of(i);
    return result;
}
template <class Of>
inline Words make_words(Of of) {
    Words result;
    for (int i = 0; i < 16; ++i) result.v[i] = of(i);
    return result;
}
template <class Of>
inline std::uint32_t make_mask(Of of) {
    std::uint32_t mask = 0;
    for (int i = 0; i < 16; ++i) mask |= static_cast<std::uint32_t>(of(i)) << i;
    return mask;
}

inline Floats load(const float* from) {
    return make_floats([=](int i) { return from[i]; });
}
inline Floats all(float value) {
    return make_floats([=](int) { return value; });
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
    return make_floats([&](int i) { return __builtin_fmaf(a.v[i], x.v[i], t.v[i]); });
}
inline Floats lower_of(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline Floats higher_of(const Floats& a, const Floats& b) {
    return make_floats([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline float lowest(const Floats& a) {
    float result = a.v[0];
    for (int i = 1; i < 16; ++i) result = a.v[i] < result ? a.v[i] : result;
    return result;
}
inline float highest(const Floats& a) {
    float result = a.v[0];
    for (int i = 1; i < 16; ++i) result = a.v[i] > result ? a.v[i] : result;
    return result;
}
inline std::uint32_t below_zero(const Floats& a) {
    return make_mask([&](int i) { return a.v[i] < 0; });
}
inline std::uint32_t at_least_zero(const Floats& a) {
    return make_mask([&](int i) { return a.v[i] >= 0; });
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
    return make_floats([&](int i) { return __builtin_fabsf(a.v[i]); });
}
inline Floats where(std::uint32_t mask, const Floats& then, const Floats& otherwise) {
    return make_floats([&](int i) { return (mask >> i & 1) != 0 ? then.v[i] : otherwise.v[i]; });
}

inline Words load(const std::uint32_t* from) {
    return make_words([=](int i) { return from[i]; });
}
inline void store(std::uint32_t* to, const Words& a) {
    for (int i = 0; i < 16; ++i) to[i] = a.v[i];
}
inline void store(float* to, const Floats& a) {
    for (int i = 0; i < 16; ++i) to[i] = a.v[i];
}
// Puts `first` into lanes 0 to 7 and `second` into lanes 8 to 15.
inline Words halves(std::uint32_t first, std::uint32_t second) {
    return make_words([=](int i) { return i < 8 ? first : second; });
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
    return make_words([&](int i) { return a.v[i] | ((mask >> i & 1) != 0 ? bits : 0); });
}
inline std::uint32_t less(const Words& a, const Words& b) {
    return make_mask([&](int i) { return a.v[i] < b.v[i]; });
}
inline Words where(std::uint32_t mask, const Words& then, const Words& otherwise) {
    return make_words([&](int i) { return (mask >> i & 1) != 0 ? then.v[i] : otherwise.v[i]; });
}
inline std::uint32_t non_zero(const Words& a) {
    return make_mask([&](int i) { return a.v[i] != 0; });
}
inline Floats to_floats(const Words& a) {
    return make_floats([&](int i) { return static_cast<float>(a.v[i]); });
}

inline std::uint32_t* packed(std::uint32_t* out, const Words& a, std::uint32_t mask) {
    for (; mask != 0; mask &= mask - 1) *out++ = a.v[__builtin_ctz(mask)];
    return out;
}

// store and packed of lanes 0 to 7 alone. They write no more than the next 8 places.
inline void store8(std::uint32_t* to, const Words& a) {
    for (int i = 0; i < 8; ++i) to[i] = a.v[i];
}
inline std::uint32_t* packed8(std::uint32_t* out, const Words& a, std::uint32_t mask) {
    return packed(out, a, mask);
}

}  // namespace
}  // namespace swath::SWATH_KERNEL
