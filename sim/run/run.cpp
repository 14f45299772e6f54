#include "sim/run/run.h"

#include <iostream>

#include "common/base/file.h"
#include "common/program/progress.h"
#include "common/timeline/export.h"
#include "sim/run/side_by_side.h"
#include "sim/scenario/scenario.h"

namespace swath::sim {
namespace {

constexpr auto kPatience = std::chrono::seconds(3);  // before progress is shown

Status save_timeline(const Experiment& e, const std::string& file) {
    const auto costs = simulate({e.model->scene.objects, e.paths->front(), e.width, e.height, e.algorithm,
                                 e.servers, e.frames_in_flight, *e.hardware, true});
    return write_file(file,
                      file.ends_with(".csv") ? to_csv(costs.timelines) : to_chrome_trace(costs.timelines));
}

}  // namespace

Status check(const RunOptions& options) {
    if (options.timeline.empty()) return {};
    if (!options.timeline.ends_with(".csv") && !options.timeline.ends_with(".json"))
        return fail("--timeline: '{}': the name must end in .csv or .json", options.timeline);
    const std::size_t rows = options.scenario.algorithms.size() * options.scenario.servers.size();
    if (rows > 1)
        return fail("--timeline: shows one algorithm with one number of servers, not {} of them", rows);
    return {};
}

Status run(const RunOptions& options, const Clock& clock) {
    SWATH_TRY(const auto scenario, Scenario::load(options.scenario));
    const std::vector<Experiment>& experiments = scenario.experiments();

    std::size_t frames = 0;
    for (const Experiment& e : experiments) frames += e.paths->size() * e.paths->front().size();
    Progress progress(frames, "frames", false, clock, kPatience);
    const std::vector<Outcome> outcomes = run_experiments(
        experiments, options.scenario.threads, [](std::size_t, const Outcome&) {}, [&] { progress.step(); });
    std::cout << side_by_side(experiments, outcomes);
    if (!options.csv.empty()) {
        std::vector<Row> rows;
        for (std::size_t i = 0; i < experiments.size(); ++i)
            std::ranges::move(all_rows(experiments[i], outcomes[i]), std::back_inserter(rows));
        SWATH_TRY_VOID(write_file(options.csv, to_csv(rows)));
        std::cout << "table: " << options.csv << '\n';
    }
    if (!options.timeline.empty()) {
        SWATH_TRY_VOID(save_timeline(experiments.front(), options.timeline));
        std::cout << "timeline: " << options.timeline
                  << (options.timeline.ends_with(".json")
                          ? " (open it in ui.perfetto.dev, or offline in a Chromium's chrome://tracing)\n"
                          : "\n");
    }
    return {};
}

}  // namespace swath::sim
