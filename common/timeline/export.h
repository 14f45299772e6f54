#pragma once
#include <span>
#include <string>

#include "common/timeline/timeline.h"

namespace swath {

// Tidy CSV, a row per span and per non-zero counter:
//   frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value
// kind is "span" (value empty) or "counter" (times empty). Times start at the first span of the first frame.
std::string to_csv(std::span<const FrameTimeline> frames);

// The trace event format that chrome://tracing and ui.perfetto.dev open: a process per machine, a complete
// ("X") event per span with the frame number as argument. Overlapping spans of one machine go to separate
// tracks.
std::string to_chrome_trace(std::span<const FrameTimeline> frames);

}  // namespace swath
