#include <chrono>

#include "common/scene/model.h"
#include "common/scene/objects.h"
#include "tests/bench/figures.h"

namespace swath::bench {

// Times file to objects, as in a server; from the second time on the file is in the page cache.
Status bench_load(Figures& figures, const Effort& effort) {
    std::vector<double> total;
    std::vector<double> reading;
    for (int i = 0; i <= effort.repetitions; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        SWATH_TRY(auto mesh, load_model(effort.model));
        const auto read = std::chrono::steady_clock::now();
        const ObjectSet scene = build_objects(std::move(mesh), {});
        const auto end = std::chrono::steady_clock::now();
        if (i == 0) continue;
        reading.push_back(std::chrono::duration<double>(read - begin).count());
        total.push_back(std::chrono::duration<double>(end - begin).count());
    }
    figures.add("dragon_load_s", total, "s", "at most 1: file to objects");
    figures.add("dragon_read_s", reading, "s", "the part that reads, checks and computes normals");
    return {};
}

}  // namespace swath::bench
