#include <algorithm>
#include <thread>

#include "common/published/cull/published_walk.h"
#include "tests/bench/culling_bench.h"
#include "tests/bench/plots.h"

namespace swath::bench {
namespace {

constexpr std::size_t kProcessors = 4;  // as in the papers

struct Published {
    const char* name;
    PublishedAlgorithm algorithm;
};
constexpr Published kAlgorithms[] = {{"ADSB", PublishedAlgorithm::kAdsb},
                                     {"A2SSB", PublishedAlgorithm::kAlgo1}};

// Nodes that the others tested less than the busiest member, in all.
double idle_nodes(const WalkReport& report) {
    double most = 0;
    double sum = 0;
    for (const MemberReport& member : report.members) {
        most = std::max(most, static_cast<double>(member.nodes_tested));
        sum += static_cast<double>(member.nodes_tested);
    }
    return most * static_cast<double>(report.members.size()) - sum;
}

// The busiest member's share of the nodes over an equal share: 1 is balanced, the team's size means that one
// works alone.
double imbalance(const WalkReport& report) {
    double most = 0;
    double sum = 0;
    for (const MemberReport& member : report.members) {
        most = std::max(most, static_cast<double>(member.nodes_tested));
        sum += static_cast<double>(member.nodes_tested);
    }
    return sum == 0 ? 1 : most * static_cast<double>(report.members.size()) / sum;
}

}  // namespace

Status draw_idle_time(CullingBench& bench) {
    ThreadTeam team(kProcessors, bench.clock);
    sim::Plot times;
    times.title = fmt::format("Idle time over the split level, {} threads on {} cores", kProcessors,
                              std::thread::hardware_concurrency());
    times.x_label = "split level";
    times.y_label = "total idle time, us";
    sim::Plot counts = times;
    counts.title = "Idle nodes over the split level, 4 threads";
    counts.y_label = "nodes that the others test less than the busiest";
    const UniformOctree tree(8);
    for (const Published& published : kAlgorithms)
        for (const TreeScene& scene : {table_2_camera(), table_3_camera()}) {
            const std::string name = fmt::format("{}, {}", published.name, scene.name);
            sim::Series time{name, {}};
            sim::Series count{name, {}};
            const auto walk = make_published_walk(published.algorithm, tree, team);
            for (int level = 0; level <= tree.height(); ++level) {
                walk->force_split_level(level);
                std::vector<double> idle;
                const WalkReport* report = nullptr;
                for (int i = 0; i < bench.repetitions(51); ++i) {
                    report = &walk->walk(scene.frustum);
                    idle.push_back(std::chrono::duration<double, std::micro>(report->total_idle).count());
                }
                if (report->split_level != level) continue;  // the algorithm does not allow this level
                time.points.emplace_back(level, median(idle));
                count.points.emplace_back(level, idle_nodes(*report));
            }
            times.series.push_back(std::move(time));
            counts.series.push_back(std::move(count));
        }
    SWATH_TRY_VOID(draw_with_csv(times, bench.effort.out / "idle_time"));
    return draw_with_csv(counts, bench.effort.out / "idle_nodes");
}

Status draw_walk(CullingBench& bench) {
    ThreadTeam team(kProcessors, bench.clock);
    const int frames = bench.effort.smoke ? 10 : 80;
    sim::Plot levels;
    levels.title = "Split level along a walk that turns round half-way, 4 threads";
    levels.x_label = "frame";
    levels.y_label = "split level";
    sim::Plot balance = levels;
    balance.title = "Balance along a walk that turns round half-way, 4 threads";
    balance.y_label = "nodes of the busiest over equal shares";
    const UniformOctree tree(bench.height(7));
    for (const Published& published : kAlgorithms) {
        sim::Series level{published.name, {}};
        sim::Series shares{published.name, {}};
        const auto walk = make_published_walk(published.algorithm, tree, team);
        for (int frame = 0; frame < frames; ++frame) {
            const WalkReport& report = walk->walk(bench::walk(tree.height(), frame, frames).frustum);
            level.points.emplace_back(frame, report.split_level);
            shares.points.emplace_back(frame, imbalance(report));
        }
        levels.series.push_back(std::move(level));
        balance.series.push_back(std::move(shares));
    }
    SWATH_TRY_VOID(draw_with_csv(levels, bench.effort.out / "walk_split_level"));
    return draw_with_csv(balance, bench.effort.out / "walk_balance");
}

}  // namespace swath::bench
