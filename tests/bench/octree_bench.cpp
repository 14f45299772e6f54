#include "tests/bench/octree_bench.h"

namespace swath::bench {

Status bench_octree(Figures& figures, const Effort& effort) {
    if (!effort.out.empty()) {  // fails before minutes of measuring, not after
        std::error_code error;
        std::filesystem::create_directories(effort.out, error);
        if (error) return fail("{}: {}", effort.out.string(), error.message());
    }
    SWATH_TRY(auto scenes, octree_scenes(figures, effort));
    OctreeBench bench{figures, effort, std::move(scenes)};
    for (Status (*const part)(OctreeBench&) : {bench_octree_builds, bench_octree_rays, bench_octree_scaling})
        SWATH_TRY_VOID(part(bench));
    return bench.draws() ? bench_octree_trade(bench) : Status{};
}

}  // namespace swath::bench
