#include "sim/compare/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "common/base/file.h"
#include "common/timeline/export.h"
#include "common/timeline/import.h"
#include "common/timeline/summary.h"
#include "sim/plot/gnuplot.h"
#include "sim/plot/plot.h"
#include "sim/table/table.h"

namespace swath::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kColumn = "speedup";           // the paper's, of the servers alone
constexpr std::string_view kFullColumn = "full_speedup";  // the whole simulated cluster's
constexpr std::string_view kTitle = "speed-up, servers:";
constexpr std::string_view kFullMode = ", full mode";  // ends the name of such a curve
constexpr std::size_t kMostDrawn = 6;                  // beside measured ones: each has a colour
constexpr std::size_t kMeasuredColour = 6;             // black, with another mark for each kColours more
constexpr std::size_t kColours = 7;
constexpr std::uint64_t kMaxFileBytes = 512ull << 20;

struct Input {
    std::string label;
    std::string file;
};

Result<Input> parse_input(const std::string& text) {
    const std::size_t equals = text.find('=');
    std::error_code ignored;
    // A file whose name has an equals sign needs no label.
    if (equals == std::string::npos || fs::exists(text, ignored)) return Input{fs::path(text).stem(), text};
    if (equals == 0 || equals + 1 == text.size())
        return fail("'{}' is not LABEL=FILE: one of them is empty", text);
    return Input{text.substr(0, equals), text.substr(equals + 1)};
}

// Inserts the point in order. A second one for the same number of servers is an error.
Status add(Curve& curve, std::size_t servers, double speedup, std::string_view file) {
    const auto place =
        std::ranges::lower_bound(curve.points, servers, {}, [](const auto& p) { return p.first; });
    if (place != curve.points.end() && place->first == servers)
        return fail("{}: a second speed-up of {} with {} server{}", file, curve.name, servers,
                    servers == 1 ? "" : "s");
    curve.points.emplace(place, servers, speedup);
    return {};
}

Status add_table(const Input& input, std::string_view text, std::vector<Curve>& curves) {
    SWATH_TRY(const auto rows, parse_table(text, input.file));
    std::vector<Curve> found;
    for (const Row& row : rows) {
        if (row.column != kColumn && row.column != kFullColumn) continue;
        const std::string name =
            fmt::format("{}, {}{}", row.algorithm, row.model, row.column == kFullColumn ? kFullMode : "");
        if (row.servers == 0 || !(row.value > 0))
            return fail("{}: {} has a speed-up of {} with {} servers", input.file, name, row.value,
                        row.servers);
        auto curve = std::ranges::find(found, name, &Curve::name);
        if (curve == found.end()) curve = found.insert(found.end(), {input.label, name, {}, false});
        SWATH_TRY_VOID(add(*curve, row.servers, row.value, input.file));
    }
    if (found.empty()) return fail("{}: no row has the column {}", input.file, kColumn);
    curves.insert(curves.end(), found.begin(), found.end());
    return {};
}

// A run of the real cluster, from its timeline.
struct Run {
    std::size_t servers = 0;
    double frames_per_s = 0;
};

Result<Run> read_run(const Input& input, std::string_view text) {
    SWATH_TRY(const auto frames, parse_timeline(text, input.file));
    std::set<std::string_view> servers;
    bool is_single = false;
    for (const FrameTimeline& frame : frames)
        for (const MachineTimeline& machine : frame.machines) {
            if (is_server(machine.machine)) servers.insert(machine.machine);
            is_single |= machine.machine == kSingleMachine;
        }
    if (servers.empty() && !is_single) return fail("{}: the timeline names no server", input.file);
    const double rate = summarise(frames).frames_per_s;
    if (!(rate > 0)) return fail("{}: the timeline takes no time", input.file);
    return Run{std::max<std::size_t>(servers.size(), 1), rate};
}

// Turns a measured curve's frames a second into speed-ups.
Status divide_by_one_server(Curve& curve) {
    if (curve.points.front().first != 1)
        return fail("{}: no timeline of one server (or --single) to compare with; label it {}=FILE",
                    curve.label, curve.label);
    const double one = curve.points.front().second;
    for (auto& [servers, value] : curve.points) value /= one;
    return {};
}

std::string full_name(const Curve& curve) {
    return curve.name == curve.label ? curve.label : fmt::format("{}: {}", curve.label, curve.name);
}

// Null if the curve has no such point.
const double* speedup_at(const Curve& curve, std::size_t servers) {
    const auto found = std::ranges::find(curve.points, servers, &std::pair<std::size_t, double>::first);
    return found == curve.points.end() ? nullptr : &found->second;
}

// The distance of a curve to the nearest measured one: the mean of |log(ratio)| over the points of both, without
// one server, where all are 1. Infinity if they share none.
double distance(const Curve& curve, const std::vector<const Curve*>& measured) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Curve* one : measured) {
        double sum = 0;
        std::size_t shared = 0;
        for (const auto& [servers, speedup] : curve.points) {
            const double* other = servers > 1 ? speedup_at(*one, servers) : nullptr;
            if (other == nullptr) continue;
            sum += std::abs(std::log(speedup / *other));
            ++shared;
        }
        if (shared > 0) nearest = std::min(nearest, sum / static_cast<double>(shared));
    }
    return nearest;
}

// The position of the text in `seen`, to which it is added if it is new.
std::size_t place_of(const std::string& text, std::vector<std::string>& seen) {
    const auto found = std::ranges::find(seen, text);
    if (found != seen.end()) return static_cast<std::size_t>(found - seen.begin());
    seen.push_back(text);
    return seen.size() - 1;
}

