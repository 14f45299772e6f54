#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

// Functions for the formulas of the built-in models. They use +, -, *, / and sqrt only, so that every machine
// gets the same bits.
namespace swath::procedural {

// The sine of an angle in turns, because the sines of libraries differ in their last bits. The reduction is
// exact; the polynomial is Taylor's to degree 17, good to 1e-13 on a quarter turn.
double sine(double turns);
double cosine(double turns);

// A number of 0 to 1 that looks random and is the same for the same seed and stream.
double random(std::uint32_t seed, std::uint32_t stream);

using Colour = std::array<std::uint8_t, 4>;
// The opaque colour of red, green and blue, which are clamped to 0 to 1.
Colour colour(const glm::dvec3& rgb);
// Soft, saturated colours in a closed circle; `hue` is in turns.
glm::dvec3 palette(double hue);

// Rounds `value`, which must not be negative, to the nearest.
std::size_t rounded(double value);

}  // namespace swath::procedural
