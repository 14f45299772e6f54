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

// How far two machines' clocks are taken to disagree at most: half a quick round trip in a busy network.
inline constexpr Nanoseconds kClockError = std::chrono::microseconds(200);

// The chain of spans that the frame's picture waited for, first to last. It ends with the display's last span
// (where the display has none: with the last of all). What a span waited for is, of the spans that can have
// caused it, the one that ends last before it begins:
// - any of its own machine;
// - for a server's: the client's;
// - for a server's merging of pixels: other servers' coding of swaths (where nobody codes, reading pixels:
//   compositing on the graphics card);
// - for the display's: the client's, and servers' gathering and sending of tiles.
// Waits are no causes: what ended them is. The exception is a server's wait between its task and its first
// work, in which its drawing thread was busy with another frame.
// A span of another machine may go on while what it caused has begun: messages leave within spans, and a
// thread may lose its core before it can look at the clock. It must have begun before, but for `clock_error`.
// Of several the one whose end is nearest counts, and a span of the own machine that ends as the next begins
// counts before all others. Between two spans of the chain there may be a gap: messages on their way, or
// another frame's work. Of equal timelines it is the same; empty only if there is no span but waits. Spans
// that end before they begin are passed over.
std::vector<CriticalSpan> critical_path(const FrameTimeline& frame, Nanoseconds clock_error = kClockError);

}  // namespace swath