Plot plot_of(std::span<const Curve> curves) {
    constexpr std::array kStyles{Style::kLine, Style::kPoints, Style::kDashed};
    Plot plot{"Speed-up", "servers", "speed-up over one server", false, {}};
    std::vector<std::string> labels;
    std::vector<std::string> names;
    std::size_t measured = 0;
    double most = 1;
    for (const Curve& curve : curves) {
        Series series{full_name(curve) + (curve.measured ? " (measured)" : ""), {}, {}, {}};
        if (curve.measured) {
            series.style = Style::kBold;
            series.colour = kMeasuredColour + kColours * measured++;
        } else {
            series.colour = place_of(curve.name, names);
            series.style = kStyles[place_of(curve.label, labels) % kStyles.size()];
        }
        for (const auto& [servers, speedup] : curve.points)
            series.points.emplace_back(static_cast<double>(servers), speedup);
        most = std::max(most, series.points.back().first);
        plot.series.push_back(std::move(series));
    }
    plot.series.push_back({"ideal", {{1, 1}, {most, most}}, Style::kReference});
    return plot;
}

}  // namespace

Result<std::vector<Curve>> read_curves(std::span<const std::string> inputs) {
    if (inputs.empty()) return fail("nothing to compare: name at least one file");
    std::vector<Curve> curves;
    std::set<std::string> labels_of_tables;
    std::set<std::string> labels_of_runs;
    for (const std::string& text : inputs) {
        SWATH_TRY(const auto input, parse_input(text));
        SWATH_TRY(const auto bytes, read_file(input.file, kMaxFileBytes));
        const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const bool is_run = content.starts_with(kTimelineHeader);
        if ((is_run ? labels_of_tables : labels_of_runs).contains(input.label) ||
            (!is_run && !labels_of_tables.insert(input.label).second))
            return fail("{}: another input is called {} too; label it LABEL=FILE", input.file, input.label);
        if (!is_run) {
            SWATH_TRY_VOID(add_table(input, content, curves));
            continue;
        }
        SWATH_TRY(const auto run, read_run(input, content));
        if (labels_of_runs.insert(input.label).second) curves.push_back({input.label, input.label, {}, true});
        Curve& curve = *std::ranges::find(curves, input.label, &Curve::label);
        SWATH_TRY_VOID(add(curve, run.servers, run.frames_per_s, input.file));
    }
    for (Curve& curve : curves)
        if (curve.measured) SWATH_TRY_VOID(divide_by_one_server(curve));
    return curves;
}

std::vector<Curve> worth_drawing(std::span<const Curve> curves) {
    const auto is_full = [](const Curve& curve) { return curve.name.ends_with(kFullMode); };
    std::size_t most_servers = 0;
    std::set<std::string> labels_with_full_mode;
    for (const Curve& curve : curves) {
        if (curve.measured) most_servers = std::max(most_servers, 2 * curve.points.back().first);
        if (is_full(curve)) labels_with_full_mode.insert(curve.label);
    }
    std::vector<Curve> drawn(curves.begin(), curves.end());
    if (most_servers == 0) return drawn;

    std::vector<const Curve*> measured;
    for (const Curve& curve : curves)
        if (curve.measured) measured.push_back(&curve);
    for (Curve& curve : drawn) {
        std::erase_if(curve.points, [&](const auto& point) { return point.first > most_servers; });
        if (!curve.measured && !is_full(curve) && labels_with_full_mode.contains(curve.label))
            curve.points.clear();
    }
    const auto drop_empty = [&] {
        std::erase_if(drawn, [](const Curve& curve) { return curve.points.empty(); });
    };
    drop_empty();

    std::vector<std::pair<double, std::size_t>> by_distance;  // with the place in `drawn`
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if (!drawn[i].measured) by_distance.emplace_back(distance(drawn[i], measured), i);
    std::ranges::sort(by_distance);
    for (std::size_t i = kMostDrawn; i < by_distance.size(); ++i) drawn[by_distance[i].second].points.clear();
    drop_empty();
    return drawn;
}

std::string to_text(std::span<const Curve> all) {
    const std::vector<Curve> curves = worth_drawing(all);
    std::set<std::size_t> servers;
    std::size_t width = kTitle.size();
    for (const Curve& curve : curves) {
        width = std::max(width, printable(full_name(curve)).size());
        for (const auto& point : curve.points) servers.insert(point.first);
    }
    std::string text = fmt::format("{:{}}", kTitle, width);
    for (const std::size_t n : servers) text += fmt::format("{:>8}", n);
    text += '\n';
    for (const Curve& curve : curves) {
        text += fmt::format("{:{}}", printable(full_name(curve)), width);
        for (const std::size_t n : servers) {
            const double* value = speedup_at(curve, n);
            text += value != nullptr ? fmt::format("{:8.2f}", *value) : fmt::format("{:>8}", "-");
        }
        text += curve.measured ? "  measured\n" : "\n";
    }
    if (curves.size() < all.size())
        text += fmt::format("{} more {} in compare.csv only\n", all.size() - curves.size(),
                            all.size() - curves.size() == 1 ? "is" : "are");
    return text;
}

Status write_comparison(std::span<const Curve> curves, const fs::path& folder) {
    std::vector<Row> rows;
    for (const Curve& curve : curves)
        for (const auto& [servers, speedup] : curve.points)
            rows.push_back({curve.name, curve.label, servers, std::string(kColumn), speedup});
    const std::string csv = to_csv(rows);
    SWATH_TRY_VOID(write_file(folder / "compare.csv", csv));
    return draw(plot_of(worth_drawing(curves)), folder / "compare");
}

}  // namespace swath::sim
