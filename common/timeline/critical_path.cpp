#include "common/timeline/critical_path.h"

#include <algorithm>
#include <tuple>

namespace swath {
namespace {

enum class Role { kClient, kServer, kDisplay, kOther };

Role role_of(std::string_view machine) {
    if (machine == "client") return Role::kClient;
    if (machine == "display") return Role::kDisplay;
    return is_server(machine) ? Role::kServer : Role::kOther;
}

// A span that can be part of the path.
struct Step {
    std::size_t machine = 0;
    Role role = Role::kOther;
    Span span;
    bool taken = false;
};

// All spans but waits for messages. A server's first span may be the wait for its drawing thread.
std::vector<Step> steps_of(const FrameTimeline& frame) {
    std::vector<Step> steps;
    for (std::size_t m = 0; m < frame.machines.size(); ++m) {
        const MachineTimeline& machine = frame.machines[m];
        const Role role = role_of(machine.machine);
        const auto first = std::ranges::min_element(machine.spans, {}, &Span::begin);
        for (const Span& span : machine.spans) {
            const bool waits_to_draw = role == Role::kServer && &span == &*first && span.end > span.begin;
            if (span.end < span.begin || (span.phase == Phase::kWait && !waits_to_draw)) continue;
            steps.push_back({m, role, span});
        }
    }
    return steps;
}

class Walk {
  public:
    Walk(std::vector<Step> steps, Nanoseconds clock_error)
        : steps_(std::move(steps)), clock_error_(clock_error) {
        std::ranges::stable_sort(steps_, {}, [](const Step& step) { return step.span.end; });
        coded_ =
            std::ranges::any_of(steps_, [](const Step& step) { return step.span.phase == Phase::kSwap; });
    }

    // The path from its last step to its first. It ends, because no step is taken twice.
    std::vector<Step> run() {
        std::vector<Step> path;
        for (Step* step = last(); step != nullptr; step = cause_of(*step)) {
            step->taken = true;
            path.push_back(*step);
        }
        return path;
    }

  private:
    Step* last() {
        Step* found = nullptr;
        const auto rank = [](const Step& step) {
            return std::tuple(step.role == Role::kDisplay, step.span.phase != Phase::kWait, step.span.end,
                              step.span.begin);
        };
        for (Step& step : steps_)
            if (found == nullptr || rank(step) >= rank(*found)) found = &step;
        return found != nullptr && found->span.phase != Phase::kWait ? found : nullptr;
    }

    // Whether `to` can have waited for a message that was sent in `from`.
    bool can_cause(const Step& from, const Step& to) const {
        const Phase phase = from.span.phase;
        if (from.role == Role::kClient) return to.role == Role::kServer || to.role == Role::kDisplay;
        if (from.role != Role::kServer) return false;
        if (to.role == Role::kDisplay) return phase == Phase::kSend || phase == Phase::kFinalRead;
        return to.role == Role::kServer && to.span.phase == Phase::kPixelWrite &&
               phase == (coded_ ? Phase::kSwap : Phase::kPixelRead);
    }

    Step* cause_of(const Step& effect) {
        const Nanoseconds begin = effect.span.begin;
        Step* best = nullptr;
        // The nearest end comes first, then the own machine, then the longer span.
        std::tuple<Nanoseconds, bool, Nanoseconds> best_rank;
        for (Step& step : steps_) {
            const bool own = step.machine == effect.machine;
            if (step.taken || step.span.begin > begin + (own ? Nanoseconds(0) : clock_error_)) continue;
            if (own ? step.span.end > begin : !can_cause(step, effect)) continue;
            const std::tuple rank(std::chrono::abs(begin - step.span.end), !own, step.span.begin);
            if (best != nullptr && rank >= best_rank) continue;
            best = &step;
            best_rank = rank;
        }
        return best;
    }

    std::vector<Step> steps_;  // by end
    Nanoseconds clock_error_;
    bool coded_ = false;  // a server codes swaths, so compositing is in host memory
};

}  // namespace

std::vector<CriticalSpan> critical_path(const FrameTimeline& frame, Nanoseconds clock_error) {
    std::vector<CriticalSpan> path;
    for (const Step& step : Walk(steps_of(frame), clock_error).run())
        path.push_back(
            {frame.machines[step.machine].machine, step.span.phase, step.span.begin, step.span.end});
    std::ranges::reverse(path);
    return path;
}

}  // namespace swath
