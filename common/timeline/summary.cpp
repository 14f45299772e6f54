#include "common/timeline/summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace swath {
namespace {

constexpr std::size_t kMaxColumns = 100;
constexpr std::size_t kMaxNameColumns = 18;
constexpr std::size_t kMaxServerRows = 16;

double busy_ms(const MachineTimeline& machine) {
    double sum = 0;
    for (const Span& span : machine.spans)
        if (span.phase != Phase::kWait) sum += milliseconds(span.end - span.begin);
    return sum;
}

// (max - mean) / max over the frame's servers; negative if none was busy.
double imbalance(const FrameTimeline& frame) {
    double max = 0;
    double sum = 0;
    std::size_t servers = 0;
    for (const MachineTimeline& machine : frame.machines) {
        if (!is_server(machine.machine)) continue;
        const double busy = busy_ms(machine);
        max = std::max(max, busy);
        sum += busy;
        ++servers;
    }
    return max > 0 ? (max - sum / static_cast<double>(servers)) / max : -1;
}

void add(Summary::Machine& to, const MachineTimeline& from) {
    ++to.frames;
    for (const Span& span : from.spans) {
        const auto phase = static_cast<std::size_t>(span.phase);
        to.mean_ms[phase] += milliseconds(span.end - span.begin);
        to.mean_cpu_ms[phase] += milliseconds(span.cpu);
    }
    for (std::size_t i = 0; i < kCounterCount; ++i) to.mean_count[i] += static_cast<double>(from.counters[i]);
}

template <std::size_t N>
void divide(std::array<double, N>& sums, std::size_t by) {
    for (double& sum : sums) sum /= static_cast<double>(by);
}

// A line of the table.
struct Row {
    std::string name;
    std::array<double, kPhaseCount> ms{};
};

std::string shortened(const std::string& name) {
    if (name.size() <= kMaxNameColumns) return name;
    return name.substr(0, kMaxNameColumns - 1) + '~';
}

// Mean, minimum and maximum of each phase over the servers.
std::array<Row, 3> condensed(const std::vector<const Summary::Machine*>& servers) {
    std::array<Row, 3> rows{Row{fmt::format("{} servers: mean", servers.size()), {}}, Row{"  min", {}},
                            Row{"  max", {}}};
    for (std::size_t i = 0; i < kPhaseCount; ++i) {
        rows[1].ms[i] = rows[2].ms[i] = servers.front()->mean_ms[i];
        for (const Summary::Machine* server : servers) {
            rows[0].ms[i] += server->mean_ms[i] / static_cast<double>(servers.size());
            rows[1].ms[i] = std::min(rows[1].ms[i], server->mean_ms[i]);
            rows[2].ms[i] = std::max(rows[2].ms[i], server->mean_ms[i]);
        }
    }
    return rows;
}

std::vector<Row> rows_of(const Summary& summary) {
    std::vector<const Summary::Machine*> servers;
    for (const Summary::Machine& machine : summary.machines)
        if (is_server(machine.name)) servers.push_back(&machine);
    const bool condense = servers.size() > kMaxServerRows;

    std::vector<Row> rows;
    for (const Summary::Machine& machine : summary.machines) {
        if (!condense || !is_server(machine.name)) {
            rows.push_back({shortened(machine.name), machine.mean_ms});
        } else if (&machine == servers.front()) {
            std::ranges::copy(condensed(servers), std::back_inserter(rows));
        }
    }
    return rows;
}

// A time in at most six characters, so that all phases fit, with the same decimals in the whole table.
std::string cell(double ms, double largest) {
    if (largest < 999.99) return fmt::format("{:.2f}", ms);
    if (largest < 9999.9) return fmt::format("{:.1f}", ms);
    if (largest < 999999) return fmt::format("{:.0f}", ms);
    return fmt::format("{:.0e}", ms);
}

// A phase's column: its name on two lines ("pixel" above "read") and a cell per row.
struct Column {
    std::array<std::string, 2> head;
    std::vector<std::string> cells;
    std::size_t width = 0;
};

std::vector<Column> columns_of(const std::vector<Row>& rows) {
    double largest = 0;
    for (const Row& row : rows) largest = std::max(largest, *std::ranges::max_element(row.ms));
    std::vector<Column> columns;
    for (std::size_t i = 0; i < kPhaseCount; ++i) {
        if (std::ranges::all_of(rows, [&](const Row& row) { return row.ms[i] == 0; })) continue;
        const std::string_view phase = name_of(static_cast<Phase>(i));
        const std::size_t space = phase.find(' ');
        Column column;
        if (space == std::string_view::npos)
            column.head[1] = phase;
        else
            column.head = {std::string(phase.substr(0, space)), std::string(phase.substr(space + 1))};
        column.width = std::max(column.head[0].size(), column.head[1].size());
        for (const Row& row : rows) {
            column.cells.push_back(cell(row.ms[i], largest));
            column.width = std::max(column.width, column.cells.back().size());
        }
        columns.push_back(std::move(column));
    }
    return columns;
}

std::string table(const std::vector<Row>& rows) {
    constexpr std::string_view kCorner = "ms a frame";
    const std::vector<Column> columns = columns_of(rows);
    std::size_t name_width = kCorner.size();
    for (const Row& row : rows) name_width = std::max(name_width, row.name.size());
    std::size_t width = name_width;
    for (const Column& column : columns) width += column.width + 2;
    const std::size_t gap = width <= kMaxColumns ? 2 : 1;

    std::string text;
    const auto line = [&](std::string_view name, const auto& text_of_column) {
        std::string out = fmt::format("{:<{}}", name, name_width);
        for (const Column& column : columns)
            out += fmt::format("{:>{}}", text_of_column(column), column.width + gap);
        out.erase(out.find_last_not_of(' ') + 1);
        text += out + '\n';
    };
    if (std::ranges::any_of(columns, [](const Column& column) { return !column.head[0].empty(); }))
        line("", [](const Column& column) { return column.head[0]; });
    line(kCorner, [](const Column& column) { return column.head[1]; });
    for (std::size_t i = 0; i < rows.size(); ++i)
        line(rows[i].name, [&](const Column& column) { return column.cells[i]; });
    return text;
}

// A counter's mean over all frames, summed over the machines.
double count(const Summary& summary, Counter counter) {
    double sum = 0;
    for (const Summary::Machine& machine : summary.machines)
        sum += machine.mean_count[static_cast<std::size_t>(counter)] * static_cast<double>(machine.frames);
    return summary.frames > 0 ? sum / static_cast<double>(summary.frames) : 0;
}

}  // namespace

