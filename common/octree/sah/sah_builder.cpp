#include "common/octree/sah/sah_builder.h"

#include <unistd.h>

#include <algorithm>
#include <new>

#include "common/base/check.h"
#include "common/octree/sah/sah_build.h"
#include "common/octree/sah/sah_check.h"

namespace swath {
namespace {

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
    SWATH_TRY_VOID(check_sah(triangles, settings));
    SahSettings limited = settings;
    limited.max_bytes = std::min(limited.max_bytes, machine_bytes());
    if (limited.grain == 0)
        limited.grain = static_cast<std::uint32_t>(
            std::clamp<std::size_t>(triangles.count() / 64, kMinSahGrain, kMaxGrain));
    try {
        SahOutcome outcome = build_->build(triangles, limited);
        if (!outcome.error.empty()) return fail("{}", outcome.error);
        return std::move(outcome.tree);
    } catch (const std::bad_alloc&) {
        // Frees the builder's memory, which may be what is missing.
        if (device_ == SahDevice::kThreads) build_ = make_tbb_build(threads_);
        return fail("not enough memory for a tree over {} triangles", triangles.count());
    }
}

}  // namespace swath
