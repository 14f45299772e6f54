#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <thread>

#include "client/partition/partitioner.h"
#include "sim/engine/event_queue.h"
#include "sim/experiment/experiment.h"
#include "sim/hardware/hardware.h"
#include "tests/bench/figures.h"

namespace swath::bench {
namespace {

using Time = std::chrono::steady_clock::time_point;

double seconds_since(Time begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// All rows of Table 1 with one model for all three, in both modes, on all cores.
Status bench_table1(Figures& figures, const Effort& effort, bool smoke) {
    SWATH_TRY(const auto model, sim::load_study_model("model", effort.model, {4, 0}));
    SWATH_TRY(const auto hardware, sim::find_hardware("paper-2000"));
    sim::PathSpec spec;
    spec.frames = smoke ? 2 : 50;
    spec.zoom = 1.06;
    spec.seeds = smoke ? 1 : 5;
    SWATH_TRY(const auto paths, sim::make_paths(spec, model.scene.bounds, 1280, 960));
    std::vector<sim::Experiment> rows;
    for (const char* name : {"hand", "dragon", "buddha"}) {
        for (const Algorithm algorithm : {Algorithm::kHybrid, Algorithm::kMahd, Algorithm::kSortLast}) {
            for (const std::size_t servers : {8u, 16u, 32u, 64u}) {
                sim::Experiment row;
                row.model = &model;
                row.paths = &paths;
                row.hardware = &hardware;
                row.algorithm = algorithm;
                row.servers = servers;
                row.algorithm_name = name_of(algorithm);
                row.model_name = name;
                rows.push_back(row);
            }
        }
    }
    const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<double> both;
    std::vector<double> paper;
    for (int i = 0; i < effort.repetitions; ++i) {
        for (const bool full : {true, false}) {
            for (sim::Experiment& row : rows) row.full = full;
            const Time begin = std::chrono::steady_clock::now();
            run_experiments(rows, threads, [](std::size_t, const sim::Outcome&) {});
            (full ? both : paper).push_back(seconds_since(begin));
        }
    }
    figures.add("table1_s", both, "s", "below 60 on 2 cores: 36 rows of 250 frames, both modes");
    figures.add("table1_paper_mode_s", paper, "s", "the same without full mode");
    return {};
}

// Every event adds its successor, up to a millisecond later; 1,000 are waiting.
double events_per_s(std::uint64_t count) {
    sim::EventQueue events;
    std::minstd_rand random(1);
    std::uint64_t left = count;
    std::function<void()> next = [&] {
        if (left == 0) return;
        --left;
        events.after(Nanoseconds(random() % 1'000'000), [&next] { next(); });
    };
    const Time begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 1000; ++i) next();
    events.run();
    return static_cast<double>(events.executed()) / seconds_since(begin);
}

// Boxes evenly over a sphere, each as large as its share of it, in turns around the axis.
std::vector<Object> shell(std::size_t count) {
    std::vector<Object> objects(count);
    const float half = 1.0f / std::sqrt(static_cast<float>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double radius = std::sqrt(1 - z * z);
        const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
        const glm::vec3 centre(radius * std::cos(turn), z, radius * std::sin(turn));
        objects[i].triangle_count = 100 + static_cast<std::uint32_t>(i % 7) * 50;
        objects[i].box.extend(centre - half);
        objects[i].box.extend(centre + half);
    }
    return objects;
}

// The time of the slowest algorithm, without the projection of boxes. Sort-last's groups, which last, are
// made before.
void bench_partition(Figures& figures, std::size_t count, std::size_t servers, const std::string& bar,
                     int repetitions) {
    const std::vector<Object> objects = shell(count);
    Camera camera;
    camera.eye = {2.1f, 1.2f, 6.0f};
    camera.fov_y = 0.3f;
    camera.near = 1;
    camera.far = 10;
    const View view = make_view(camera, 1280, 960);
    std::vector<double> transform_ms;
    std::vector<ProjectedObject> projected;
    for (int i = 0; i < repetitions; ++i) {
        const Time begin = std::chrono::steady_clock::now();
        projected = project(objects, view);
        transform_ms.push_back(seconds_since(begin) * 1e3);
    }
    const std::string size = std::to_string(count) + "x" + std::to_string(servers);
    std::vector<double> slowest_ms;
    for (const Algorithm algorithm : kAll<Algorithm>) {
        const auto partitioner = make_partitioner(algorithm, objects);
        partitioner->partition({0, view, projected, servers});
        std::vector<double> ms;
        for (int i = 0; i < repetitions; ++i) {
            const Time begin = std::chrono::steady_clock::now();
            partitioner->partition({0, view, projected, servers});
            ms.push_back(seconds_since(begin) * 1e3);
        }
        figures.note("partition_" + size + " " + std::string(name_of(algorithm)) + ": " +
                     std::to_string(median(ms)) + " ms");
        if (slowest_ms.empty() || median(ms) > median(slowest_ms)) slowest_ms = ms;
    }
    figures.add("partition_" + size + "_ms", slowest_ms, "ms", bar);
    figures.add("transform_" + std::to_string(count) + "_ms", transform_ms, "ms", "counted apart");
}

}  // namespace

Status bench_simulator(Figures& figures, const Effort& effort) {
    const bool smoke = effort.repetitions <= 1;
    SWATH_TRY_VOID(bench_table1(figures, effort, smoke));
    std::vector<double> rates;
    for (int i = 0; i < effort.repetitions; ++i) rates.push_back(events_per_s(smoke ? 10'000 : 2'000'000));
    figures.add("events_per_s", rates, "1/s", "at least 1,000,000: the event queue, one core");
    const int repetitions = smoke ? 1 : 25;
    bench_partition(figures, 6'500, 64, "at most 1: the slowest algorithm", repetitions);
    bench_partition(figures, 100'000, 1'024, "at most 16: the slowest algorithm", repetitions);
    return {};
}

}  // namespace swath::bench
