#include "sim/run/side_by_side.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/check.h"

namespace swath::sim {
namespace {

constexpr std::string_view kWhichIsWhich =
    "\npaper mode: the servers alone, as the paper counts, to compare with its tables. "
    "full mode: client, network and\ndisplay at work too: the speedup to expect of a cluster with "
    "this hardware (swath-sim hardware lists others).\n";

// "-" if the algorithm has no such column.
std::string cell(std::span<const Row> rows, std::string_view name) {
    const auto found = std::ranges::find(rows, name, &Row::column);
    return found == rows.end() ? "-" : fmt::format("{:.2f}", found->value);
}

std::string heading(const Experiment& e) {
    const std::size_t frames = e.paths->size() * e.paths->front().size();
    return fmt::format("{}: {} polygons in {} objects, {}x{}, {}, {} frame{}\n", e.model_name,
                       e.model->scene.mesh.triangle_count(), e.model->scene.objects.size(), e.width, e.height,
                       e.hardware->name, frames, frames == 1 ? "" : "s");
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
            text += fmt::format("{:16}{:-^70} {:-^44}\n", "", " paper mode: server's phases, ms ",
                                " full mode: everything at work, ms ");
            text +=
                fmt::format("{:10}{:>6}{:>8}{:>8}{:>7}{:>7}{:>7}{:>8}{:>8}{:>8}{:>8}  {:>8}{:>8}{:>9} {}\n",
                            "algorithm", "N", "ideal", "overlap", "read", "write", "final", "imbal.", "total",
                            "display", "speedup", "frame", "speedup", "latency", "busiest");
        }
        const std::vector<Row> rows = table1_rows(e, outcome);
        text += fmt::format("{:10}{:>6}{:>8}{:>8}{:>7}{:>7}{:>7}{:>8}{:>8}{:>8}{:>8}", e.algorithm_name,
                            e.servers, cell(rows, "ideal_render"), cell(rows, "overlap_render"),
                            cell(rows, "pixel_read"), cell(rows, "pixel_write"), cell(rows, "final_read"),
                            cell(rows, "imbalance"), cell(rows, "server_total"), cell(rows, "display_write"),
                            cell(rows, "speedup"));
        if (!outcome.full.empty()) {
            const ResourceUse bottleneck = outcome.full.bottleneck();
            text += fmt::format("  {:>8.2f}{:>8.2f}{:>9.2f} {} ({:.0f} %)", outcome.full.frame_s() * 1e3,
                                outcome.full.speedup(), outcome.full.latency_s() * 1e3, bottleneck.resource,
                                bottleneck.share * 100);
        }
        text += '\n';
    }
    return text.append(kWhichIsWhich);
}

}  // namespace swath::sim
