#include <tbb/global_control.h>

#include <algorithm>

#include "common/published/octree/sah_cost.h"
#include "common/published/octree/sah_kd_tree.h"
#include "tests/bench/octree_bench.h"
#include "tests/bench/plots.h"

namespace swath::bench {

OurBuild::OurBuild(const OctreeScene& scene, const SahSettings& settings, std::size_t threads, bool fresh)
    : triangles_(scene.triangles()),
      settings_(settings),
      threads_(threads),
      fresh_(fresh),
      builder_(std::make_unique<SahBuilder>(threads)) {}

void OurBuild::prepare() {
    tree_ = fail("nothing built yet");
    if (fresh_) builder_ = std::make_unique<SahBuilder>(threads_);
}

void OurBuild::build() { tree_ = builder_->build(triangles_, settings_); }

Result<SahTree> OurBuild::tree() {
    if (!tree_) build();
    return tree_;
}

EmbreeBuild::EmbreeBuild(const OctreeScene& scene, EmbreeDevice& device, EmbreeQuality quality, bool again)
    : scene_(scene), device_(device), quality_(quality), again_(again) {}

void EmbreeBuild::prepare() {
    if (again_ && built_) {
        built_->touch();
        return;
    }
    built_.reset();
    built_ = std::make_unique<EmbreeScene>(device_, scene_.set.mesh, quality_, again_);
}

namespace {

constexpr const char* kKdTree = "serial kd-tree";
constexpr const char* kFresh = "ours, a new builder each time";
constexpr const char* kLowAgain = "Embree low, same scene again";
constexpr const char* kMediumAgain = "Embree medium, same scene again";

struct Leaves {
    std::size_t count = 0;  // not counting empty ones
    double triangles = 0;   // in a leaf, on average
};
Leaves leaves_of(const SahTree& tree) {
    Leaves leaves;
    for (const SahNode& node : tree.nodes)
        if (node.is_leaf() && node.count() != 0) ++leaves.count;
    leaves.triangles = static_cast<double>(tree.triangles.size()) / static_cast<double>(leaves.count);
    return leaves;
}

double cost(const SahTree& tree) {
    return sah_cost(tree, kDefaultSah.traversal_cost, kDefaultSah.intersection_cost);
}

class BuildTable {
  public:
    BuildTable(const OctreeScene& scene, double kd_cost)
        : triangles_(scene.set.mesh.triangle_count()), kd_cost_(kd_cost) {
        text_ = fmt::format(
            "\nBuilding {}, {} triangles, {} threads (the kd-tree 1)\n  {:32}{:>9}{:>8}{:>8}"
            "{:>7}{:>9}{:>7}{:>7}{:>9}{:>9}",
            scene.name, triangles_, kBuildThreads, "", "ms", "Mtri/s", "MiB", "B/tri", "leaves", "tri/lf",
            "dupl.", "SAH cost", "/kd-tree");
    }
    void row(const std::string& name, double time_ms, std::size_t bytes) {
        const double count = static_cast<double>(triangles_);
        text_ +=
            fmt::format("\n  {:32}{:>9.1f}{:>8.2f}{:>8.1f}{:>7.1f}", name, time_ms, count / time_ms / 1e3,
                        static_cast<double>(bytes) / (1 << 20), static_cast<double>(bytes) / count);
    }
    void row(const std::string& name, double time_ms, const SahTree& tree) {
        row(name, time_ms, tree.bytes());
        const Leaves leaves = leaves_of(tree);
        text_ += fmt::format("{:>9}{:>7.2f}{:>7.2f}{:>9.1f}{:>9.3f}", leaves.count, leaves.triangles,
                             static_cast<double>(tree.triangles.size()) / static_cast<double>(triangles_),
                             cost(tree), cost(tree) / kd_cost_);
    }
    const std::string& text() const { return text_; }

  private:
    std::size_t triangles_;
    double kd_cost_;
    std::string text_;
};

Status bench_scene(OctreeBench& bench, const OctreeScene& scene, sim::Bars::Group& bars) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, kBuildThreads);
    EmbreeDevice device(kBuildThreads);
    OurBuild ours(scene, kDefaultSah, kBuildThreads);
    OurBuild fast(scene, kFastSah, kBuildThreads);
    OurBuild fresh(scene, kDefaultSah, kBuildThreads, true);
    EmbreeBuild low(scene, device, EmbreeQuality::kLow);
    EmbreeBuild medium(scene, device, EmbreeQuality::kMedium);
    EmbreeBuild high(scene, device, EmbreeQuality::kHigh);
    EmbreeBuild low_again(scene, device, EmbreeQuality::kLow, true);
    EmbreeBuild medium_again(scene, device, EmbreeQuality::kMedium, true);
    auto kd_tree = build_sah_kd_tree(scene.triangles(), kDefaultSah);
    if (!kd_tree) return tl::unexpected(kd_tree.error());
    SWATH_TRY(const auto our_tree, ours.tree());
    SWATH_TRY(const auto fast_tree, fast.tree());

