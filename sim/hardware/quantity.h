#pragma once
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace swath::sim {

// The kind of quantity that a number of a profile is.
enum class Unit {
    kTime,           // s
    kBandwidth,      // B/s
    kPixelRate,      // pixel/s
    kPolygonTime,    // s/polygon
    kObjectTime,     // s/object
    kServerTime,     // s/object/server
    kLevelTime,      // s/object/level
    kBytesPerPixel,  // B/pixel
    kShare,          // a bare number, more than 0 and at most 1
};

// "a time", and a sample value as a profile writes it: "20 us".
std::string_view name(Unit unit);
std::string_view example(Unit unit);

// "1.33 us/polygon" -> 1.33e-6. Numbers are as in C without hexadecimal, in every locale. Errors: a number
// that is not positive (times: negative), or outside of anything that exists.
Result<double> parse_quantity(std::string_view text, Unit unit);

// Writes the value with the unit that a person would choose. parse_quantity reads it back (to six digits).
std::string to_text(double value, Unit unit);

}  // namespace swath::sim
