#pragma once
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <vector>

#include "client/cost/frame_work.h"
#include "common/base/check.h"
#include "common/base/result.h"
#include "common/timeline/timeline.h"
#include "server/swap/frame_swap.h"
#include "sim/engine/station.h"

namespace swath::sim {

inline Nanoseconds nanoseconds(double seconds) { return Nanoseconds(std::llround(seconds * 1e9)); }

// The actions of a decision object. An error blames a machine, and all of those are ours: a bug.
template <class T>
T decided(Result<T> decision) {
    if (!decision) throw CheckFailed(decision.error().message);
    return *std::move(decision);
}

// A server on modelled hardware: FrameSwap decides, its stations take the time. Belongs to one simulation.
class SimulatedServer {
  public:
    // The server calls these for everything that leaves it.
    struct Outside {
        std::function<void(FrameNumber, const SwathWork&)> send_swath;
        std::function<void(FrameNumber)> send_tile;
        std::function<void(FrameNumber)> report;  // its work for the frame is over
    };

    SimulatedServer(EventQueue& events, Compositing compositing, std::size_t frames_in_flight,
                    Outside outside);

    // `work` must live until the frame is reported.
    void on_task(FrameNumber frame, const ServerWork& work);
    void on_swath(FrameNumber frame, ServerId from, double merge_s);

    std::vector<Span> take_spans(FrameNumber frame);
    Nanoseconds draw_busy() const { return draw_.busy(); }
    Nanoseconds pixel_busy() const { return host_.busy(); }

  private:
    struct Frame {
        const ServerWork* work = nullptr;  // null until the task comes
        std::map<ServerId, double> merge_s;
        std::vector<Span> spans;
    };
    void perform(const FrameSwap::Actions& actions);
    void draw_next();
    void finish(FrameNumber frame);
    // Does a job for the frame, then `after`.
    void work_on(Station& station, FrameNumber frame, Phase phase, double duration_s,
                 std::function<void()> after);
    bool on_card() const { return compositing_ == Compositing::kGraphics; }
    Station& pixel_station() { return on_card() ? draw_ : host_; }

    Compositing compositing_;
    Outside outside_;
    FrameSwap swap_;
    Station draw_;
    Station host_;
    std::map<FrameNumber, Frame> frames_;
    std::deque<FrameNumber> to_draw_;
    bool card_taken_ = false;  // with compositing on the card: a frame is on it
};

}  // namespace swath::sim
