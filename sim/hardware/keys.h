#pragma once
#include <span>
#include <string_view>
#include <variant>

#include "sim/hardware/hardware.h"
#include "sim/hardware/quantity.h"

namespace swath::sim {

// Where a key's value lives.
using Place = std::variant<double& (*)(Hardware&), std::optional<double>& (*)(Hardware&),
                           bool& (*)(Hardware&), Compositing& (*)(Hardware&), std::string& (*)(Hardware&)>;

// When a profile without a base has to have a key: kForGraphics and kForHost with that compositing.
enum class Need { kAlways, kForGraphics, kForHost, kOptional };

// A key of a profile. The one table of them drives reading, explain(), and the test of README.md.
struct Key {
    std::string_view name;  // "network.latency": key `latency` of [network]
    Place place;
    Unit unit;  // of a number; otherwise not looked at
    Need need;
    std::string_view meaning;
};

std::span<const Key> hardware_keys();

// What a value of the key looks like in a profile: `"20 us"`.
std::string example(const Key& key);

inline constexpr std::string_view kGraphicsWord = "graphics";
inline constexpr std::string_view kHostWord = "host";

}  // namespace swath::sim
