#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace swath {

// How a server finds what it draws. All draw the same picture.
enum class CullAlgorithm : std::uint8_t {
    kWide,   // the best we know: a hierarchy of 16 children a node, tested at once
    kA2ssb,  // adaptive two-step static balancing over a uniform octree
    kAdsb,   // adaptive delayed static balancing over a uniform octree
    kNone,   // everything may be seen
};
inline constexpr std::size_t kCullAlgorithmCount = 4;

// The one list, in the order in which they are named everywhere.
std::span<const CullAlgorithm> all_cull_algorithms();
// "wide", "a2ssb", "adsb", "none".
std::string_view name_of(CullAlgorithm algorithm);
std::string cull_algorithm_names();  // with commas between
Result<CullAlgorithm> parse_cull_algorithm(std::string_view name);

}  // namespace swath
