#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

#include "common/base/allocator.h"
#include "common/base/file.h"
#include "common/base/log.h"
#include "common/program/program.h"
#include "tests/bench/figures.h"

int main(int argc, char** argv) {
    using namespace swath;
    struct Benchmark {
        Status (*run)(bench::Figures&, const bench::Effort&);
        bool needs_model = true;
        bool draws = false;
    };
    const std::map<std::string, Benchmark> benchmarks{{"cluster", {bench::bench_cluster}},
                                                      {"compose", {bench::bench_compose, false}},
                                                      {"culling", {bench::bench_culling, false, true}},
                                                      {"culling-render", {bench::bench_culling_render}},
                                                      {"load", {bench::bench_load}},
                                                      {"octree", {bench::bench_octree, false, true}},
                                                      {"peers", {bench::bench_peers}},
                                                      {"raster", {bench::bench_raster}},
                                                      {"simulator", {bench::bench_simulator}},
                                                      {"swap", {bench::bench_swap}},
                                                      {"viewer", {bench::bench_viewer}}};
    std::string name;
    std::string json;
    std::string out;
    bool smoke = false;
    CLI::App app{
        "swath-bench: every figure that docs/benchmarks.md names, as ratios within one run where that is "
        "possible.\n"
        "  cluster    real processes: CPU of a cluster of one, and speed-up of two, against --single\n"
        "  compose    docker/compose.yaml from nothing to the first picture\n"
        "  culling    culling and sorting: ours beside both papers' and Bullet's\n"
        "  culling-render  what culling by leaf saves: triangles and time, from inside and sort-first\n"
        "  load       reading the Dragon and cutting it into objects\n"
        "  octree     SAH octrees and rays: ours beside the serial kd-tree and Embree\n"
        "  peers      ours beside IceT's and OpenSceneGraph's on the Dragon\n"
        "  raster     our rasteriser beside llvmpipe, on one thread\n"
        "  simulator  all of the paper's Table 1, events and partitions a second\n"
        "  swap       bytes a swapped pixel takes, and how fast pixels are merged\n"
        "  viewer     what somebody who looks costs, and what they get: pictures a second, lag\n"};
    app.add_option("NAME", name, "which")
        ->required()
        ->check(CLI::IsMember({"cluster", "compose", "culling", "culling-render", "load", "octree", "peers",
                               "raster", "simulator", "swap", "viewer"}));
    app.add_option("--json", json, "write {\"figures\": {name: number}} to this file");
    app.add_option("--out", out,
                   "culling, octree: also draw plots, into this folder, with their numbers as CSV");
    app.add_flag("--smoke", smoke,
                 "a small built-in model, once: to see that it runs; the figures mean nothing");
    if (const auto code = parse_options(app, argc, argv)) return *code;
    tune_allocator();
    start_log("swath-bench", LogLevel::kWarning);

    const Benchmark& benchmark = benchmarks.at(name);
    if (!out.empty() && !benchmark.draws)
        return usage_error(Error{fmt::format("--out: '{}' draws nothing", name)});
    auto effort = smoke ? bench::smoke_effort() : bench::full_effort(benchmark.needs_model);
    if (!effort) return run_error(effort.error());
    effort->out = out;
    bench::Figures figures;
    if (const auto status = benchmark.run(figures, *effort); !status) return run_error(status.error());
    std::cout << figures.to_text(name);
    if (!json.empty()) {
        const std::string text = figures.to_json();
        const auto status = write_file(json, text);
        if (!status) return run_error(status.error());
    }
    return kExitDone;
}
