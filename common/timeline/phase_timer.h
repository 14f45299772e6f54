#pragma once
#include <vector>

#include "common/base/clock.h"
#include "common/timeline/timeline.h"

namespace swath {

// Records what a thread does for a frame as contiguous spans. Make it when the work begins: the time since
// the last of `spans` becomes a wait. Borrows the clock and the spans.
class PhaseTimer {
  public:
    PhaseTimer(const Clock& clock, std::vector<Span>& spans)
        : clock_(clock), spans_(spans), begin_(clock.now()), cpu_(clock.thread_cpu()) {
        if (!spans.empty() && begin_ > spans.back().end)
            spans.push_back({Phase::kWait, spans.back().end, begin_, Nanoseconds(0)});
    }

    // Ends a phase, which began when the one before ended or the timer was made.
    void end(Phase phase) {
        const Nanoseconds now = clock_.now();
        const Nanoseconds cpu = clock_.thread_cpu();
        spans_.push_back({phase, begin_, now, cpu - cpu_});
        begin_ = now;
        cpu_ = cpu;
    }

  private:
    const Clock& clock_;
    std::vector<Span>& spans_;
    Nanoseconds begin_;
    Nanoseconds cpu_;
};

}  // namespace swath
