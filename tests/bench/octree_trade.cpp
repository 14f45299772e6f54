#include <tbb/global_control.h>

#include <algorithm>

#include "common/base/csv.h"
#include "common/base/file.h"
#include "common/published/octree/sah_cost.h"
#include "common/published/octree/sah_kd_tree.h"
#include "tests/bench/octree_bench.h"
#include "tests/bench/plots.h"

namespace swath::bench {
namespace {

// The default settings but for one of them.
struct Variant {
    std::string setting;
    double value;
    SahSettings settings;

    std::string name() const { return fmt::format("{} {:g}", setting, value); }
};

constexpr const char* kThreshold = "kd_triangles";

std::vector<Variant> variants(bool smoke) {
    std::vector<Variant> all;
    const auto add = [&](const std::string& setting, const std::vector<double>& values, auto set) {
        for (const double value : values) {
            SahSettings settings = kDefaultSah;
            set(settings, value);
            if (smoke && value != values.front() && settings != kDefaultSah) continue;
            all.push_back({setting, value, settings});
        }
    };
    add("max_bins", {8, 16, 32, 64, 128, 256},
        [](SahSettings& settings, double value) { settings.max_bins = static_cast<std::uint32_t>(value); });
    add("min_bins", {2, 4, 8, 16, 32},
        [](SahSettings& settings, double value) { settings.min_bins = static_cast<std::uint32_t>(value); });
    add("bin_ratio", {1, 2, 4, 6, 8, 16, 32},
        [](SahSettings& settings, double value) { settings.bin_ratio = static_cast<std::uint32_t>(value); });
    // 1 means never.
    add(kThreshold, {1, 16, 32, 64, 128, 256, 512, 1024, 2048}, [](SahSettings& settings, double value) {
        settings.kd_triangles = static_cast<std::uint32_t>(value);
    });
    add("least_gain", {0, 0.25, 0.5, 0.6, 0.7, 0.8, 0.9, 1},
        [](SahSettings& settings, double value) { settings.least_gain = static_cast<float>(value); });
    add("refine", {0, 1}, [](SahSettings& settings, double value) { settings.refine = value != 0; });
    add("traversal_cost", {1, 2, 3, 4, 6, 8, 16},
        [](SahSettings& settings, double value) { settings.traversal_cost = static_cast<float>(value); });
    return all;
}
constexpr const char* kDefault = "the default";
constexpr const char* kFast = "the fast setting";

// The results of a variant.
struct Traded {
    double build_ms;
    double more_cost;  // above the kd-tree's, in per cent
    double mrays;
    double duplication;
};

Result<std::vector<Traded>> trade(OctreeBench& bench, const OctreeScene& scene,
                                  const std::vector<Variant>& all) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, kBuildThreads);
    const auto cost = [](const SahTree& tree) {
        return sah_cost(tree, kDefaultSah.traversal_cost, kDefaultSah.intersection_cost);
    };
    SWATH_TRY(const auto kd_tree, build_sah_kd_tree(scene.triangles(), kDefaultSah));
    // One builder builds all in turn, so that none pays for memory that another has already.
    SahBuilder builder(kBuildThreads);
    std::vector<SahTree> trees;
    for (const Variant& variant : all) {
        SWATH_TRY(auto tree, builder.build(scene.triangles(), variant.settings));
        trees.push_back(std::move(tree));
    }
    Race builds("builds", scene.name);
    Race rays("rays", scene.name);
    Result<SahTree> built = fail("nothing built yet");
    for (std::size_t i = 0; i < all.size(); ++i) {
        builds.add_work(
            all[i].name(), [&] { built = fail("nothing built yet"); },
            [&, &settings = all[i].settings] { built = builder.build(scene.triangles(), settings); });
        rays.add_work(all[i].name(), {}, [&, &tree = trees[i]] {
            for (const RayView& view : scene.views)
                cast_ours(scene, tree, best_instruction_set(), view, 0, view.height, nullptr);
        });
    }
    builds.run(bench.repetitions(scene, 3), 1);
    rays.run(bench.repetitions(scene, 3), 1);
    std::vector<Traded> traded;
    for (std::size_t i = 0; i < all.size(); ++i)
        traded.push_back({ms(builds.us(all[i].name())), 100 * (cost(trees[i]) / cost(kd_tree) - 1),
                          static_cast<double>(scene.rays()) / rays.us(all[i].name()),
                          static_cast<double>(trees[i].triangles.size()) /
                              static_cast<double>(scene.set.mesh.triangle_count())});
    return traded;
}

