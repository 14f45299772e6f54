#pragma once
#include <initializer_list>
#include <string>
#include <vector>

#include "common/timeline/timeline.h"

// A small vocabulary for timelines written by hand: times are whole milliseconds.
namespace swath {

inline Nanoseconds ms(int t) { return std::chrono::milliseconds(t); }
inline Span span(Phase phase, int begin, int end, int cpu = 0) {
    return {phase, ms(begin), ms(end), ms(cpu)};
}
inline MachineTimeline machine(std::string name, std::vector<Span> spans) {
    return {std::move(name), std::move(spans), {}};
}
inline FrameTimeline frame(FrameNumber number, std::vector<MachineTimeline> machines) {
    return {number, std::move(machines), 1.0};
}

}  // namespace swath
