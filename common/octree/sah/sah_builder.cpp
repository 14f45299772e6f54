#include "common/octree/sah/sah_builder.h"

#include <unistd.h>

#include <algorithm>
#include <new>

#include "common/base/check.h"
#include "common/octree/sah/sah_build.h"

namespace swath {
namespace {

constexpr std::uint32_t kMinGrain = 2048;

Status check(const SahTriangles& triangles, const SahSettings& settings) {
    if (triangles.count() == 0) return fail("there are no triangles");
    if (triangles.position_count == 0 || triangles.position_count > 0xffff'ffff ||
        triangles.stride % sizeof(float) != 0 || triangles.stride < 3 * sizeof(float))
        return fail("{} positions, {} bytes apart, cannot be", triangles.position_count, triangles.stride);
    if (settings.min_bins < 2 || settings.max_bins < settings.min_bins || settings.max_bins > kMaxBins)
        return fail("{} to {} bins: the limits are 2 and {}", settings.min_bins, settings.max_bins, kMaxBins);
    if (settings.bin_ratio < 1) return fail("a bin ratio of 0");
    if (settings.grain > kMaxGrain ||
        settings.kd_triangles > (settings.grain > 0 ? settings.grain : kMinGrain))
        return fail("kd-trees of {} triangles and a grain of {}: the limits are the grain (or {}) and {}",
                    settings.kd_triangles, settings.grain, kMinGrain, kMaxGrain);
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

std::size_t machine_bytes() {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_bytes = sysconf(_SC_PAGE_SIZE);
    return pages > 0 && page_bytes > 0
               ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page_bytes)
               : SIZE_MAX;
}

}  // namespace

std::string missing_cuda() {
    std::string why;
    make_cuda_build(why);
    return why;
}

SahBuilder::SahBuilder(std::size_t threads, SahDevice device) : threads_(threads) {
    CHECK(threads > 0u);
    if (device == SahDevice::kCuda) build_ = make_cuda_build(fallback_);
    if (build_)
        device_ = SahDevice::kCuda;
    else
        build_ = make_tbb_build(threads_);
}

SahBuilder::~SahBuilder() = default;

Result<SahTree> SahBuilder::build(const SahTriangles& triangles, const SahSettings& settings) {
    if (const auto status = check(triangles, settings); !status) return tl::unexpected(status.error());
    SahSettings limited = settings;
    limited.max_bytes = std::min(limited.max_bytes, machine_bytes());
    if (limited.grain == 0)
        limited.grain =
            static_cast<std::uint32_t>(std::clamp<std::size_t>(triangles.count() / 64, kMinGrain, kMaxGrain));
    try {
        SahOutcome outcome = build_->build(triangles, limited);
        if (!outcome.error.empty()) return fail("{}", outcome.error);
        return std::move(outcome.tree);
    } catch (const std::bad_alloc&) {
        // What it has grown to may be what is missing.
        if (device_ == SahDevice::kThreads) build_ = make_tbb_build(threads_);
        return fail("not enough memory for a tree over {} triangles", triangles.count());
    }
}

}  // namespace swath
