#include <algorithm>
#include <random>

#include "common/published/resource/resource_array.h"
#include "common/published/resource/resource_sorter.h"
#include "tests/bench/culling_bench.h"
#include "tests/bench/plots.h"

namespace swath::bench {
namespace {

// About `visible` of `count` ids, ascending.
std::vector<std::uint32_t> some_of(std::size_t count, std::size_t visible, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> ids;
    for (std::size_t i = 0; i < count; ++i)
        if (random() % count < visible) ids.push_back(static_cast<std::uint32_t>(i));
    return ids;
}

// The obvious way: std::sort of key and id in 64 bits.
class StdSort {
  public:
    explicit StdSort(std::span<const std::uint32_t> keys) : keys_(keys) {}
    std::span<const std::uint32_t> sort(std::span<const std::uint32_t> visible) {
        packed_.clear();
        for (const std::uint32_t id : visible) packed_.push_back(std::uint64_t{keys_[id]} << 32 | id);
        std::sort(packed_.begin(), packed_.end());
        sorted_.clear();
        for (const std::uint64_t both : packed_) sorted_.push_back(static_cast<std::uint32_t>(both));
        return sorted_;
    }

  private:
    std::span<const std::uint32_t> keys_;
    std::vector<std::uint64_t> packed_;
    std::vector<std::uint32_t> sorted_;
};

// All ways to sort objects of the same keys, on one thread.
class Sorts {
  public:
    static Result<std::unique_ptr<Sorts>> make(std::vector<std::uint32_t> keys, std::uint64_t points,
                                               ThreadTeam& team) {
        auto sorts = std::unique_ptr<Sorts>(new Sorts(std::move(keys), points, team));
        SWATH_TRY(auto literal, LiteralSort::make(sorts->keys_, points, team));
        sorts->literal_ = std::make_unique<LiteralSort>(std::move(literal));
        return sorts;
    }
    Result<Race> race(const std::string& scene, std::span<const std::uint32_t> visible, int repetitions) {
        Race race("sorting, " + scene, scene);
        const auto add = [&](const char* name, auto& sort) {
            race.add(name, [&sort, visible] { return sort.sort(visible); });
        };
        add("std::sort", std_);
        add("literal R and M", *literal_);
        add("counting", counting_);
        add("radix", radix_);
        add("bitmap", bitmap_);
        add("chosen", chosen_);
        SWATH_TRY_VOID(race.check(Race::Order::kSame));
        race.run(repetitions);
        return race;
    }
    SortMethod method_for(std::size_t visible) const { return chosen_.method_for(visible); }

  private:
    Sorts(std::vector<std::uint32_t> keys, std::uint64_t points, ThreadTeam& team)
        : keys_(std::move(keys)),
          std_(keys_),
          counting_(keys_, points, team),
          radix_(keys_, points, team),
          chosen_(keys_, team),
          bitmap_(chosen_.order(), team) {}

    std::vector<std::uint32_t> keys_;
    StdSort std_;
    std::unique_ptr<LiteralSort> literal_;
    CountingSort counting_;
    RadixSort radix_;
    ResourceSorter chosen_;
    RankBitmap bitmap_;
};

}  // namespace

std::vector<std::uint32_t> random_keys(std::size_t count, std::uint64_t points, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> keys(count);
    for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(random() % points);
    return keys;
}

Status bench_sorts(CullingBench& bench) {
    const std::size_t count = bench.count(1'000'000);
    SWATH_TRY(const auto sorts, Sorts::make(random_keys(count, kPoints, 1), kPoints, bench.one));
    std::vector<double> least;
    std::string scene;
    std::vector<Race> races;
    for (const std::size_t per_mille : {1u, 9u, 90u, 330u, 990u}) {
        const auto visible = some_of(count, count * per_mille / 1000, 2);
        const SortMethod method = sorts->method_for(visible.size());
        SWATH_TRY(const auto race,
                  sorts->race(fmt::format("chosen: {}", name_of(method)), visible, bench.repetitions(9)));
        races.push_back(race);
        // With a thousand objects a frame's sorting does not matter.
        const auto ratios = race.ratios("std::sort", "chosen");
        if (per_mille >= 90 && (least.empty() || median(ratios) < median(least))) {
            least = ratios;
            scene = fmt::format("{} visible", visible.size());
        }
    }
    bench.figures.note(
        table(fmt::format("Sorting some of {} objects by {} points, one thread", count, kPoints), races));
    bench.figures.add(
        "sort_1m_vs_std", least, "x",
        fmt::format("at least 15: std::sort / ours, the worst of 90, 330, 990 of 1000 visible ({})", scene));
    return {};
}

Status draw_time_over_resources(CullingBench& bench) {
    const std::size_t count = bench.count(1'000'000);
    for (const auto& [share, per_mille] : {std::pair{"9 %", 90}, std::pair{"0.9 %", 9}}) {
        const auto visible = some_of(count, count * static_cast<std::size_t>(per_mille) / 1000, 2);
        sim::Plot plot;
        plot.title = fmt::format("Sorting {} visible of a million objects", share);
        plot.x_label = "points of the resource space";
        plot.y_label = "ms";
        plot.log2_x = plot.log10_y = true;
        for (const char* name : {"std::sort", "literal R and M", "counting", "radix", "bitmap", "chosen"})
            plot.series.push_back({name, {}});
        for (int bits = 4; bits <= (bench.effort.smoke ? 8 : 20); bits += 2) {
            const std::uint64_t points = std::uint64_t{1} << bits;
            plot.x_tics.emplace_back(points, short_number(points));
            SWATH_TRY(const auto sorts, Sorts::make(random_keys(count, points, 1), points, bench.one));
            SWATH_TRY(const auto race, sorts->race(short_number(points), visible, bench.repetitions(5)));
            for (sim::Series& series : plot.series)
                series.points.emplace_back(points, race.us(series.name) / 1000);
        }
        const auto stem = fmt::format("time_over_resources_{}", per_mille);
        SWATH_TRY_VOID(draw_with_csv(plot, bench.effort.out / stem));
    }
    return {};
}

}  // namespace swath::bench
