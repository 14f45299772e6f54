#include "sim/picture/colours.h"

#include <algorithm>
#include <cmath>

namespace swath::sim {
namespace {

// Converts Björn Ottosson's OKLCH (hue in turns) to sRGB. Equal lightness looks equally light at every hue.
Rgb from_oklch(double lightness, double chroma, double hue) {
    const double a = chroma * std::cos(2 * 3.141592653589793 * hue);
    const double b = chroma * std::sin(2 * 3.141592653589793 * hue);
    const auto cube = [](double v) { return v * v * v; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
    const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
    const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    const auto byte = [](double linear) {
        const double v = std::clamp(linear, 0.0, 1.0);
        const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(encoded * 255 + 0.5);
    };
    return {byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Rgb server_colour(ServerId id) {
    // The plastic number's sequence spreads points over a square as evenly as the golden ratio's does over a
    // line.
    const auto step = [&](double part) {
        const double at = 0.5 + part * static_cast<double>(index(id));
        return at - std::floor(at);
    };
    return from_oklch(0.56 + 0.34 * step(0.5698402909980532), 0.15, step(0.7548776662466927));
}

Rgb blend(const Rgb& under, const Rgb& over, double opacity) {
    Rgb mixed;
    for (std::size_t c = 0; c < mixed.size(); ++c)
        mixed[c] = static_cast<std::uint8_t>(under[c] + (over[c] - under[c]) * opacity + 0.5);
    return mixed;
}

}  // namespace swath::sim
