#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/result.h"

namespace swath::sim {

enum class Style {
    kLine,       // with marks
    kDashed,     // with marks, dashed
    kBold,       // with large marks and thick, for what the others are compared with
    kPoints,     // marks without a line, for others' figures beside ours
    kReference,  // thin, grey and dashed, for an ideal
};

struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  // axes begin at 0 unless a value is negative
    Style style = Style::kLine;
    std::optional<std::size_t> colour = std::nullopt;  // series of one number match; none: by position
};

// Curves over a common axis. Names and labels are text, never markup.
struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    bool log2_x = false;  // as in the papers' figures over servers; x must be more than 0
    std::vector<Series> series;
    bool log10_y = false;                                     // y must be more than 0
    std::vector<std::pair<double, std::string>> x_tics = {};  // x and text, for numbers too long to read
};

// Stacked bars, in groups along the axis. Bars side by side are stacks with a single segment above 0.
struct Bars {
    struct Bar {
        std::string label;           // below the bar; may be empty
        std::vector<double> values;  // by segment, from the bottom up; not negative
    };
    struct Group {
        std::string name;
        std::vector<Bar> bars;
    };
    std::string title;
    std::string y_label;
    std::vector<std::string> segments;
    std::vector<Group> groups;
};

// Draws STEM.svg and STEM.png with the program gnuplot; the same input and version of gnuplot give the same
// bytes. Errors: nothing to draw, a number that cannot be drawn (named), gnuplot missing or failed, a file
// that cannot be written.
Status draw(const Plot& plot, const std::filesystem::path& stem);
Status draw(const Bars& bars, const std::filesystem::path& stem);

}  // namespace swath::sim
