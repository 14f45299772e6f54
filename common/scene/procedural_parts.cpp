#include "common/scene/procedural_parts.h"

#include <algorithm>
#include <cmath>

namespace swath::procedural {

double sine(double turns) {
    turns -= std::floor(turns + 0.5);
    if (turns > 0.25) turns = 0.5 - turns;
    if (turns < -0.25) turns = -0.5 - turns;
    const double x = turns * 6.283185307179586;
    const double square = x * x;
    double sum = 1;
    for (int k = 16; k > 0; k -= 2) sum = 1 - square / (k * (k + 1)) * sum;
    return x * sum;
}

double cosine(double turns) { return sine(turns + 0.25); }

namespace {

// The finaliser of MurmurHash3.
std::uint32_t hash(std::uint32_t x) {
    x = (x ^ x >> 16) * 0x85ebca6b;
    x = (x ^ x >> 13) * 0xc2b2ae35;
    return x ^ x >> 16;
}

}  // namespace

double random(std::uint32_t seed, std::uint32_t stream) {
    return hash(hash(seed) + 0x9e3779b9 * (stream + 1)) / 4294967295.0;
}

Colour colour(const glm::dvec3& rgb) {
    const auto byte = [](double v) {
        return static_cast<std::uint8_t>(std::clamp(v, 0.0, 1.0) * 255.0 + 0.5);
    };
    return {byte(rgb.x), byte(rgb.y), byte(rgb.z), 255};
}

glm::dvec3 palette(double hue) {
    return {0.58 + 0.38 * cosine(hue), 0.52 + 0.34 * cosine(hue - 0.36), 0.55 + 0.40 * cosine(hue - 0.63)};
}

std::size_t rounded(double value) { return static_cast<std::size_t>(value + 0.5); }

}  // namespace swath::procedural
