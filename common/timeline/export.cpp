#include "common/timeline/export.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <tuple>
#include <unordered_map>

#include "common/base/csv.h"

namespace swath {
namespace {

Nanoseconds earliest_begin(std::span<const FrameTimeline> frames) {
    Nanoseconds earliest = Nanoseconds::max();
    for (const FrameTimeline& frame : frames)
        for (const MachineTimeline& machine : frame.machines)
            for (const Span& span : machine.spans) earliest = std::min(earliest, span.begin);
    return earliest == Nanoseconds::max() ? Nanoseconds{0} : earliest;
}

// A double holds whole nanoseconds exactly for 104 days, so six decimals of a millisecond are exact.
double microseconds(Nanoseconds t) { return static_cast<double>(t.count()) / 1e3; }

// A span and the track that it is shown on.
struct PlacedSpan {
    FrameNumber frame;
    Span span;
    std::size_t track;
};

struct Process {
    std::string machine;
    std::vector<PlacedSpan> spans;
    std::size_t tracks = 0;
};

// Machines in order of first appearance, each with its spans of all frames.
std::vector<Process> gather(std::span<const FrameTimeline> frames) {
    std::vector<Process> processes;
    std::unordered_map<std::string_view, std::size_t> places;
    for (const FrameTimeline& frame : frames) {
        for (const MachineTimeline& machine : frame.machines) {
            const auto [place, is_new] = places.emplace(machine.machine, processes.size());
            if (is_new) processes.push_back({machine.machine, {}, 0});
            for (const Span& span : machine.spans)
                processes[place->second].spans.push_back({frame.frame, span, 0});
        }
    }
    return processes;
}

// Takes the first free track in the order of begins, which needs as few tracks as spans overlap at most.
void assign_tracks(Process& process) {
    std::ranges::stable_sort(process.spans, {}, [](const PlacedSpan& placed) {
        return std::tuple(placed.span.begin, placed.span.end, placed.frame);
    });
    std::vector<Nanoseconds> busy_until;  // by track
    for (PlacedSpan& placed : process.spans) {
        const auto free =
            std::ranges::find_if(busy_until, [&](Nanoseconds until) { return until <= placed.span.begin; });
        placed.track = static_cast<std::size_t>(free - busy_until.begin());
        const Nanoseconds until = std::max(placed.span.begin, placed.span.end);
        if (free == busy_until.end())
            busy_until.push_back(until);
        else
            *free = until;
    }
    process.tracks = busy_until.size();
}

using Json = nlohmann::ordered_json;

Json metadata(const char* what, std::size_t pid, Json args) {
    return {{"name", what}, {"ph", "M"}, {"pid", pid}, {"args", std::move(args)}};
}

Json complete_event(const PlacedSpan& placed, std::size_t pid, Nanoseconds origin) {
    const Span& span = placed.span;
    Json args = {{"frame", placed.frame}};
    if (span.cpu.count() > 0) args["cpu_ms"] = milliseconds(span.cpu);
    return {{"name", name_of(span.phase)},
            {"cat", span.phase == Phase::kWait ? "wait" : "busy"},
            {"ph", "X"},
            {"pid", pid},
            {"tid", placed.track + 1},
            {"ts", microseconds(span.begin - origin)},
            {"dur", microseconds(std::max(Nanoseconds{0}, span.end - span.begin))},
            {"args", std::move(args)}};
}

}  // namespace

std::string to_csv(std::span<const FrameTimeline> frames) {
    const Nanoseconds origin = earliest_begin(frames);
    std::string csv = fmt::format("{}\n", kTimelineHeader);
    const auto out = std::back_inserter(csv);
    for (const FrameTimeline& frame : frames) {
        fmt::format_to(out, "{},,frame,overlap_factor,,,,{:.6f}\n", frame.frame, frame.overlap_factor);
        for (const MachineTimeline& machine : frame.machines) {
            const std::string machine_name = csv_field(machine.machine);
            for (const Span& span : machine.spans)
                fmt::format_to(out, "{},{},span,{},{:.6f},{:.6f},{:.6f},\n", frame.frame, machine_name,
                               name_of(span.phase), milliseconds(span.begin - origin),
                               milliseconds(span.end - origin), milliseconds(span.cpu));
            for (std::size_t i = 0; i < kCounterCount; ++i)
                if (machine.counters[i] != 0)
                    fmt::format_to(out, "{},{},counter,{},,,,{}\n", frame.frame, machine_name,
                                   name_of(static_cast<Counter>(i)), machine.counters[i]);
        }
    }
    return csv;
}

std::string to_chrome_trace(std::span<const FrameTimeline> frames) {
    const Nanoseconds origin = earliest_begin(frames);
    std::string trace = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[";
    const char* separator = "\n";
    const auto add = [&](const Json& event) {
        trace += separator;
        trace += event.dump(-1, ' ', false, Json::error_handler_t::replace);
        separator = ",\n";
    };
    std::vector<Process> processes = gather(frames);
    for (std::size_t i = 0; i < processes.size(); ++i) {
        const std::size_t pid = i + 1;  // viewers hide process 0
        Process& process = processes[i];
        assign_tracks(process);
        add(metadata("process_name", pid, {{"name", process.machine}}));
        add(metadata("process_sort_index", pid, {{"sort_index", pid}}));
        for (const PlacedSpan& placed : process.spans) add(complete_event(placed, pid, origin));
    }
    return trace + "\n]}\n";
}

}  // namespace swath
