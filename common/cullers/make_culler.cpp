#include "common/cullers/make_culler.h"

#include "common/base/check.h"
#include "common/cull/wide/wide_culler.h"
#include "common/published/cull/octree_culler.h"

namespace swath {

std::unique_ptr<Culler> make_culler(CullAlgorithm algorithm, std::span<const Box> boxes, ThreadTeam& team) {
    switch (algorithm) {
        case CullAlgorithm::kWide:
            return std::make_unique<WideCuller>(boxes, team);
        case CullAlgorithm::kA2ssb:
            return make_octree_culler(PublishedAlgorithm::kAlgo1Lanes, boxes, team);
        case CullAlgorithm::kAdsb:
            return make_octree_culler(PublishedAlgorithm::kAdsb, boxes, team);
        case CullAlgorithm::kNone:
            return nullptr;
    }
    CHECK(false);
    return nullptr;
}

LeafCull make_leaf_cull(CullAlgorithm algorithm, const ObjectSet& scene, ThreadTeam& team) {
    return {make_culler(algorithm, leaf_boxes(scene), team), scene};
}

}  // namespace swath
