#include <algorithm>
#include <optional>

#include "common/cull/wide/flat_scan.h"
#include "common/cull/wide/wide_culler.h"
#include "common/cull/wide/wide_hierarchy.h"
#include "common/published/cull/object_octree.h"
#include "common/published/resource/cull_and_sort.h"
#include "common/published/resource/resource_array.h"
#include "tests/bench/culling_bench.h"
#include "tests/bench/culling_peers.h"
#include "tests/support/models.h"

namespace swath::bench {
namespace {

constexpr const char* kAlgo5 = "ALGO5 with objects";
constexpr const char* kBullet = "Bullet btDbvt";
constexpr const char* kFlat = "flat scan";

struct Structures {
    Structures(const BoxSet& set, CullingBench& bench, bool in_order)
        : octree(set.boxes),
          blocks(set.boxes),
          flat(blocks, bench.one),
          ours(set.boxes, bench.one),
          ours_two(set.boxes, bench.two) {
        if (in_order) bullet.emplace(set.boxes);
    }
    ObjectOctree octree;
    BoxBlocks blocks;
    FlatScan flat;
    WideCuller ours;
    WideCuller ours_two;
    std::optional<BulletTree> bullet;
};

// A million boxes about fill the last cache, so it takes a few frames until all are in it.
constexpr int kFrames = 5;

Result<Race> race_objects(const BoxSet& set, const ObjectScene& scene, Structures& in, int repetitions) {
    Race race(fmt::format("{} boxes, {}, {}", set.boxes.size(), set.name, scene.name), scene.name);
    race.add(kAlgo5, [&] { return in.octree.cull(scene.frustum); });
    if (in.bullet) {
        const auto last = std::make_shared<std::span<const std::uint32_t>>();
        race.add(
            kBullet, [&, last] { *last = in.bullet->cull(scene.frustum); },
            [&, last] { return settle_rounding(*last, set.boxes, scene.frustum); });
    }
    race.add(kFlat, [&] { return in.flat.cull(scene.frustum); });
    race.add(kOurs, [&] { return in.ours.cull(scene.frustum); });
    race.add(kOursTwo, [&] { return in.ours_two.cull(scene.frustum); });
    SWATH_TRY_VOID(race.check());
    race.run(repetitions, kFrames);
    return race;
}

std::string title_of(const BoxSet& set) {
    return fmt::format("{} boxes, {}, one thread unless said", set.boxes.size(), set.name);
}

// Keeps the samples of the worst scene, by their median.
class Worst {
  public:
    void offer(std::vector<double> samples, const std::string& scene, bool greater_is_better) {
        const bool worse = samples_.empty() || (greater_is_better ? median(samples) < median(samples_)
                                                                  : median(samples) > median(samples_));
        if (!worse) return;
        samples_ = std::move(samples);
        scene_ = scene;
    }
    const std::vector<double>& samples() const { return samples_; }
    const std::string& scene() const { return scene_; }

