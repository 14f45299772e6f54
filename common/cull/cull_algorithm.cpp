#include "common/cull/cull_algorithm.h"

#include <array>

#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::array kAlgorithms{CullAlgorithm::kWide, CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb,
                                 CullAlgorithm::kNone};
static_assert(kAlgorithms.size() == kCullAlgorithmCount);

}  // namespace

std::string_view name_of(CullAlgorithm algorithm) {
    switch (algorithm) {
        case CullAlgorithm::kWide:
            return "wide";
        case CullAlgorithm::kA2ssb:
            return "a2ssb";
        case CullAlgorithm::kAdsb:
            return "adsb";
        case CullAlgorithm::kNone:
            return "none";
    }
    CHECK(false);
    return {};
}

std::span<const CullAlgorithm> all_cull_algorithms() { return kAlgorithms; }

std::string cull_algorithm_names() {
    std::string names;
    for (const CullAlgorithm algorithm : kAlgorithms) {
        if (!names.empty()) names += ", ";
        names += name_of(algorithm);
    }
    return names;
}

Result<CullAlgorithm> parse_cull_algorithm(std::string_view name) {
    for (const CullAlgorithm algorithm : kAlgorithms)
        if (name_of(algorithm) == name) return algorithm;
    return fail("culling '{}' is not known; there are: {}", name, cull_algorithm_names());
}

}  // namespace swath
