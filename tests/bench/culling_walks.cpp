#include "tests/bench/culling_walks.h"

#include <algorithm>
#include <limits>

#include "tests/bench/figures.h"

namespace swath::bench {

void add_walk(Race& race, std::string name, std::shared_ptr<PublishedWalk> walk, const Frustum& frustum) {
    const auto report = std::make_shared<const WalkReport*>(nullptr);
    race.add(
        std::move(name), [walk, frustum, report] { *report = &walk->walk(frustum); },
        [report] {
            Race::Ids ids;
            for (const MemberReport& member : (*report)->members)
                ids.insert(ids.end(), member.leaves.begin(), member.leaves.end());
            return ids;
        });
}

int force_best_split_level(PublishedWalk& walk, const Frustum& frustum, int height) {
    int best = 0;
    double best_us = std::numeric_limits<double>::infinity();
    for (int level = 0; level < height; ++level) {
        walk.force_split_level(level);
        if (walk.walk(frustum).split_level != level) continue;  // above the start level
        std::vector<double> us;
        for (int i = 0; i < 9; ++i) us.push_back(time_us([&] { walk.walk(frustum); }));
        if (median(us) < best_us) {
            best_us = median(us);
            best = level;
        }
    }
    walk.force_split_level(best);
    return best;
}

}  // namespace swath::bench
