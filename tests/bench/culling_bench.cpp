#include "tests/bench/culling_bench.h"

namespace swath::bench {

Status bench_culling(Figures& figures, const Effort& effort) {
    const SteadyClock clock;
    CullingBench bench{figures, effort, clock};
    if (!effort.out.empty()) {  // fails before minutes of measuring, not after
        std::error_code error;
        std::filesystem::create_directories(effort.out, error);
        if (error) return fail("{}: {}", effort.out.string(), error.message());
    }
    for (Status (*const part)(CullingBench&) : {bench_trees, bench_objects, bench_sorts, bench_loaded})
        SWATH_TRY_VOID(part(bench));
    if (effort.out.empty()) return {};
    for (Status (*const draw)(CullingBench&) :
         {draw_time_over_nodes, draw_idle_time, draw_walk, draw_time_over_resources})
        SWATH_TRY_VOID(draw(bench));
    return {};
}

}  // namespace swath::bench
