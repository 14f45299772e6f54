#include "sim/experiment/experiment.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "common/base/check.h"

namespace swath::sim {
namespace {

Outcome run_path(const Experiment& experiment, const std::vector<Camera>& cameras,
                 const std::function<void()>& on_frame) {
    Outcome outcome;
    const std::span<const Object> model = experiment.model->scene.objects;
    const auto partitioner = make_partitioner(experiment.algorithm, model);
    for (FrameNumber frame = 0; frame < cameras.size(); ++frame) {
        View view = make_view(cameras[frame], experiment.width, experiment.height);
        view.pose = path_pose(frame);
        const auto objects = project(model, view, Accounting::kPaper);
        const FramePlan plan = partitioner->partition({frame, view, objects, experiment.servers});
        outcome.paper.add(paper_frame(plan, objects, experiment.algorithm, *experiment.hardware));
    }
    if (experiment.full) {
        ClusterScenario scenario{model,
                                 cameras,
                                 experiment.width,
                                 experiment.height,
                                 experiment.algorithm,
                                 experiment.servers,
                                 experiment.frames_in_flight,
                                 *experiment.hardware,
                                 false,
                                 on_frame};
        outcome.full.add(simulate(scenario));
    }
    return outcome;
}

std::string column_of(std::string resource) {
    std::replace(resource.begin(), resource.end(), ' ', '_');
    return "busy_" + resource;
}

}  // namespace

void FullMeans::add(const ClusterRunCosts& run) {
    FullMeans one;
    one.runs_ = 1;
    one.frame_s_ = run.frame_s;
    one.latency_s_ = run.latency_s;
    one.single_s_ = run.single_s;
    one.use_ = run.use;
    add(one);
}

void FullMeans::add(const FullMeans& other) {
    if (other.empty()) return;
    runs_ += other.runs_;
    frame_s_ += other.frame_s_;
    latency_s_ += other.latency_s_;
    single_s_ += other.single_s_;
    if (use_.empty()) {
        use_ = other.use_;
        return;
    }
    CHECK(use_.size() == other.use_.size());
    for (std::size_t i = 0; i < use_.size(); ++i) use_[i].share += other.use_[i].share;
}

std::vector<ResourceUse> FullMeans::use() const {
    std::vector<ResourceUse> means = use_;
    for (ResourceUse& use : means) use.share /= runs_;
    return means;
}

ResourceUse FullMeans::bottleneck() const { return busiest(use()); }

std::vector<Row> FullMeans::rows(const Row& of) const {
    std::vector<Row> rows;
    const auto add = [&](const std::string& column, double value) {
        rows.push_back({of.algorithm, of.model, of.servers, column, value});
    };
    add("full_frame", frame_s() * 1e3);
    add("full_latency", latency_s() * 1e3);
    add("full_speedup", speedup());
    for (const ResourceUse& use : this->use()) add(column_of(use.resource), use.share * 100);
    return rows;
}

std::vector<Row> table1_rows(const Experiment& experiment, const Outcome& outcome) {
    const double polygons = static_cast<double>(experiment.model->scene.mesh.triangle_count());
    const double ideal_s =
        polygons * experiment.hardware->server.polygon_s / static_cast<double>(experiment.servers);
    return outcome.paper.table1(experiment.label(), grouping_of(experiment.algorithm), ideal_s);
}

std::vector<Row> all_rows(const Experiment& experiment, const Outcome& outcome) {
    std::vector<Row> rows = table1_rows(experiment, outcome);
    std::ranges::move(outcome.paper.stages(experiment.label()), std::back_inserter(rows));
    if (!outcome.full.empty())
        std::ranges::move(outcome.full.rows(experiment.label()), std::back_inserter(rows));
    return rows;
}

std::vector<Outcome> run_experiments(std::span<const Experiment> experiments, std::size_t threads,
                                     const std::function<void(std::size_t, const Outcome&)>& on_done,
                                     const std::function<void()>& on_frame) {
    // One experiment on one path. Outcomes are added up in the order of the paths.
    struct Task {
        std::size_t experiment;
        std::size_t path;
    };
    std::vector<Task> tasks;
    std::vector<std::vector<Outcome>> parts(experiments.size());
    std::vector<std::size_t> missing(experiments.size());
    for (std::size_t e = 0; e < experiments.size(); ++e) {
        missing[e] = experiments[e].paths->size();
        CHECK(missing[e] > 0u);
        parts[e].resize(missing[e]);
        for (std::size_t p = 0; p < missing[e]; ++p) tasks.push_back({e, p});
    }
    std::vector<Outcome> outcomes(experiments.size());
    std::atomic<std::size_t> next{0};
    std::mutex mutex;  // guards missing, outcomes, failure, on_done and on_frame
    std::exception_ptr failure;
    std::function<void()> on_frame_locked;
    if (on_frame)
        on_frame_locked = [&] {
            const std::lock_guard lock(mutex);
            on_frame();
        };
    const auto work = [&] {
        for (std::size_t t = next++; t < tasks.size(); t = next++) {
            const auto [e, p] = tasks[t];
            try {
                parts[e][p] = run_path(experiments[e], (*experiments[e].paths)[p], on_frame_locked);
                const std::lock_guard lock(mutex);
                if (--missing[e] > 0) continue;
                for (const Outcome& part : parts[e]) {
                    outcomes[e].paper.add(part.paper);
                    outcomes[e].full.add(part.full);
                }
                on_done(e, outcomes[e]);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
                next = tasks.size();
            }
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t k = 1; k < std::min(threads, tasks.size()); ++k) others.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
    return outcomes;
}

}  // namespace swath::sim
