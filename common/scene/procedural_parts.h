#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

// What the formulas of the built-in models are made of: +, -, *, / and sqrt only, so that every machine gets
// the same bits.
namespace swath::procedural {

// The sine of an angle in turns. Our own, because the libraries' differ in their last bits. The reduction is
// exact; the polynomial is Taylor's to degree 17, good to 1e-13 on a quarter turn.
double sine(double turns);
double cosine(double turns);

// 0 to 1, a stream of them for each seed.
double random(std::uint32_t seed, std::uint32_t stream);

using Colour = std::array<std::uint8_t, 4>;
// Red, green and blue of 0 to 1, clamped; opaque.
Colour colour(const glm::dvec3& rgb);
// A closed walk through soft, saturated colours; the hue is in turns.
glm::dvec3 palette(double hue);

// To the nearest; `value` is not negative.
std::size_t rounded(double value);

}  // namespace swath::procedural