    Race slow(scene.name, scene.name);
    slow.add_work(
        kKdTree, [&] { kd_tree = fail("nothing built yet"); },
        [&] { kd_tree = build_sah_kd_tree(scene.triangles(), kDefaultSah); });
    add_build(slow, kOursDefault, ours);
    add_build(slow, kEmbreeHigh, high);
    slow.run(bench.repetitions(scene, 5), 1);
    Race quick(scene.name, scene.name);
    add_build(quick, kOursDefault, ours);
    add_build(quick, kEmbreeMedium, medium);
    add_build(quick, kOursFast, fast);
    add_build(quick, kEmbreeLow, low);
    add_build(quick, kFresh, fresh);
    add_build(quick, kMediumAgain, medium_again);
    add_build(quick, kLowAgain, low_again);
    quick.run(bench.repetitions(scene, 9), bench.effort.smoke ? 1 : 2);

    // The bytes that Embree has allocated for a scene alone.
    const auto embree_bytes = [&](EmbreeQuality quality) {
        EmbreeDevice alone(kBuildThreads);
        EmbreeBuild build(scene, alone, quality);
        build.prepare();
        build.build();
        return build.bytes();
    };
    BuildTable table(scene, cost(*kd_tree));
    table.row(kKdTree, ms(slow.us(kKdTree)), *kd_tree);
    table.row(kOursDefault, ms(quick.us(kOursDefault)), our_tree);
    table.row(kFresh, ms(quick.us(kFresh)), our_tree.bytes());
    table.row(kOursFast, ms(quick.us(kOursFast)), fast_tree);
    table.row(kEmbreeHigh, ms(slow.us(kEmbreeHigh)), embree_bytes(EmbreeQuality::kHigh));
    table.row(kEmbreeMedium, ms(quick.us(kEmbreeMedium)), embree_bytes(EmbreeQuality::kMedium));
    table.row(kMediumAgain, ms(quick.us(kMediumAgain)), medium_again.bytes());
    table.row(kEmbreeLow, ms(quick.us(kEmbreeLow)), embree_bytes(EmbreeQuality::kLow));
    table.row(kLowAgain, ms(quick.us(kLowAgain)), low_again.bytes());
    bench.figures.note(table.text());

    const double count = static_cast<double>(scene.set.mesh.triangle_count());
    const double rates[] = {count / slow.us(kKdTree),        count / quick.us(kOursDefault),
                            count / quick.us(kOursFast),     count / slow.us(kEmbreeHigh),
                            count / quick.us(kEmbreeMedium), count / quick.us(kEmbreeLow)};
    for (std::size_t i = 0; i < std::size(rates); ++i) {
        sim::Bars::Bar bar{"", std::vector<double>(std::size(rates))};
        bar.values[i] = rates[i];
        bars.bars.push_back(std::move(bar));
    }
    if (!scene.has_bars) return {};
    bench.figures.add("build_vs_kdtree_" + scene.name, slow.ratios(kKdTree, kOursDefault), "x",
                      "at least 8: time of the serial SAH kd-tree / ours, 2 threads");
    bench.figures.add("sah_cost_vs_kdtree_" + scene.name, {cost(our_tree) / cost(*kd_tree)}, "x",
                      "at most 1.15: SAH cost, ours / the kd-tree's");
    bench.figures.add("build_vs_embree_medium_" + scene.name, quick.ratios(kOursDefault, kEmbreeMedium), "x",
                      "at most 2: time, ours / Embree medium, 2 threads each");
    bench.figures.add("build_fast_vs_embree_low_" + scene.name, quick.ratios(kOursFast, kEmbreeLow), "x",
                      "at most 1.5: time, ours with fast settings / Embree low, 2 threads each");
    return {};
}

}  // namespace

Status bench_octree_builds(OctreeBench& bench) {
    sim::Bars bars;
    bars.title = fmt::format("Building, {} threads (the kd-tree: 1)", kBuildThreads);
    bars.y_label = "million triangles a second";
    bars.segments = {kKdTree, kOursDefault, kOursFast, kEmbreeHigh, kEmbreeMedium, kEmbreeLow};
    for (const OctreeScene& scene : bench.scenes) {
        sim::Bars::Group group{scene.name, {}};
        SWATH_TRY_VOID(bench_scene(bench, scene, group));
        bars.groups.push_back(std::move(group));
    }
    return bench.draws() ? draw_with_csv(bars, bench.effort.out / "octree_builds") : Status{};
}

}  // namespace swath::bench
