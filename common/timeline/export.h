#pragma once
#include <span>
#include <string>
#include <string_view>

#include "common/timeline/timeline.h"

namespace swath {

// Both exports are deterministic: equal timelines give equal text, whatever the locale. Times are relative to
// the earliest span of all frames.

inline constexpr std::string_view kTimelineHeader = "frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value";

// Tidy CSV with that header, ended lines, fields quoted where RFC 4180 asks for it; import.h reads it back. A
// row per span (kind "span", value empty; six decimals, so exact nanoseconds; cpu_ms is 0 where unknown),
// per non-zero counter (kind "counter", times empty) and one per frame (kind "frame", name "overlap_factor",
// machine and times empty).
std::string to_csv(std::span<const FrameTimeline> frames);

// The trace event format that chrome://tracing and ui.perfetto.dev open: a process per machine in order of
// first appearance, a complete ("X") event per span in microseconds, with the frame number and, where known,
// the CPU milliseconds as arguments. Spans of one machine that overlap (pipelined frames, several threads) go
// to separate tracks, as few as possible. One event a line. Names that are not UTF-8 are mended.
std::string to_chrome_trace(std::span<const FrameTimeline> frames);

}  // namespace swath
