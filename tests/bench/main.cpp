#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

#include "common/base/allocator.h"
#include "common/base/file.h"
#include "common/program/program.h"
#include "tests/bench/figures.h"

int main(int argc, char** argv) {
    using namespace swath;
    const std::map<std::string, Status (*)(bench::Figures&, const bench::Effort&)> benchmarks{
        {"cluster", bench::bench_cluster},     {"culling-render", bench::bench_culling_render},
        {"load", bench::bench_load},           {"peers", bench::bench_peers},
        {"simulator", bench::bench_simulator}, {"swap", bench::bench_swap}};
    std::string name;
    std::string json;
    bool smoke = false;
    CLI::App app{
        "swath-bench: every figure that docs/benchmarks.md names, as ratios within one run where that is "
        "possible.\n"
        "  cluster    real processes: CPU of a cluster of one, and speed-up of two, against --single\n"
        "  culling-render  what culling by leaf saves: triangles and time, from inside and sort-first\n"
        "  load       reading the Dragon and cutting it into objects\n"
        "  peers      ours beside IceT's and OpenSceneGraph's on the Dragon\n"
        "  simulator  all of the paper's Table 1, events and partitions a second\n"
        "  swap       bytes a swapped pixel takes, and how fast pixels are merged\n"};
    app.add_option("NAME", name, "which")
        ->required()
        ->check(CLI::IsMember({"cluster", "culling-render", "load", "peers", "simulator", "swap"}));
    app.add_option("--json", json, "write {\"figures\": {name: number}} to this file");
    app.add_flag("--smoke", smoke,
                 "a small built-in model, once: to see that it runs; the figures mean nothing");
    if (const auto code = parse_options(app, argc, argv)) return *code;
    tune_allocator();
    spdlog::set_level(spdlog::level::warn);

    const auto effort = smoke ? bench::smoke_effort() : bench::full_effort();
    if (!effort) return run_error(effort.error());
    bench::Figures figures;
    if (const auto status = benchmarks.at(name)(figures, *effort); !status) return run_error(status.error());
    std::cout << figures.to_text(name);
    if (!json.empty()) {
        const std::string text = figures.to_json();
        const auto status = write_file(json, text);
        if (!status) return run_error(status.error());
    }
    return kExitDone;
}
