#include "sim/plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "common/base/check.h"
#include "common/base/file.h"
#include "sim/plot/gnuplot.h"

namespace swath::sim {
namespace {

// Okabe and Ito, "Color Universal Design" (2008): eight colours that colour-blind people tell apart, without
// yellow, which is hard to see on white.
constexpr std::array<std::string_view, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                   "#e69f00", "#56b4e9", "#000000"};
// Filled marks of different shape: circle, square, triangle, diamond, triangle down, pentagon.
constexpr std::array<int, 6> kMarks{7, 5, 9, 13, 11, 15};
// The same, open, for points without a line.
constexpr std::array<int, 6> kOpenMarks{6, 4, 8, 12, 10, 14};

constexpr std::string_view kText = "#333333";
constexpr std::string_view kGrey = "#888888";

// Pixels of the SVG. A legend of many or long names makes the picture larger, not the plot smaller.
struct Canvas {
    std::size_t width = 900;
    std::size_t height = 540;
};

Canvas canvas_for(const std::vector<std::string>& legend) {
    constexpr std::size_t kPlotWidth = 660;  // including the axis and the legend's samples
    constexpr std::size_t kMargins = 100;
    constexpr std::size_t kLetter = 9;
    constexpr std::size_t kLine = 36;  // gnuplot begins another column of the legend below this
    std::size_t longest = 0;
    for (const std::string& name : legend) longest = std::max(longest, name.size());
    Canvas canvas;
    canvas.width = std::clamp(kPlotWidth + kLetter * longest, canvas.width, 2 * canvas.width);
    canvas.height = std::clamp(kMargins + kLine * legend.size(), canvas.height, 8 * canvas.height);
    return canvas;
}

std::string svg_of(const Canvas& canvas) {
    return fmt::format(
        "set terminal svg noenhanced size {},{} background '#ffffff' font 'DejaVu "
        "Sans,Verdana,sans-serif,13'\n",
        canvas.width, canvas.height);
}

// Has twice the pixels of the SVG, for screens of high density.
std::string png_of(const Canvas& canvas) {
    return fmt::format(
        "set terminal pngcairo noenhanced size {},{} background '#ffffff' font 'DejaVu Sans,13' "
        "fontscale 2 linewidth 2 pointscale 2\n",
        2 * canvas.width, 2 * canvas.height);
}

// Quotes somebody's text for the script.
std::string text(std::string_view name) { return literal(printable(name)); }

// Quotes text below an axis, where gnuplot takes it for a format of numbers.
std::string tic(std::string_view name) {
    std::string format;
    for (const char c : printable(name)) format += c == '%' ? "%%" : std::string(1, c);
    return literal(format);
}

Status check_number(double value, const std::string& of) {
    if (std::isfinite(value)) return {};
    return fail("cannot draw '{}': {} is not a finite number", printable(of), value);
}

// The part of the script that all pictures share.
std::string frame(const std::string& title, const std::string& x_label, const std::string& y_label) {
    std::string script = "set encoding utf8\n";
    script += fmt::format("set border 3 linecolor rgb '{}' linewidth 1\n", kGrey);
    script += fmt::format("set tics nomirror out scale 0.5 textcolor rgb '{}'\n", kText);
    script += "set grid ytics back linecolor rgb '#dddddd' linetype 1 linewidth 0.7\n";
    script += "set key outside right top Left reverse samplen 2 spacing 1.3 width 1 noenhanced\n";
    script += fmt::format("set title {} textcolor rgb '{}'\n", text(title), kText);
    if (!x_label.empty()) script += fmt::format("set xlabel {} textcolor rgb '{}'\n", text(x_label), kText);
    script += fmt::format("set ylabel {} textcolor rgb '{}'\n", text(y_label), kText);
    return script + "set yrange [*<0:*]\n";
}

// Begins again after the last.
template <class T, std::size_t n>
const T& nth(const std::array<T, n>& of, std::size_t i) {
    return of[i % n];
}

std::string style_of(const Series& series, std::size_t place) {
    const std::size_t colour = series.colour.value_or(place);
    const std::string_view rgb = nth(kColours, colour);
    switch (series.style) {
        case Style::kLine:
            return fmt::format("with linespoints linecolor rgb '{}' linewidth 2 pointtype {} pointsize 0.7",
                               rgb, nth(kMarks, colour));
        case Style::kDashed:
            return fmt::format(
                "with linespoints linecolor rgb '{}' linewidth 2 dashtype (8,5) pointtype {} pointsize 0.7",
                rgb, nth(kMarks, colour));
        case Style::kBold:
            return fmt::format("with linespoints linecolor rgb '{}' linewidth 4 pointtype {} pointsize 1.4",
                               rgb, nth(kMarks, colour));
        case Style::kPoints:
            return fmt::format("with points linecolor rgb '{}' linewidth 1.5 pointtype {} pointsize 1.1", rgb,
                               nth(kOpenMarks, colour));
        case Style::kReference:
            break;
    }
    return fmt::format("with lines linecolor rgb '{}' linewidth 1 dashtype (4,4)", kGrey);
}

// Tics of the plot's own if it has some. Otherwise tics at the x of points, if these are few and far enough
// apart to be read; else gnuplot's.
std::string tics_of(const Plot& plot) {
    if (!plot.x_tics.empty()) {
        std::string tics;
        for (const auto& [place, label] : plot.x_tics)
            tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", tic(label), place);
        return fmt::format("set xtics ({})\n", tics);
    }
    constexpr double kClosest = 0.06;  // of the axis
    std::set<double> places;
    for (const Series& series : plot.series) {
        if (series.style == Style::kReference) continue;
        for (const auto& [x, y] : series.points) places.insert(plot.log2_x ? std::log2(x) : x);
    }
    if (places.empty()) return {};
    double before = plot.log2_x ? *places.begin() : 0;
    std::string tics;
    for (const double place : places) {
        const bool first = tics.empty();
        if (!(first && plot.log2_x) && place - before < kClosest * *places.rbegin()) return {};
        before = place;
        tics += fmt::format("{}{:g}", first ? "" : ", ", plot.log2_x ? std::exp2(place) : place);
    }
    return places.size() > 16 ? "" : fmt::format("set xtics ({})\n", tics);
}

Result<std::string> script_of(const Plot& plot) {
    std::string script = frame(plot.title, plot.x_label, plot.y_label);
    script +=
        plot.log2_x ? "set logscale x 2\nset offsets graph 0.02, graph 0.02, 0, 0\n" : "set xrange [*<0:*]\n";
    if (plot.log10_y) script += "set yrange [*:*]\nset logscale y 10\nset format y '%g'\n";
    std::string command;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const Series& series = plot.series[i];
        if (series.points.empty()) continue;
        script += fmt::format("$data{} << END\n", i);
        for (const auto& [x, y] : series.points) {
            for (const double value : {x, y}) SWATH_TRY_VOID(check_number(value, series.name));
            for (const auto& [value, logarithmic] : {std::pair{x, plot.log2_x}, std::pair{y, plot.log10_y}})
                if (logarithmic && value <= 0)
                    return fail("cannot draw '{}': {} is not on a logarithmic axis", printable(series.name),
                                value);
            script += fmt::format("{} {}\n", x, y);
        }
        script += "END\n";
        command += fmt::format("{} $data{} using 1:2 title {} {}", command.empty() ? "plot" : ",", i,
                               text(series.name), style_of(series, i));
    }
    if (command.empty()) return fail("nothing to draw in '{}'", printable(plot.title));
    return script + tics_of(plot) + command + '\n';
}

