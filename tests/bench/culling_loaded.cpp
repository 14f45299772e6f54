#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "common/cull/wide/wide_culler.h"
#include "tests/bench/culling_bench.h"

namespace swath::bench {
namespace {

// Keeps every core busy, with a child process each, as long as it lives.
class Load {
  public:
    Load() {
        const long cores = ::sysconf(_SC_NPROCESSORS_ONLN);
        for (long core = 0; core < cores; ++core) {
            const pid_t child = ::fork();
            if (child == 0) {
                ::prctl(PR_SET_PDEATHSIG, SIGKILL);
                cpu_set_t one;
                CPU_ZERO(&one);
                CPU_SET(static_cast<std::size_t>(core), &one);
                ::sched_setaffinity(0, sizeof one, &one);
                for (std::atomic<unsigned> turns{0};;) turns.fetch_add(1, std::memory_order_relaxed);
            }
            if (child > 0) children_.push_back(child);
        }
    }
    ~Load() {
        for (const pid_t child : children_) {
            ::kill(child, SIGKILL);
            ::waitpid(child, nullptr, 0);
        }
    }
    Load(const Load&) = delete;
    Load& operator=(const Load&) = delete;

  private:
    std::vector<pid_t> children_;
};

}  // namespace

// Compares mean times of many frames: another process takes slices of milliseconds, many frames long, which
// would not show in the best of a few.
Status bench_loaded(CullingBench& bench) {
    const BoxSet set = random_boxes(bench.count(1'000'000), 1);
    const Frustum frustum = object_scenes(set.view_bounds)[1].frustum;  // k30
    WideCuller one(set.boxes, bench.one);
    WideCuller two(set.boxes, bench.two);
    const std::string title = fmt::format("{} boxes, every core busy with another process", set.boxes.size());
    Race race(title, "k30");
    race.add("one thread", [&] { return one.cull(frustum); });
    race.add("two threads", [&] { return two.cull(frustum); });
    SWATH_TRY_VOID(race.check());
    const Load load;
    race.run(bench.repetitions(15), bench.effort.smoke ? 10 : 1000, Race::Frames::kMean);
    bench.figures.note(table(title, {&race, 1}));
    bench.figures.add("loaded_vs_1t", race.ratios("one thread", "two threads"), "x",
                      "at least 0.9: one thread / two, means of 1000 frames, all cores loaded");
    return {};
}

}  // namespace swath::bench
