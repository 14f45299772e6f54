#include "common/published/cull/wide_octree.h"
#include "tests/bench/culling_bench.h"
#include "tests/bench/culling_walks.h"
#include "tests/bench/plots.h"

namespace swath::bench {
namespace {

constexpr const char* kCanonical = "ALGO5";
constexpr const char* kInPlace = "ALGO4: in place";
constexpr const char* kInPlaceLanes = "ALGO4, planes in lanes";
constexpr const char* kTwoStep = "ALGO1: A2SSB, 2 threads";
constexpr const char* kTwoStepBest = "ALGO1, best split level";
constexpr const char* kTwoStepLanes = "ALGO1, planes in lanes";
constexpr const char* kTwoStepStored = "ALGO2: nodes read, 2 threads";
constexpr const char* kTwoStepBreadth = "ALGO3: breadth first, 2 thr.";
constexpr const char* kDelayed = "ADSB, 2 threads";
constexpr const char* kSame = "ours, every node";
constexpr const char* kSameTwo = "ours, every node, 2 threads";

// A race over one tree; the first runner is ALGO5.
class TreeRace {
  public:
    TreeRace(CullingBench& bench, const PointerOctree& tree, const TreeScene& scene, std::string title)
        : bench_(bench), tree_(tree), scene_(scene), race_(std::move(title), scene.name) {
        add(kCanonical, PublishedAlgorithm::kAlgo5, bench.one);
    }

    void add(std::string name, PublishedAlgorithm algorithm, ThreadTeam& team) {
        add_walk(race_, std::move(name), make_published_walk(algorithm, tree_, team), scene_.frustum);
    }
    void add_published() {
        add(kInPlace, PublishedAlgorithm::kAlgo4, bench_.one);
        add(kInPlaceLanes, PublishedAlgorithm::kAlgo4Lanes, bench_.one);
        add(kTwoStep, PublishedAlgorithm::kAlgo1, bench_.two);
        std::shared_ptr<PublishedWalk> best =
            make_published_walk(PublishedAlgorithm::kAlgo1, tree_, bench_.two);
        best_level_ = force_best_split_level(*best, scene_.frustum, scene_.height);
        add_walk(race_, kTwoStepBest, best, scene_.frustum);
        add(kTwoStepLanes, PublishedAlgorithm::kAlgo1Lanes, bench_.two);
        add(kTwoStepStored, PublishedAlgorithm::kAlgo2, bench_.two);
        add(kTwoStepBreadth, PublishedAlgorithm::kAlgo3, bench_.two);
        add(kDelayed, PublishedAlgorithm::kAdsb, bench_.two);
    }
    // These test every node that ALGO5 tests.
    void add_every_node() {
        add_ours(kSame, bench_.one, &WideOctree::cull_same_nodes);
        add_ours(kSameTwo, bench_.two, &WideOctree::cull_same_nodes);
    }
    // These test nothing below a node that is inside.
    void add_early_out() {
        add_ours(kOurs, bench_.one, &WideOctree::cull);
        add_ours(kOursTwo, bench_.two, &WideOctree::cull);
    }
    Result<Race> run(int repetitions) {
        SWATH_TRY_VOID(race_.check());
        race_.run(repetitions);
        return std::move(race_);
    }
    int best_level() const { return best_level_; }

  private:
    using Cull = std::span<const std::uint32_t> (WideOctree::*)(const Frustum&);
    void add_ours(std::string name, ThreadTeam& team, Cull cull) {
        const auto octree = std::make_shared<WideOctree>(tree_.shape(), team);
        race_.add(std::move(name),
                  [octree, cull, frustum = scene_.frustum] { return ((*octree).*cull)(frustum); });
    }

