#pragma once
#include <span>
#include <string>
#include <string_view>

#include "common/timeline/timeline.h"

namespace swath {

// Equal timelines export to equal text in any locale. Times are relative to the earliest span of all frames.

inline constexpr std::string_view kTimelineHeader = "frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value";

// A CSV table (RFC 4180) with that header, which import.h reads back. Rows by kind:
//
//   frame    one per frame: name is "overlap_factor"; machine and times are empty
//   span     name is the phase; value is empty; six decimals make nanoseconds exact; cpu_ms is 0 if unknown
//   counter  one per counter that is not 0; times are empty
std::string to_csv(std::span<const FrameTimeline> frames);

// The trace event format, which chrome://tracing and ui.perfetto.dev open. A machine is a process, in order
// of first appearance. A span is a complete ("X") event in microseconds, with the frame number and, if known,
// the CPU milliseconds as arguments. Overlapping spans of one machine (pipelined frames, several threads) are
// on separate tracks, as few as possible. Each event has a line. Names that are not UTF-8 are mended.
std::string to_chrome_trace(std::span<const FrameTimeline> frames);

}  // namespace swath
