#include "client/live/broadcast.h"

#include "common/timeline/export.h"

namespace swath {
namespace {

// A person reads no faster, and it is work to partition by all algorithms.
constexpr Nanoseconds kBetweenComparisons = std::chrono::milliseconds(250);
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
    partitioners_.clear();
    tell_objects();
}

// Makes the note only for viewers: that of a large model takes a while.
void Broadcast::tell_objects() {
    if (viewers_ > 0) tell(NoteTopic::kObjects, objects_note(generation_, *scene_));
}

void Broadcast::on_state(const LiveView& live, const std::string& busy, const std::string& command) {
    keep(NoteTopic::kState, state_note(live, busy, command));
    if (measuring_ && !live.measuring()) tell_speed_ups(false);
}

void Broadcast::tell_speed_ups(bool measuring) {
    measuring_ = measuring;
    keep(NoteTopic::kSpeedup, speedup_note(speed_ups_, measuring));
}

void Broadcast::on_planned(const FrameOrder& order, const FramePlan& plan, double overlap) {
    if (viewers_ > 0) tell(NoteTopic::kPlan, plan_note(order, plan, overlap, generation_), plan.frame);
}

// Predicts before the frame itself teaches the rates anything.
FrameFindings Broadcast::findings_of(const FinishedFrame& frame, Nanoseconds now) {
    FrameFindings findings;
    if (last_over_ && now - *last_over_ < kRest) findings.interval = now - *last_over_;
    last_over_ = now;
    findings.critical = critical_path(frame.timeline);
    if (const auto hardware = rates_.hardware(frame.order.algorithm))
        findings.prediction =
            predict(frame.plan, frame.projected, frame.order.algorithm, scene_->objects, *hardware);
    const bool due = !last_comparison_ || now - *last_comparison_ >= kBetweenComparisons;
    if (frame.order.stream == 0 && (due || frame.order.algorithm != compared_)) {
        findings.others = compare_all(frame);
        last_comparison_ = now;
        compared_ = frame.order.algorithm;
    }
    return findings;
}

std::vector<Comparison> Broadcast::compare_all(const FinishedFrame& frame) {
    std::vector<Contender> contenders;
    for (const Algorithm algorithm : kAll<Algorithm>) {
        auto& partitioner = partitioners_[algorithm];
        if (!partitioner) partitioner = make_partitioner(algorithm, scene_->objects);
        contenders.push_back({algorithm, partitioner.get()});
    }
    return compare({frame.plan.frame, frame.plan.view, frame.projected, frame.plan.servers.size()},
                   scene_->objects, contenders, rates_);
}

void Broadcast::on_over(const FinishedFrame& frame, bool measuring, Nanoseconds now) {
    if (viewers_ == 0) return;
    if (frame.order.width != width_ || frame.order.height != height_) rates_ = {};
    width_ = frame.order.width;
    height_ = frame.order.height;
    const FrameFindings findings = findings_of(frame, now);
    rates_.add(frame.plan, frame.timeline, frame.order.algorithm, scene_->objects.size());
    std::optional<double> predicted_ms;
    if (findings.prediction) predicted_ms = findings.prediction->frame_ms;
    if (speed_ups_.on_frame(frame.order, frame.timeline, findings.interval, predicted_ms))
        tell_speed_ups(measuring);
    tell(NoteTopic::kFrame, frame_note(frame, findings));
}

void Broadcast::on_trace(const std::vector<FrameTimeline>& frames) {
    // Only some frames of many servers fit: the newest.
    std::span<const FrameTimeline> newest(frames);
    std::string note = trace_note(to_chrome_trace(newest));
    while (note.size() > kMaxNoteBytes && newest.size() > 1) {
        newest = newest.subspan((newest.size() + 1) / 2);
        note = trace_note(to_chrome_trace(newest));
    }
    tell(NoteTopic::kTrace, note);
}

}  // namespace swath
