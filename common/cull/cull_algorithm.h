#pragma once
#include <cstdint>

#include "common/base/names.h"

namespace swath {

// How a server finds what it draws. All draw the same picture. The numbers travel (docs/wire.md).
enum class CullAlgorithm : std::uint8_t {
    kWide = 1,  // the best we know: a hierarchy of 16 children a node, tested at once
    kA2ssb,     // adaptive two-step static balancing over a uniform octree
    kAdsb,      // adaptive delayed static balancing over a uniform octree
    kNone,      // everything may be seen
};
template <>
inline constexpr auto kNames<CullAlgorithm> = names_of<CullAlgorithm>("culling",
                                                                      {{CullAlgorithm::kWide, "wide"},
                                                                       {CullAlgorithm::kA2ssb, "a2ssb"},
                                                                       {CullAlgorithm::kAdsb, "adsb"},
                                                                       {CullAlgorithm::kNone, "none"}});

}  // namespace swath
