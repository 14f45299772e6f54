#pragma once
#include <string>

#include "common/base/clock.h"
#include "common/base/thread_team.h"
#include "tests/bench/culling_scenes.h"
#include "tests/bench/figures.h"
#include "tests/bench/race.h"

// The parts of bench_culling(). Errors: ways to cull that do not agree, or a plot that cannot be drawn.
namespace swath::bench {

struct CullingBench {
    Figures& figures;
    const Effort& effort;
    const Clock& clock;
    ThreadTeam one{1, clock};
    ThreadTeam two{2, clock};

    int repetitions(int full) const { return effort.smoke ? 1 : full; }
    int height(int full) const { return effort.smoke ? full - 3 : full; }
    std::size_t count(std::size_t full) const { return effort.smoke ? full / 200 : full; }
};

// Figures same_nodes_*, a2ssb_2t, early_out_*.
Status bench_trees(CullingBench& bench);
// Figures objects_*, refit_1m_ms, cull_sort_1m.
Status bench_objects(CullingBench& bench);
// Figure sort_1m_vs_std.
Status bench_sorts(CullingBench& bench);
// Figure loaded_vs_1t.
Status bench_loaded(CullingBench& bench);

// Each draws pictures, with their numbers as CSV, into `bench.effort.out`: both papers leave these as future
// work.
Status draw_time_over_nodes(CullingBench& bench);
Status draw_idle_time(CullingBench& bench);
Status draw_walk(CullingBench& bench);
Status draw_time_over_resources(CullingBench& bench);

// The names of ours in tables and plots.
inline constexpr const char* kOurs = "ours";
inline constexpr const char* kOursTwo = "ours, 2 threads";

inline constexpr std::uint64_t kPoints = 8 * 256 * 64;  // shaders, textures, meshes

// Random (shader, texture, mesh) of each object, as keys of a space of `points` points.
std::vector<std::uint32_t> random_keys(std::size_t count, std::uint64_t points, unsigned seed);

}  // namespace swath::bench
