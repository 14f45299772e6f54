#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/plot/plot.h"

namespace swath::bench {

// Draws STEM.svg and STEM.png, and writes STEM.csv: a line for each x, a column for each series.
Status draw_with_csv(const sim::Plot& plot, const std::filesystem::path& stem);
// The same for bars side by side, one segment each: a line for each group, a column for each segment.
Status draw_with_csv(const sim::Bars& bars, const std::filesystem::path& stem);

// Writes a number in short: "585", "4.7k", "37k", "2.4M".
std::string short_number(std::uint64_t number);

}  // namespace swath::bench
