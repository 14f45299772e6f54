#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/base/result.h"

namespace swath::sim {

// Speed-ups by number of servers: simulated, published or measured.
struct Curve {
    std::string label;  // the input's
    std::string name;   // "hybrid, buddha, full mode"; for a run of the cluster, the label
    std::vector<std::pair<std::size_t, double>> points;  // (servers, speed-up), ascending
    bool measured = false;                               // a run of the cluster
    bool operator==(const Curve&) const = default;
};

// Reads inputs of the form "[LABEL=]FILE"; the default label is the file's name without suffix. A FILE is
//   a table of a study or of ../published: each algorithm and model with a column `speedup` is a curve, and
//     each with `full_speedup` is another, which is the one to hold against the real cluster; or
//   a timeline, as `swath-client --timeline FILE.csv` writes: all of one label make one curve. It is relative
//     to the frames a second of one server (or --single), whose timeline must be among them. A table is
//     relative to one server that only draws; --single is nearer to that.
// Curves are in the order of the inputs. Errors name the file, and the line or what the file lacks.
Result<std::vector<Curve>> read_curves(std::span<const std::string> inputs);

// Returns the curves that a chart has room for, in their order. Without measured ones these are all. Beside
// measured ones they go up to twice the measured servers, of a label with full mode only that is taken, because
// a real run has all stages, and the six nearest to a measured one stay.
std::vector<Curve> worth_drawing(std::span<const Curve> curves);

// Writes compare.csv with all curves (in the tables' schema, so that it can be an input), and compare.svg and
// compare.png with those worth drawing into the folder, which it makes. Measured curves are thick and black.
// Of the others, curves of one name have one colour, and each label has its own style.
Status write_comparison(std::span<const Curve> curves, const std::filesystem::path& folder);

// Returns the curves worth drawing as a table of numbers, a line each.
std::string to_text(std::span<const Curve> curves);

}  // namespace swath::sim
