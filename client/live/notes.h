#pragma once
#include <string>
#include <vector>

#include "client/live/live_view.h"
#include "client/live/speed_ups.h"
#include "client/partition/projection.h"
#include "client/predict/prediction.h"
#include "common/image/picture.h"
#include "common/plan/frame_plan.h"
#include "common/scene/objects.h"
#include "common/timeline/critical_path.h"
#include "common/timeline/timeline.h"

namespace swath {

// Makes the notes to viewers about a run: JSON objects, as in docs/viewer.md. Pure functions; any thread.

// The facts about a run that stay.
struct SessionFacts {
    struct Server {
        std::string address;
        std::string renderer;
    };
    std::string model;
    std::size_t triangles = 0;
    Box bounds;
    std::vector<Server> servers;
    Rgb background{};
};

// A frame that is over: its order, plan and timeline.
struct FinishedFrame {
    FrameOrder order;
    FramePlan plan;
    std::vector<ProjectedObject> projected;  // the plan was made from these
    FrameTimeline timeline;
};
// Conclusions from a finished frame.
struct FrameFindings {
    std::optional<Nanoseconds> interval;  // since the frame before was over; none after a rest
    std::vector<CriticalSpan> critical;
    std::optional<Prediction> prediction;
    std::vector<Comparison> others;  // empty for most frames
};

// A note has at most so many objects; beyond that a viewer is told that there are too many.
inline constexpr std::size_t kMaxObjectsInPlan = 200'000;
inline constexpr std::size_t kMaxBoxes = 50'000;

// Without `live` the run follows a camera path.
std::string session_note(const SessionFacts& facts, const LiveView* live, const WishLimits& limits);
std::string objects_note(std::uint64_t generation, const ObjectSet& scene);
std::string plan_note(const FrameOrder& order, const FramePlan& plan, double overlap,
                      std::uint64_t generation);
std::string state_note(const LiveView& live, const std::string& busy, const std::string& command);
std::string frame_note(const FinishedFrame& frame, const FrameFindings& findings);
std::string speedup_note(const SpeedUps& found, bool running);
// `trace` is JSON (to_chrome_trace).
std::string trace_note(const std::string& trace);

}  // namespace swath
