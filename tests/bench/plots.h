#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/plot/plot.h"

namespace swath::bench {

// STEM.svg, STEM.png and STEM.csv: a line for each place, a column for each series.
Status draw_with_csv(const sim::Plot& plot, const std::filesystem::path& stem);
// ... of bars that stand side by side, one segment each: a line for each group, a column for each segment.
Status draw_with_csv(const sim::Bars& bars, const std::filesystem::path& stem);

// "585", "4.7k", "37k", "2.4M".
std::string short_number(std::uint64_t number);

}  // namespace swath::bench