Result<std::string> script_of(const Bars& bars) {
    constexpr double kBar = 0.8;  // of a bar's share of the axis
    constexpr double kGap = 0.8;  // between groups
    std::string tics;
    std::string names;
    std::vector<std::string> boxes(bars.segments.size());
    double x = 0;
    bool has_stacks = false;
    const bool has_labels = std::ranges::any_of(bars.groups, [](const Bars::Group& group) {
        return std::ranges::any_of(group.bars, [](const Bars::Bar& bar) { return !bar.label.empty(); });
    });
    for (const Bars::Group& group : bars.groups) {
        const double centre = x + (static_cast<double>(group.bars.size()) - 1) / 2;
        if (has_labels)
            names += fmt::format("set label {} at first {}, graph -0.11 center textcolor rgb '{}'\n",
                                 text(group.name), centre, kText);
        else
            tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", tic(group.name), centre);
        for (const Bars::Bar& bar : group.bars) {
            CHECK(bar.values.size() == bars.segments.size());
            double bottom = 0;
            for (std::size_t i = 0; i < bar.values.size(); ++i) {
                SWATH_TRY_VOID(check_number(bar.values[i], bars.segments[i]));
                if (bar.values[i] < 0)
                    return fail("cannot draw '{}': {} is less than 0", printable(bars.segments[i]),
                                bar.values[i]);
                const double top = bottom + bar.values[i];
                has_stacks |= top > bottom && bottom > 0;
                if (top > bottom)
                    boxes[i] += fmt::format("{} {} {} {} {} {}\n", x, bottom, x - kBar / 2, x + kBar / 2,
                                            bottom, top);
                bottom = top;
            }
            if (has_labels) tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", tic(bar.label), x);
            x += 1;
        }
        x += kGap;
    }
    std::string script = frame(bars.title, "", bars.y_label);
    if (has_stacks) script += "set key invert\n";  // the topmost segment comes first, as in the bars
    script += fmt::format("set xrange [{}:{}]\n", -kGap, x - 1);
    script += fmt::format("set xtics scale 0 ({})\n", tics) + names;
    if (has_labels) script += "set bmargin 4\n";
    script += "set style fill solid 1 noborder\n";
    std::string command;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].empty()) continue;
        script += fmt::format("$data{} << END\n{}END\n", i, boxes[i]);
        command += fmt::format("{} $data{} using 1:2:3:4:5:6 title {} with boxxyerror linecolor rgb '{}'",
                               command.empty() ? "plot" : ",", i, text(bars.segments[i]), nth(kColours, i));
    }
    if (command.empty()) return fail("nothing to draw in '{}'", printable(bars.title));
    return script + command + '\n';
}

Status draw_both(const std::string& script, const std::vector<std::string>& legend,
                 const std::filesystem::path& stem) {
    const Canvas canvas = canvas_for(legend);
    for (const auto& [terminal, suffix] :
         {std::pair{svg_of(canvas), ".svg"}, std::pair{png_of(canvas), ".png"}}) {
        const std::string file = stem.string() + suffix;
        const Result<Buffer> picture = run_gnuplot(terminal + script);
        if (!picture) return fail_in(file, picture.error());
        SWATH_TRY_VOID(write_file(file, picture->bytes()));
    }
    return {};
}

}  // namespace

Status draw(const Plot& plot, const std::filesystem::path& stem) {
    std::vector<std::string> legend;
    for (const Series& series : plot.series) legend.push_back(printable(series.name));
    SWATH_TRY(const std::string script, script_of(plot));
    return draw_both(script, legend, stem);
}

Status draw(const Bars& bars, const std::filesystem::path& stem) {
    std::vector<std::string> legend;
    for (const std::string& segment : bars.segments) legend.push_back(printable(segment));
    SWATH_TRY(const std::string script, script_of(bars));
    return draw_both(script, legend, stem);
}

}  // namespace swath::sim
