#include "common/octree/sah/sah_check.h"

#include "common/octree/sah/sah_tree.h"

namespace swath {

Status check_sah(const SahTriangles& triangles, const SahSettings& settings) {
    if (triangles.count() == 0) return fail("there are no triangles");
    if (triangles.position_count == 0 || triangles.position_count > 0xffff'ffff ||
        triangles.stride % sizeof(float) != 0 || triangles.stride < 3 * sizeof(float))
        return fail("{} positions, {} bytes apart, cannot be", triangles.position_count, triangles.stride);
    if (settings.min_bins < 2 || settings.max_bins < settings.min_bins || settings.max_bins > kMaxBins)
        return fail("{} to {} bins: the limits are 2 and {}", settings.min_bins, settings.max_bins, kMaxBins);
    if (settings.bin_ratio < 1) return fail("a bin ratio of 0");
    if (settings.grain > kMaxGrain ||
        settings.kd_triangles > (settings.grain > 0 ? settings.grain : kMinSahGrain))
        return fail("kd-trees of {} triangles and a grain of {}: the limits are the grain (or {}) and {}",
                    settings.kd_triangles, settings.grain, kMinSahGrain, kMaxGrain);
    if (!(settings.traversal_cost >= 0.0f && settings.traversal_cost <= 1e6f) ||
        !(settings.intersection_cost >= 1e-6f && settings.intersection_cost <= 1e6f))
        return fail("costs of {} and {}: the limits are 0 (1e-6 for the second) and 1e6",
                    settings.traversal_cost, settings.intersection_cost);
    if (!(settings.least_gain >= 0.0f && settings.least_gain <= 1.0f))
        return fail("a least gain of {}: the limits are 0 and 1", settings.least_gain);
    if (settings.max_duplication < 1) return fail("a duplication of 0");
    if (triangles.count() > kMaxSahNodes / 2 / settings.max_duplication)
        return fail(
            "a tree over {} triangles, which may stand in {} leaves each, is beyond the limit of {} nodes",
            triangles.count(), settings.max_duplication, kMaxSahNodes);
    return {};
}

}  // namespace swath
