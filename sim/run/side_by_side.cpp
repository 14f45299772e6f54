#include "sim/run/side_by_side.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/check.h"

namespace swath::sim {
namespace {

// 0 where the algorithm has no such column.
double column(std::span<const Row> rows, std::string_view name) {
    const auto found = std::ranges::find(rows, name, &Row::column);
    return found == rows.end() ? 0 : found->value;
}

std::string heading(const Experiment& e) {
    return fmt::format("{}: {} polygons in {} objects, {}x{}, {}, {} frames\n", e.model_name,
                       e.model->scene.mesh.triangle_count(), e.model->scene.objects.size(), e.width, e.height,
                       e.hardware->name, e.paths->size() * e.paths->front().size());
}

}  // namespace

std::string side_by_side(std::span<const Experiment> experiments, std::span<const Outcome> outcomes) {
    CHECK(experiments.size() == outcomes.size());
    std::string text;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
        const Experiment& e = experiments[i];
        const Outcome& outcome = outcomes[i];
        if (i == 0 || e.model_name != experiments[i - 1].model_name) {
            if (i > 0) text += '\n';
            text += heading(e);
            text += fmt::format("{:16}{:-^67} {:-^36}\n", "", " paper mode: server's phases, ms ",
                                " full mode: everything at work ");
            text +=
                fmt::format("{:10}{:>6}{:>8}{:>8}{:>6}{:>6}{:>6}{:>8}{:>8}{:>8}{:>8}  {:>8}{:>8}{:>9} {}\n",
                            "algorithm", "N", "ideal", "overlap", "read", "write", "final", "imbal.", "total",
                            "display", "speedup", "frame ms", "speedup", "latency", "busiest");
        }
        const std::vector<Row> rows = table1_rows(e, outcome);
        text +=
            fmt::format("{:10}{:>6}{:>8.1f}{:>8.1f}{:>6.1f}{:>6.1f}{:>6.1f}{:>8.1f}{:>8.1f}{:>8.1f}{:>8.2f}",
                        e.algorithm_name, e.servers, column(rows, "ideal_render"),
                        column(rows, "overlap_render"), column(rows, "pixel_read"),
                        column(rows, "pixel_write"), column(rows, "final_read"), column(rows, "imbalance"),
                        column(rows, "server_total"), column(rows, "display_write"), column(rows, "speedup"));
        if (!outcome.full.empty()) {
            const ResourceUse bottleneck = outcome.full.bottleneck();
            text += fmt::format("  {:>8.1f}{:>8.2f}{:>9.1f} {} ({:.0f} %)", outcome.full.frame_s() * 1e3,
                                outcome.full.speedup(), outcome.full.latency_s() * 1e3, bottleneck.resource,
                                bottleneck.share * 100);
        }
        text += '\n';
    }
    return text;
}

}  // namespace swath::sim
