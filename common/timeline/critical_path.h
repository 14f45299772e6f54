#pragma once
#include <string>
#include <vector>

#include "common/base/clock.h"
#include "common/timeline/timeline.h"

namespace swath {

// A span of the critical path.
struct CriticalSpan {
    std::string machine;
    Phase phase = Phase::kWait;  // kWait: a server's task waits for its drawing thread
    Nanoseconds begin{0};
    Nanoseconds end{0};
    bool operator==(const CriticalSpan&) const = default;
};

// The most that two machines' clocks may disagree: half a quick round trip in a busy network.
inline constexpr Nanoseconds kClockError = std::chrono::microseconds(200);

// The chain of spans that the frame's picture waited for, first to last. It ends with the display's last
// span, or, if the display has none, with the last span of all. Each span waited for the span before it in
// the chain, which is the one that ends nearest to its begin, of those that can have caused it:
// - any earlier span of its own machine, which wins if it ends as the other begins;
// - of a server's span: the client's spans;
// - of a server's pixel write: other servers' swaps, or, if there are none because the graphics card
//   composites, their pixel reads;
// - of the display's span: the client's spans, and servers' final reads and sends.
//
// A wait causes nothing, except a server's wait between its task and its first work, in which its drawing
// thread was busy with another frame. A span of another machine must have begun before its effect, but for
// `clock_error`, and may end after it: messages leave within spans, and a thread may lose its core before it
// can look at the clock. Gaps in the chain are messages on their way or work for another frame. Spans that
// end before they begin are left out. Deterministic. Empty only if there is no span but waits.
std::vector<CriticalSpan> critical_path(const FrameTimeline& frame, Nanoseconds clock_error = kClockError);

}  // namespace swath