Summary summarise(std::span<const FrameTimeline> frames) {
    Summary summary;
    summary.frames = frames.size();
    if (frames.empty()) return summary;

    std::unordered_map<std::string_view, std::size_t> places;
    Nanoseconds first_begin = Nanoseconds::max();
    Nanoseconds last_end = Nanoseconds::min();
    double imbalance_sum = 0;
    std::size_t busy_frames = 0;
    double overlap_sum = 0;
    for (const FrameTimeline& frame : frames) {
        for (const MachineTimeline& machine : frame.machines) {
            const auto [place, is_new] = places.emplace(machine.machine, summary.machines.size());
            if (is_new) summary.machines.push_back({machine.machine, 0, {}, {}, {}});
            add(summary.machines[place->second], machine);
            for (const Span& span : machine.spans) {
                first_begin = std::min(first_begin, span.begin);
                last_end = std::max(last_end, span.end);
            }
            if (!is_server(machine.machine)) continue;
            summary.swap_pixels += static_cast<double>(machine[Counter::kSwapPixels]);
            summary.swap_bytes += static_cast<double>(machine[Counter::kSwapBytes]);
            summary.tile_bytes += static_cast<double>(machine[Counter::kTileBytes]);
        }
        if (const double of_frame = imbalance(frame); of_frame >= 0) {
            imbalance_sum += of_frame;
            ++busy_frames;
        }
        overlap_sum += frame.overlap_factor;
    }
    for (Summary::Machine& machine : summary.machines) {
        divide(machine.mean_ms, machine.frames);
        divide(machine.mean_cpu_ms, machine.frames);
        divide(machine.mean_count, machine.frames);
    }
    const auto count = static_cast<double>(frames.size());
    if (last_end > first_begin)
        summary.frames_per_s = count / std::chrono::duration<double>(last_end - first_begin).count();
    if (busy_frames > 0) summary.imbalance = imbalance_sum / static_cast<double>(busy_frames);
    summary.swap_pixels /= count;
    summary.swap_bytes /= count;
    summary.tile_bytes /= count;
    summary.overlap_factor = overlap_sum / count;
    return summary;
}

std::string to_text(const Summary& summary) {
    std::string text = summary.machines.empty() ? "" : table(rows_of(summary)) + '\n';
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "frames     {}, {:.2f} frames/s\n", summary.frames, summary.frames_per_s);
    if (const double triangles = count(summary, Counter::kTriangles); triangles > 0)
        fmt::format_to(out, "drawn      {:.0f} triangles of {:.0f} objects a frame\n", triangles,
                       count(summary, Counter::kObjects));
    fmt::format_to(out, "swapped    {:.0f} pixels, {:.1f} KiB a frame\n", summary.swap_pixels,
                   summary.swap_bytes / 1024);
    fmt::format_to(out, "tiles      {:.1f} KiB a frame\n", summary.tile_bytes / 1024);
    fmt::format_to(out, "imbalance  {:.1f} %\n", 100 * summary.imbalance);
    fmt::format_to(out, "overlap    {:.3f}\n", summary.overlap_factor);
    return text;
}

}  // namespace swath
