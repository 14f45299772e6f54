#include "sim/hardware/quantity.h"

#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "common/base/check.h"

namespace swath::sim {
namespace {

struct Suffix {
    std::string_view text;
    double scale;
    bool shown = true;  // to_text may choose it
};

constexpr std::array kTimes{Suffix{"ns", 1e-9}, Suffix{"us", 1e-6}, Suffix{"ms", 1e-3}, Suffix{"s", 1}};
constexpr std::array kBandwidths{Suffix{"B/s", 1},
                                 Suffix{"kB/s", 1e3},
                                 Suffix{"MB/s", 1e6},
                                 Suffix{"GB/s", 1e9},
                                 Suffix{"Mbit/s", 1e6 / 8, false},
                                 Suffix{"Gbit/s", 1e9 / 8, false}};
constexpr std::array kPixelRates{Suffix{"pixel/s", 1}, Suffix{"kpixel/s", 1e3}, Suffix{"Mpixel/s", 1e6},
                                 Suffix{"Gpixel/s", 1e9}};
constexpr std::array kByteCounts{Suffix{"B", 1}};
constexpr std::array kNone{Suffix{"", 1}};

// All that is known of a unit. Its suffix is one of `scaled`, then `per`.
struct Kind {
    Unit unit;
    std::string_view name;
    std::string_view example;
    std::span<const Suffix> scaled;
    std::string_view per;
    double smallest;  // a value beyond these limits is a slip of the pen
    double largest;
    bool may_be_zero;
};

constexpr std::array kKinds{
    Kind{Unit::kTime, "a time", "20 us", kTimes, "", 1e-9, 10, true},
    Kind{Unit::kBandwidth, "bytes a second", "100 MB/s", kBandwidths, "", 1e3, 1e14, false},
    Kind{Unit::kPixelRate, "pixels a second", "20 Mpixel/s", kPixelRates, "", 1e3, 1e14, false},
    Kind{Unit::kPolygonTime, "a time per polygon", "1.33 us/polygon", kTimes, "/polygon", 1e-14, 1, false},
    Kind{Unit::kObjectTime, "a time per object", "3 us/object", kTimes, "/object", 1e-14, 1, true},
    Kind{Unit::kServerTime, "a time per object and server", "0.13 us/object/server", kTimes, "/object/server",
         1e-14, 1, true},
    Kind{Unit::kLevelTime, "a time per object and split level", "12 ns/object/level", kTimes, "/object/level",
         1e-14, 1, true},
    Kind{Unit::kBytesPerPixel, "bytes per pixel", "8 B/pixel", kByteCounts, "/pixel", 0.01, 1000, false},
    Kind{Unit::kShare, "a share", "0.5", kNone, "", 1e-6, 1, false},
};

constexpr const Kind& kind(Unit unit) { return kKinds[static_cast<std::size_t>(unit)]; }
static_assert([] {
    for (std::size_t i = 0; i < kKinds.size(); ++i)
        if (static_cast<std::size_t>(kKinds[i].unit) != i) return false;
    return true;
}());

// The suffix's scale; 0 if the kind has no such suffix.
double scale_of(std::string_view suffix, const Kind& of) {
    for (const Suffix& scaled : of.scaled)
        if (suffix.starts_with(scaled.text) && suffix.substr(scaled.text.size()) == of.per)
            return scaled.scale;
    return 0;
}

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

std::string_view name(Unit unit) { return kind(unit).name; }
std::string_view example(Unit unit) { return kind(unit).example; }

Result<double> parse_quantity(std::string_view text, Unit unit) {
    const Kind& wanted = kind(unit);
    const std::string_view all = trimmed(text);
    double number = 0;
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), number);
    if (error != std::errc{} || !std::isfinite(number))
        return fail("\"{}\" is not a number with a unit, expected e.g. \"{}\"", text, wanted.example);
    const auto length = static_cast<std::size_t>(end - all.data());
    const std::string_view suffix = trimmed(all.substr(length));
    if (suffix.empty() && unit != Unit::kShare)
        return fail("{} has no unit, expected e.g. \"{}\"", all, wanted.example);
    const double scale = scale_of(suffix, wanted);
    if (scale == 0) {
        for (const Kind& other : kKinds)
            if (scale_of(suffix, other) != 0)
                return fail("\"{}\" is {}, expected {}, e.g. \"{}\"", text, other.name, wanted.name,
                            wanted.example);
        return fail("\"{}\" has an unknown unit '{}', expected e.g. \"{}\"", text, suffix, wanted.example);
    }
    const double value = number * scale;
    if (value == 0 && wanted.may_be_zero) return 0.0;
    if (!(value > 0))
        return fail("\"{}\" is not {}", text, wanted.may_be_zero ? "zero or more" : "more than zero");
    if (value < wanted.smallest || value > wanted.largest)
        return fail("\"{}\" is not within {} and {}", text, to_text(wanted.smallest, unit),
                    to_text(wanted.largest, unit));
    return value;
}

std::string to_text(double value, Unit unit) {
    const Kind& shown = kind(unit);
    const Suffix* best = &shown.scaled.front();
    for (const Suffix& suffix : shown.scaled)
        // Chooses the least number of at least 1. A hair below 1 is a rounding error.
        if (suffix.shown && value >= suffix.scale * (1 - 1e-9)) best = &suffix;
    return fmt::format("{:.6g}{}{}{}", value / best->scale, best->text.empty() ? "" : " ", best->text,
                       shown.per);
}

}  // namespace swath::sim
