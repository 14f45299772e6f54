#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/live/live_view.h"
#include "client/live/notes.h"
#include "common/base/clock.h"
#include "common/wire/messages.h"

namespace swath {

// Tells viewers about a run, and only while there are some: composes the notes and hands them to `send`.
// Notes that stay valid (session, objects, state, speed-ups) are sent again when a first viewer comes. One
// thread.
class Broadcast {
  public:
    using Send = std::function<void(NoteTopic, FrameNumber, const std::string&)>;
    explicit Broadcast(Send send) : send_(std::move(send)) {}

    void on_viewers(std::uint32_t viewers);
    // `live` is null in a run along a path.
    void on_session(SessionFacts facts, const LiveView* live, const WishLimits& limits);
    // The model is cut like this from the next plan on.
    void on_scene(std::shared_ptr<const ObjectSet> scene);
    // Servers draw or cull differently from now on, so the learned rates are void.
    void on_drawing() { rates_ = {}; }
    void on_state(const LiveView& live, const std::string& busy, const std::string& command);
    void on_planned(const FrameOrder& order, const FramePlan& plan, double overlap);
    // `measuring`: more frames of a measurement will come.
    void on_over(const FinishedFrame& frame, bool measuring, Nanoseconds now);
    void on_trace(const std::vector<FrameTimeline>& frames);

  private:
    void tell(NoteTopic topic, const std::string& text, FrameNumber frame = 0);
    // Tells it, and again when a first viewer comes.
    void keep(NoteTopic topic, std::string text);
    void tell_objects();
    void tell_speed_ups(bool measuring);
    FrameFindings findings_of(const FinishedFrame& frame, Nanoseconds now);
    std::vector<Comparison> compare_all(const FinishedFrame& frame);

    Send send_;
    std::uint32_t viewers_ = 0;
    std::shared_ptr<const ObjectSet> scene_;
    std::uint64_t generation_ = 0;
    std::optional<Nanoseconds> last_over_;
    SpeedUps speed_ups_;
    Rates rates_;  // for pictures of this size
    int width_ = 0;
    int height_ = 0;
    std::map<Algorithm, std::unique_ptr<Partitioner>> partitioners_;  // for scene_ and predictions
    std::optional<Nanoseconds> last_comparison_;
    Algorithm compared_ = Algorithm::kHybrid;  // the algorithm in use at the last comparison
    bool measuring_ = false;                   // as told last
    std::map<NoteTopic, std::string> kept_;    // session, state, speed-ups
};

}  // namespace swath
