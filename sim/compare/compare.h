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

// Writes compare.csv (in the tables' schema, so that it can be an input), compare.svg and compare.png into
// the folder, which it makes. Curves of one name have one colour; each label has its own style.
Status write_comparison(std::span<const Curve> curves, const std::filesystem::path& folder);

}  // namespace swath::sim
