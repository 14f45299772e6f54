#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"

namespace swath {

// An order from the Director.
struct DirectorAction {
    enum class Kind {
        kIssue,        // partition `frame` and send its tasks
        kReconfigure,  // no frame is open: apply the change, then call on_reconfigured
        kFinish,       // every frame is complete and accounted for
        kAbort,        // the run cannot go on; `reason` says why
    };
    Kind kind{};
    FrameNumber frame = 0;
    std::string reason;
    bool operator==(const DirectorAction&) const = default;
};

// Decides which frame is begun next. It keeps a few in flight so that client, servers and display overlap
// (Samanta 2000, section 4), and the slowest of them sets the rate. A lost server or display ends the run.
// Sans-I/O: the client drives it from its sockets, the simulator from its event queue. Not thread-safe.
class Director {
  public:
    // `frames` in all; at most `in_flight` (at least 1) are begun and not over.
    Director(std::size_t frames, std::size_t in_flight) : frames_(frames), in_flight_(in_flight) {}
    // A run without end: it begins a frame when one is wanted and a slot is free. Wishes are not queued.
    static Director live(std::size_t in_flight) { return Director(in_flight); }

    using Actions = std::vector<DirectorAction>;

    Actions on_start();
    // The frame's tasks went out to this many servers, each of which will report.
    void on_issued(FrameNumber frame, std::size_t servers);
    // Errors blame the sender.
    Result<Actions> on_server_report(FrameNumber frame);
    Result<Actions> on_display_report(FrameNumber frame);
    Actions on_lost(const std::string& who, const std::string& why);
    // For a live run: says whether there is something to draw. Holds until a frame is begun.
    Actions on_wanted(bool wanted);
    // Begins no frame until those in flight are over and kReconfigure is done.
    Actions on_reconfigure();
    // Forgets what was wanted, which may have changed: call on_wanted again.
    Actions on_reconfigured();

    std::size_t complete() const { return complete_; }

  private:
    struct Open {
        FrameNumber frame = 0;
        std::size_t reports_missing = 0;
        bool displayed = false;
    };
    explicit Director(std::size_t in_flight) : in_flight_(in_flight), live_(true) {}
    Open* find(FrameNumber frame);
    bool may_begin() const;
    Actions advance();

    std::size_t frames_ = 0;
    std::size_t in_flight_;
    FrameNumber next_ = 0;
    std::size_t complete_ = 0;  // frames whose picture is complete
    std::vector<Open> open_;
    bool live_ = false;
    bool started_ = false;
    bool wanted_ = false;
    enum class Change { kNone, kAwaited, kUnderWay } change_ = Change::kNone;
    bool over_ = false;
};

}  // namespace swath
