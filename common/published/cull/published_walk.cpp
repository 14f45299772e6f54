#include "common/published/cull/published_walk.h"

#include "common/base/check.h"
#include "common/published/cull/algorithms.h"

namespace swath {
namespace {

template <class Tree>
std::unique_ptr<PublishedWalk> make(PublishedAlgorithm algorithm, const Tree& tree, ThreadTeam& team) {
    switch (algorithm) {
        case PublishedAlgorithm::kAdsb:
            return make_adsb(tree, team);
        case PublishedAlgorithm::kAlgo1:
        case PublishedAlgorithm::kAlgo2:
        case PublishedAlgorithm::kAlgo3:
        case PublishedAlgorithm::kAlgo1Lanes:
            return make_a2ssb(algorithm, tree, team);
        case PublishedAlgorithm::kAlgo4:
        case PublishedAlgorithm::kAlgo5:
        case PublishedAlgorithm::kAlgo4Lanes:
            return make_single(algorithm, tree, team);
    }
    CHECK(false);
    return nullptr;
}

}  // namespace

bool has_one_member(PublishedAlgorithm algorithm) {
    return algorithm == PublishedAlgorithm::kAlgo4 || algorithm == PublishedAlgorithm::kAlgo5 ||
           algorithm == PublishedAlgorithm::kAlgo4Lanes;
}

std::string_view name_of(PublishedAlgorithm algorithm) {
    switch (algorithm) {
        case PublishedAlgorithm::kAdsb:
            return "ADSB";
        case PublishedAlgorithm::kAlgo1:
            return "ALGO1";
        case PublishedAlgorithm::kAlgo2:
            return "ALGO2";
        case PublishedAlgorithm::kAlgo3:
            return "ALGO3";
        case PublishedAlgorithm::kAlgo4:
            return "ALGO4";
        case PublishedAlgorithm::kAlgo5:
            return "ALGO5";
        case PublishedAlgorithm::kAlgo1Lanes:
            return "ALGO1 lanes";
        case PublishedAlgorithm::kAlgo4Lanes:
            return "ALGO4 lanes";
    }
    CHECK(false);
    return {};
}

std::unique_ptr<PublishedWalk> make_published_walk(PublishedAlgorithm algorithm, const PointerOctree& tree,
                                                   ThreadTeam& team) {
    return make(algorithm, StoredTree{tree}, team);
}

std::unique_ptr<PublishedWalk> make_published_walk(PublishedAlgorithm algorithm, const UniformOctree& tree,
                                                   ThreadTeam& team) {
    return make(algorithm, ComputedTree{tree}, team);
}

}  // namespace swath