    CullingBench& bench_;
    const PointerOctree& tree_;
    const TreeScene& scene_;
    Race race_;
    int best_level_ = 0;
};

std::string title_of(const PointerOctree& tree, const TreeScene& scene) {
    return fmt::format("{} levels, {} nodes, {}", tree.shape().height() + 1, tree.shape().node_count(),
                       scene.name);
}

Status bench_whole_tree(CullingBench& bench) {
    const int height = bench.height(6);
    const PointerOctree tree(UniformOctree(height), AllocationOrder::kDepthFirst);
    const TreeScene scene = whole_tree(height);
    TreeRace contest(bench, tree, scene, title_of(tree, scene));
    contest.add_published();
    contest.add_every_node();
    SWATH_TRY(const auto race, contest.run(bench.repetitions(25)));
    bench.figures.note(table(
        fmt::format("{} levels, {} nodes, all tested", height + 1, tree.shape().node_count()), {&race, 1}));
    bench.figures.add("same_nodes_1t", race.ratios(kCanonical, kSame), "x",
                      "at least 7: ALGO5 / ours, the whole tree of 7 levels, every node tested");
    bench.figures.add("same_nodes_2t", race.ratios(kCanonical, kSameTwo), "x",
                      "at least 12: the same, ours with two threads");
    const bool adaptive = race.us(kTwoStep) < race.us(kTwoStepBest);
    const std::string level = adaptive ? "adaptive" : fmt::format("level {}", contest.best_level());
    bench.figures.add("a2ssb_lanes_2t", race.ratios(kCanonical, kTwoStepLanes), "x",
                      "no bar: the same with all planes tested at once, which ALGO5 does not");
    bench.figures.add("a2ssb_2t", race.ratios(kCanonical, adaptive ? kTwoStep : kTwoStepBest), "x",
                      fmt::format("at least 2.5 when quiet: ALGO5 / A2SSB with two threads, {}", level));
    return {};
}

// Shows that ALGO5's speed depends on where its nodes lie.
Status bench_allocation(CullingBench& bench) {
    const int height = bench.height(6);
    const TreeScene scene = whole_tree(height);
    const std::pair<const char*, AllocationOrder> orders[] = {
        {"depth first", AllocationOrder::kDepthFirst},
        {"level by level", AllocationOrder::kBreadthFirst},
        {"at random", AllocationOrder::kRandom}};
    std::vector<std::unique_ptr<PointerOctree>> trees;
    Race race("order of allocation", scene.name);
    for (const auto& [name, order] : orders) {
        trees.push_back(std::make_unique<PointerOctree>(UniformOctree(height), order));
        add_walk(race, name, make_published_walk(PublishedAlgorithm::kAlgo5, *trees.back(), bench.one),
                 scene.frustum);
    }
    SWATH_TRY_VOID(race.check());
    race.run(bench.repetitions(7));
    bench.figures.note(
        table(fmt::format("ALGO5 by the order of allocation, {} levels", height + 1), {&race, 1}));
    return {};
}

Status bench_early_out(CullingBench& bench) {
    const int height = bench.height(7);
    const PointerOctree tree(UniformOctree(height), AllocationOrder::kDepthFirst);
    std::vector<Race> races;
    struct Bar {
        TreeScene scene;
        const char* figure;
        int least;
    };
    for (const auto& [scene, figure, least] : {Bar{tree_from_centre(height, 30), "early_out_c30", 15},
                                               Bar{tree_from_centre(height, 60), "early_out_c60", 30},
                                               Bar{tree_from_corner(height, 30), "early_out_k30", 40},
                                               Bar{tree_from_corner(height, 60), "early_out_k60", 60}}) {
        TreeRace contest(bench, tree, scene, title_of(tree, scene));
        contest.add_published();
        contest.add_every_node();
        contest.add_early_out();
        SWATH_TRY(const auto race, contest.run(bench.repetitions(11)));
        bench.figures.add(
            figure, race.ratios(kCanonical, kOurs), "x",
            fmt::format("at least {}: ALGO5 / ours, 8 levels, one thread, {}", least, scene.name));
        races.push_back(race);
    }
    bench.figures.note(table(
        fmt::format("{} levels, {} nodes, one thread unless said", height + 1, tree.shape().node_count()),
        races));
    return {};
}

}  // namespace

Status bench_trees(CullingBench& bench) {
    SWATH_TRY_VOID(bench_whole_tree(bench));
    SWATH_TRY_VOID(bench_allocation(bench));
    return bench_early_out(bench);
}

Status draw_time_over_nodes(CullingBench& bench) {
    struct Picture {
        const char* stem;
        const char* title;
        TreeScene (*scene)(int height);
        bool every_node;
    };
    for (const auto& [stem, title, scene_of, every_node] :
         {Picture{"time_over_nodes_whole", "The whole tree: every node is tested", whole_tree, true},
          Picture{"time_over_nodes_c60", "From the centre, 60 degrees",
                  [](int height) { return tree_from_centre(height, 60); }, false}}) {
        sim::Plot plot;
        plot.title = title;
        plot.x_label = "nodes of the tree";
        plot.y_label = "ms a frame";
        plot.log2_x = plot.log10_y = true;
        struct Curve {
            const char* name;
            std::size_t colour;
            sim::Style style = sim::Style::kLine;  // dashed: two threads
        };
        std::vector<Curve> curves{{kCanonical, 0},
                                  {kInPlace, 1},
                                  {kTwoStep, 1, sim::Style::kDashed},
                                  {kDelayed, 3, sim::Style::kDashed},
                                  {kSame, 4},
                                  {kSameTwo, 4, sim::Style::kDashed}};
        if (!every_node) curves.insert(curves.end(), {{kOurs, 2}, {kOursTwo, 2, sim::Style::kDashed}});
        for (const Curve& curve : curves) plot.series.push_back({curve.name, {}, curve.style, curve.colour});
        for (int height = 3; height <= (bench.effort.smoke ? 4 : 8); ++height) {
            const PointerOctree tree(UniformOctree(height), AllocationOrder::kDepthFirst);
            const TreeScene scene = scene_of(height);
            TreeRace contest(bench, tree, scene, title_of(tree, scene));
            contest.add_published();
            contest.add_every_node();
            if (!every_node) contest.add_early_out();
            SWATH_TRY(const auto race, contest.run(bench.repetitions(5)));
            const std::uint64_t nodes = tree.shape().node_count();
            plot.x_tics.emplace_back(nodes, short_number(nodes));
            for (sim::Series& series : plot.series)
                series.points.emplace_back(nodes, race.us(series.name) / 1000);
        }
        SWATH_TRY_VOID(draw_with_csv(plot, bench.effort.out / stem));
    }
    return {};
}

}  // namespace swath::bench
