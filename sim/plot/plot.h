#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/result.h"

namespace swath::sim {

enum class Style {
    kLine,       // with a mark at every point
    kDashed,     // the same, dashed
    kPoints,     // marks alone: somebody else's figures beside our line
    kReference,  // thin, grey and dashed: an ideal
};

struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  // axes begin at 0 where none is less
    Style style = Style::kLine;
    std::optional<std::size_t> colour = std::nullopt;  // series of one number match; without: its place
};

// Curves over a common axis. Names and labels are text, never markup.
struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    bool log2_x = false;  // as in the papers' figures over the number of servers; x is then more than 0
    std::vector<Series> series;
    bool log10_y = false;                                     // y is then more than 0
    std::vector<std::pair<double, std::string>> x_tics = {};  // place and text, for numbers too long to read
};

// Stacked bars, in groups along the axis. Bars that stand side by side, one segment each, are stacks whose
// other segments are 0.
struct Bars {
    struct Bar {
        std::string label;           // below it; may be empty
        std::vector<double> values;  // by segment, from the bottom up; 0 or more
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

// Draws into STEM.svg and STEM.png with the program gnuplot; the same bytes for the same input and version of
// it. Errors: there is nothing to draw, a number that cannot be drawn (named), gnuplot is not installed or
// failed, or a file cannot be written.
Status draw(const Plot& plot, const std::filesystem::path& stem);
Status draw(const Bars& bars, const std::filesystem::path& stem);

}  // namespace swath::sim
