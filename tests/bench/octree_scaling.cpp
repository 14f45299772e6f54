#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "common/base/thread_team.h"
#include "tests/bench/octree_bench.h"
#include "tests/bench/plots.h"

namespace swath::bench {
namespace {

// 1, 2, 4 and so on, and the number of cores.
std::vector<std::size_t> thread_counts() {
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::size_t> counts;
    for (std::size_t count = 1; count < cores; count *= 2) counts.push_back(count);
    counts.push_back(cores);
    return counts;
}

// A measurement that is repeated by number of threads.
struct Job {
    std::string name;
    std::size_t colour;
    sim::Style style;
};
const Job kJobs[] = {{"build, ours default", 0, sim::Style::kLine},
                     {"build, ours fast", 1, sim::Style::kLine},
                     {"build, Embree medium", 0, sim::Style::kDashed},
                     {"build, Embree low", 1, sim::Style::kDashed},
                     {"rays, ours", 2, sim::Style::kLine},
                     {"rays, Embree medium", 2, sim::Style::kDashed}};

std::string entrant(const Job& job, std::size_t threads) { return fmt::format("{}, {}", job.name, threads); }

// Everything to run the jobs with `count` threads.
struct Entrants {
    Entrants(const OctreeScene& scene, std::size_t count, const Clock& clock)
        : threads(count),
          device(count),
          team(count, clock),
          ours(scene, kDefaultSah, count),
          fast(scene, kFastSah, count),
          medium(scene, device, EmbreeQuality::kMedium),
          low(scene, device, EmbreeQuality::kLow) {}

    // Limits TBB to the same number of threads.
    template <class Build>
    void add_build(Race& race, const Job& job, Build& build) {
        race.add_work(
            entrant(job, threads), [&build] { build.prepare(); },
            [this, &build] {
                const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
                build.build();
            });
    }
    // A free thread takes the next band of the view.
    template <class Cast>
    void add_rays(Race& race, const Job& job, const OctreeScene& scene, Cast cast) {
        race.add_work(entrant(job, threads), {}, [this, &scene, cast] {
            constexpr int kBand = 4 * kTile;
            for (const RayView& view : scene.views) {
                std::atomic<int> next{0};
                team.run([&](std::size_t) {
                    for (int row = next.fetch_add(kBand); row < view.height; row = next.fetch_add(kBand))
                        cast(view, row, std::min(row + kBand, view.height));
                });
            }
        });
    }

    std::size_t threads;
    EmbreeDevice device;
    ThreadTeam team;
    OurBuild ours;
    OurBuild fast;
    EmbreeBuild medium;
    EmbreeBuild low;
};

Result<Race> race_threads(OctreeBench& bench, const OctreeScene& scene) {
    const SteadyClock clock;
    SWATH_TRY(const auto tree, OurBuild(scene, kDefaultSah, kBuildThreads).tree());
    EmbreeDevice device(kBuildThreads);
    EmbreeScene hierarchy(device, scene.set.mesh, EmbreeQuality::kMedium);
    hierarchy.commit();
    std::vector<std::unique_ptr<Entrants>> entrants;
    Race race("scaling", scene.name);
    for (const std::size_t count : thread_counts())
        entrants.push_back(std::make_unique<Entrants>(scene, count, clock));
    // Compared runners follow each other.
    for (const auto& each : entrants) each->add_build(race, kJobs[0], each->ours);
    for (const auto& each : entrants) each->add_build(race, kJobs[1], each->fast);
    for (const auto& each : entrants) each->add_build(race, kJobs[2], each->medium);
    for (const auto& each : entrants) each->add_build(race, kJobs[3], each->low);
    for (const auto& each : entrants)
        each->add_rays(race, kJobs[4], scene, [&](const RayView& view, int first, int last) {
            cast_ours(scene, tree, best_instruction_set(), view, first, last, nullptr);
        });
    for (const auto& each : entrants)
        each->add_rays(race, kJobs[5], scene, [&](const RayView& view, int first, int last) {
            hierarchy.cast(view, first, last, nullptr);
        });
    race.run(bench.repetitions(scene, 5), 1);
    return race;
}

}  // namespace

Status bench_octree_scaling(OctreeBench& bench) {
    const std::vector<std::size_t> counts = thread_counts();
    for (const OctreeScene& scene : bench.scenes) {
        if (!scene.has_bars) continue;
        SWATH_TRY(const auto race, race_threads(bench, scene));
        sim::Plot plot;
        plot.title = fmt::format("Speed-up over threads, {}", scene.name);
        plot.x_label = "threads";
        plot.y_label = "times as fast as with one thread";
        std::string text = fmt::format("\nThreads, {}\n  {:24}", scene.name, "ms, times as fast as one");
        for (const std::size_t count : counts) text += fmt::format("{:>11} {:>6}", count, "");
        for (const Job& job : kJobs) {
            sim::Series series{job.name, {}, job.style, job.colour};
            text += fmt::format("\n  {:24}", job.name);
            for (const std::size_t count : counts) {
                const double speed_up = median(race.ratios(entrant(job, 1), entrant(job, count)));
                series.points.emplace_back(count, speed_up);
                text += fmt::format("{:>11.1f} {:>6.2f}", ms(race.us(entrant(job, count))), speed_up);
            }
            plot.series.push_back(std::move(series));
        }
        bench.figures.note(text);
        if (!bench.draws()) continue;
        plot.series.push_back(
            {"ideal",
             {{1.0, 1.0}, {static_cast<double>(counts.back()), static_cast<double>(counts.back())}},
             sim::Style::kReference});
        SWATH_TRY_VOID(draw_with_csv(plot, bench.effort.out / ("octree_threads_" + scene.name)));
    }
    return {};
}

}  // namespace swath::bench