// Draws a curve for each setting, and marks for the two settings that have names.
Status draw_trade(OctreeBench& bench, const OctreeScene& scene, const std::vector<Variant>& all,
                  const std::vector<Traded>& traded) {
    sim::Plot cost;
    cost.title =
        fmt::format("{}: build time against the tree's SAH cost, one setting varied at a time", scene.name);
    cost.x_label = fmt::format("ms to build, {} threads", kBuildThreads);
    cost.y_label = "SAH cost above the kd-tree's, %";
    sim::Plot rays = cost;
    rays.title = fmt::format("{}: build time against rays, one setting varied at a time", scene.name);
    rays.y_label = "million primary rays a second, one thread";
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (sim::Plot* plot : {&cost, &rays}) {
            if (plot->series.empty() || plot->series.back().name != all[i].setting) {
                const bool named = all[i].setting == kDefault || all[i].setting == kFast;
                plot->series.push_back({all[i].setting, {}, named ? sim::Style::kPoints : sim::Style::kLine});
            }
            plot->series.back().points.emplace_back(traded[i].build_ms,
                                                    plot == &cost ? traded[i].more_cost : traded[i].mrays);
        }
    }
    SWATH_TRY_VOID(draw_with_csv(cost, bench.effort.out / ("octree_trade_cost_" + scene.name)));
    return draw_with_csv(rays, bench.effort.out / ("octree_trade_rays_" + scene.name));
}

}  // namespace

Status bench_octree_trade(OctreeBench& bench) {
    std::vector<Variant> all = variants(bench.effort.smoke);
    all.push_back({kDefault, 0, kDefaultSah});
    all.push_back({kFast, 0, kFastSah});
    sim::Plot threshold;
    threshold.title = "Below how many triangles nodes become kd-trees";
    threshold.x_label = "kd_triangles (1: never)";
    threshold.y_label = "times the default's";
    threshold.log2_x = true;
    for (const int tic : {1, 4, 16, 64, 256, 1024}) threshold.x_tics.emplace_back(tic, std::to_string(tic));
    std::string csv = "scene,setting,value,build ms,SAH cost above the kd-tree's %,Mray/s,duplication\n";
    std::string head = fmt::format("\n{:26}", "Settings, one at a time");
    std::string units = fmt::format("\n  {:24}", "");
    std::vector<std::string> lines(all.size());
    std::size_t colour = 0;
    for (const OctreeScene& scene : bench.scenes) {
        if (!scene.has_bars) continue;
        SWATH_TRY(const auto traded, trade(bench, scene, all));
        const auto usual_at = std::ranges::find_if(all, [](const Variant& variant) {
            return variant.setting == kThreshold && variant.settings == kDefaultSah;
        });
        const Traded& usual = traded.at(static_cast<std::size_t>(usual_at - all.begin()));
        sim::Series builds{scene.name + ", build time", {}, sim::Style::kLine, colour};
        sim::Series rays{scene.name + ", time of rays", {}, sim::Style::kDashed, colour++};
        head += fmt::format("{:>28}", scene.name);
        units += fmt::format("{:>10}{:>9}{:>9}", "ms", "cost +%", "Mray/s");
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Traded& one = traded[i];
            csv += fmt::format("{},{},{:g},{:.4g},{:.4g},{:.4g},{:.4g}\n", csv_field(scene.name),
                               csv_field(all[i].setting), all[i].value, one.build_ms, one.more_cost,
                               one.mrays, one.duplication);
            lines[i] += fmt::format("{:>10.1f}{:>9.1f}{:>9.1f}", one.build_ms, one.more_cost, one.mrays);
            if (all[i].setting != kThreshold) continue;
            builds.points.emplace_back(all[i].value, one.build_ms / usual.build_ms);
            rays.points.emplace_back(all[i].value, usual.mrays / one.mrays);
        }
        threshold.series.push_back(std::move(builds));
        threshold.series.push_back(std::move(rays));
        SWATH_TRY_VOID(draw_trade(bench, scene, all, traded));
    }
    std::string text = head + units;
    for (std::size_t i = 0; i < all.size(); ++i)
        text += fmt::format("\n  {:24}{}", i + 2 < all.size() ? all[i].name() : all[i].setting, lines[i]);
    bench.figures.note(text);
    SWATH_TRY_VOID(write_file(bench.effort.out / "octree_trade.csv", csv));
    return draw_with_csv(threshold, bench.effort.out / "octree_threshold");
}

}  // namespace swath::bench
