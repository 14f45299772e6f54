#include <cstdlib>

#include "tests/bench/figures.h"

namespace swath::bench {

// Runs real processes that keep no pictures. With LP_NUM_THREADS=0 every process draws with one thread, so
// that two servers have the two cores that one process with more threads would have. Runs alternate, and
// ratios are taken pair by pair.
Status bench_cluster(Figures& figures, const Effort& effort) {
    ::setenv("LP_NUM_THREADS", "0", 1);
    const auto render = [&](const std::vector<std::string>& how) {
        std::vector<std::string> command{client_program(),
                                         effort.model,
                                         "--quiet",
                                         "--size",
                                         "1280x960",
                                         "--frames",
                                         std::to_string(effort.frames)};
        command.insert(command.end(), how.begin(), how.end());
        return run_program(command);
    };
    std::vector<double> overhead;
    std::vector<double> speedup;
    std::vector<double> single_fps;
    for (int i = 0; i < effort.repetitions; ++i) {
        const Finished single = render({"--single"});
        const Finished one = render({"--local", "1"});
        const Finished two = render({"--local", "2"});
        for (const Finished* f : {&single, &one, &two})
            if (f->exit_code != 0) return fail("swath-client failed with exit code {}", f->exit_code);
        overhead.push_back(one.cpu_s / single.cpu_s);
        speedup.push_back(two.frames_per_s() / single.frames_per_s());
        single_fps.push_back(single.frames_per_s());
    }
    figures.add("overhead_local1_cpu", overhead, "ratio",
                "at most 1.10: CPU of --local 1 over --single, start-up included");
    figures.add("speedup_local2", speedup, "ratio",
                "at least 1.7 on two quiet cores: frames/s of --local 2 over --single");
    figures.add("single_fps", single_fps, "1/s", "the Dragon at 1280x960, one thread");
    return {};
}

}  // namespace swath::bench
