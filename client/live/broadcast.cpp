#include "client/live/broadcast.h"

#include "common/timeline/export.h"

namespace swath {
namespace {

constexpr Nanoseconds kRest = std::chrono::seconds(1);  // between two frames that do not follow one another

}  // namespace

void Broadcast::tell(NoteTopic topic, const std::string& text, FrameNumber frame) {
    if (viewers_ > 0 && text.size() <= kMaxNoteBytes) send_(topic, frame, text);
}

void Broadcast::keep(NoteTopic topic, std::string text) {
    tell(topic, text);
    kept_[topic] = std::move(text);
}

void Broadcast::on_viewers(std::uint32_t viewers) {
    const bool first = viewers_ == 0;
    viewers_ = viewers;
    if (!first) return;
    for (const auto& [topic, text] : kept_) tell(topic, text);
    tell_objects();
}

void Broadcast::on_session(SessionFacts facts, const LiveView* live, const WishLimits& limits) {
    keep(NoteTopic::kSession, session_note(facts, live, limits));
}

void Broadcast::on_scene(std::shared_ptr<const ObjectSet> scene) {
    scene_ = std::move(scene);
    ++generation_;
    tell_objects();
}

// Made when somebody looks: a large model's takes a while.
void Broadcast::tell_objects() {
    if (viewers_ > 0) tell(NoteTopic::kObjects, objects_note(generation_, *scene_));
}

void Broadcast::on_state(const LiveView& live, const std::string& busy, const std::string& command) {
    keep(NoteTopic::kState, state_note(live, busy, command));
}

void Broadcast::on_planned(const FrameOrder& order, const FramePlan& plan, double overlap) {
    if (viewers_ > 0) tell(NoteTopic::kPlan, plan_note(order, plan, overlap, generation_), plan.frame);
}

void Broadcast::on_over(const FinishedFrame& frame, Nanoseconds now) {
    FrameFindings findings;
    if (last_over_ && now - *last_over_ < kRest) findings.interval = now - *last_over_;
    last_over_ = now;
    if (viewers_ > 0) tell(NoteTopic::kFrame, frame_note(frame, findings));
}

void Broadcast::on_trace(const std::vector<FrameTimeline>& frames) {
    tell(NoteTopic::kTrace, trace_note(to_chrome_trace(frames)));
}

}  // namespace swath