  private:
    std::vector<double> samples_;
    std::string scene_;
};

// Races culling and sorting in one step. The papers' way keeps lists by resource, each in the order of the
// octree.
Status race_cull_and_sort(CullingBench& bench, const BoxSet& set, Structures& in, Worst& worst) {
    const std::vector<std::uint32_t> keys = random_keys(set.boxes.size(), kPoints, 3);
    SWATH_TRY(auto literal, LiteralSort::make(keys, kPoints, bench.one));
    CullAndSort ours(set.boxes, keys, bench.one);
    std::vector<Race> races;
    for (const ObjectScene& scene : object_scenes(set.view_bounds)) {
        Race race(fmt::format("cull and sort {} boxes, {}, {}", set.boxes.size(), set.name, scene.name),
                  scene.name);
        const auto last = std::make_shared<std::span<const std::uint32_t>>();
        race.add(
            "ALGO5, literal R and M", [&] { *last = literal.sort(in.octree.cull(scene.frustum)); },
            [&] {
                Race::Ids ids(last->begin(), last->end());
                // They are sorted by key already; if not, this must not hide it.
                const auto by_key = [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; };
                if (std::ranges::is_sorted(ids, by_key))
                    std::ranges::sort(ids, [&](std::uint32_t a, std::uint32_t b) {
                        return std::pair(keys[a], a) < std::pair(keys[b], b);
                    });
                return ids;
            });
        race.add(kOurs, [&] { return ours.cull(scene.frustum); });
        SWATH_TRY_VOID(race.check(Race::Order::kSame));
        race.run(bench.repetitions(9));
        worst.offer(race.ratios("ALGO5, literal R and M", kOurs), fmt::format("{}, {}", set.name, scene.name),
                    true);
        races.push_back(std::move(race));
    }
    bench.figures.note(
        table(fmt::format("{} boxes, {}, culled and sorted, one thread", set.boxes.size(), set.name), races));
    return {};
}

Result<std::vector<BoxSet>> million(CullingBench& bench) {
    const std::size_t count = bench.count(1'000'000);
    std::vector<BoxSet> sets{random_boxes(count, 1), clustered_boxes(count, 2)};
    if (const auto room = test::shared_model("conference.ply")) {
        SWATH_TRY(auto real, triangle_boxes(room->string(), count));
        sets.push_back(std::move(real));
        bench.figures.note(
            "real: the Conference's 331,179 triangles, as many copies side by side as it takes");
    } else {
        bench.figures.note("real positions left out: no conference.ply in ../shared/models");
    }
    sets.push_back(random_boxes_in_random_order(count, 1));
    return sets;
}

// Milliseconds to refit boxes that move to and fro.
std::vector<double> refit_times(CullingBench& bench, const BoxSet& set) {
    std::vector<Box> moved = set.boxes;
    for (Box& box : moved) {
        box.min += 1.0f;
        box.max += 1.0f;
    }
    WideHierarchy hierarchy(set.boxes, bench.one);
    std::vector<double> times;
    for (int i = 0; i < bench.repetitions(16); ++i) {
        const Nanoseconds begin = bench.clock.now();
        hierarchy.refit(i % 2 == 0 ? moved : set.boxes);
        times.push_back(std::chrono::duration<double, std::milli>(bench.clock.now() - begin).count());
    }
    return times;
}

Status bench_million(CullingBench& bench) {
    Worst against_flat;
    Worst cull_sort;
    SWATH_TRY(const auto sets, million(bench));
    for (const BoxSet& set : sets) {
        const bool in_order = set.name != "random order";
        Structures structures(set, bench, in_order);
        std::vector<Race> races;
        for (const ObjectScene& scene : object_scenes(set.view_bounds)) {
            SWATH_TRY(const auto race, race_objects(set, scene, structures, bench.repetitions(11)));
            races.push_back(race);
            against_flat.offer(race.ratios(kOurs, kFlat), fmt::format("{}, {}", set.name, scene.name), false);
            if (set.name != "random") continue;
            if (scene.name == "c60") {
                bench.figures.add("objects_1m_c60_vs_algo5", race.ratios(kAlgo5, kOurs), "x",
                                  "at least 15: a million boxes at random, one thread");
                bench.figures.add("objects_1m_c60_vs_bullet", race.ratios(kBullet, kOurs), "x",
                                  "at least 50");
            } else if (scene.name == "k30") {
                bench.figures.add("objects_1m_k30_vs_bullet", race.ratios(kBullet, kOurs), "x",
                                  "at least 50");
            }
        }
        bench.figures.note(table(title_of(set), races));
        if (set.name == "random")
            bench.figures.add("refit_1m_ms", refit_times(bench, set), "ms",
                              "at most 10: a million boxes have moved, one thread");
        if (!in_order) continue;
        SWATH_TRY_VOID(race_cull_and_sort(bench, set, structures, cull_sort));
    }
    bench.figures.add(
        "objects_1m_worst_vs_flat", against_flat.samples(), "x",
        fmt::format("at most 1.1: ours / flat scan, the worst scene ({})", against_flat.scene()));
    bench.figures.add(
        "cull_sort_1m", cull_sort.samples(), "x",
        fmt::format("at least 7: ALGO5 and literal R and M / ours, the worst scene ({})", cull_sort.scene()));
    return {};
}

Status bench_ten_million(CullingBench& bench) {
    const BoxSet set = random_boxes(bench.count(10'000'000), 4);
    Structures structures(set, bench, true);
    std::vector<Race> races;
    for (const ObjectScene& scene : object_scenes(set.view_bounds)) {
        SWATH_TRY(const auto race, race_objects(set, scene, structures, bench.repetitions(7)));
        races.push_back(race);
        if (scene.name != "c60") continue;
        bench.figures.add("objects_10m_c60_vs_algo5", race.ratios(kAlgo5, kOurs), "x",
                          "at least 10: ten million boxes at random, one thread");
        bench.figures.add("objects_10m_c60_vs_bullet", race.ratios(kBullet, kOurs), "x", "at least 35");
    }
    bench.figures.note(table(title_of(set), races));
    return {};
}

}  // namespace

Status bench_objects(CullingBench& bench) {
    SWATH_TRY_VOID(bench_million(bench));
    return bench_ten_million(bench);
}

}  // namespace swath::bench
