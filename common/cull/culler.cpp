#include "common/cull/culler.h"

#include <array>
#include <numeric>
#include <vector>

#include "common/base/check.h"
#include "common/cull/published/octree_culler.h"
#include "common/cull/wide/wide_culler.h"

namespace swath {
namespace {

constexpr std::array kAlgorithms{CullAlgorithm::kWide, CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb,
                                 CullAlgorithm::kNone};
static_assert(kAlgorithms.size() == kCullAlgorithmCount);

class NoCuller final : public Culler {
  public:
    explicit NoCuller(std::size_t boxes) : all_(boxes) { std::iota(all_.begin(), all_.end(), 0u); }
    std::span<const std::uint32_t> cull(const Frustum& /*frustum*/) override { return all_; }
    void refit(std::span<const Box> boxes) override { CHECK(boxes.size() == all_.size()); }

  private:
    std::vector<std::uint32_t> all_;
};

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

std::unique_ptr<Culler> make_culler(CullAlgorithm algorithm, std::span<const Box> boxes, ThreadTeam& team) {
    switch (algorithm) {
        case CullAlgorithm::kWide:
            return std::make_unique<WideCuller>(boxes, team);
        case CullAlgorithm::kA2ssb:
            return make_octree_culler(PublishedAlgorithm::kAlgo1Lanes, boxes, team);
        case CullAlgorithm::kAdsb:
            return make_octree_culler(PublishedAlgorithm::kAdsb, boxes, team);
        case CullAlgorithm::kNone:
            return std::make_unique<NoCuller>(boxes.size());
    }
    CHECK(false);
    return nullptr;
}

}  // namespace swath
