#pragma once
#include <span>
#include <string_view>
#include <variant>

#include "sim/hardware/hardware.h"
#include "sim/hardware/quantity.h"

namespace swath::sim {

// Refers to the member of Hardware that holds a key's value.
using Place = std::variant<double& (*)(Hardware&), std::optional<double>& (*)(Hardware&),
                           bool& (*)(Hardware&), Compositing& (*)(Hardware&), std::string& (*)(Hardware&)>;

// Says when a profile without a base must have a key; kForGraphics and kForHost: with that compositing.
enum class Need { kAlways, kForGraphics, kForHost, kOptional };

// A key of a profile. The one table of keys drives reading, explain(), and the test of README.md.
struct Key {
    std::string_view name;  // "network.latency": key `latency` of [network]
    Place place;
    Unit unit;  // numbers only
    Need need;
    std::string_view meaning;
};

std::span<const Key> hardware_keys();

// A sample value as a profile writes it: `"20 us"`.
std::string example(const Key& key);

inline constexpr std::string_view kGraphicsWord = "graphics";
inline constexpr std::string_view kHostWord = "host";

}  // namespace swath::sim
