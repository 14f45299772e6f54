#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/base/result.h"

namespace swath::sim {

// Speed-ups over the number of servers: simulated, published or measured.
struct Curve {
    std::string label;  // of the input that it is from
    std::string name;  // "hybrid, buddha, full mode"; the label's where it has only one, a run of the cluster
    std::vector<std::pair<std::size_t, double>> points;  // (servers, speed-up), ascending
    bool operator==(const Curve&) const = default;
};

// Each input is "[LABEL=]FILE"; without a label the file's name without suffix. A FILE is
//   a table of a study or of ../published: each algorithm and model with a column `speedup` is a curve, and
//   with `full_speedup` another, which is the one to hold against the real cluster;
//   a timeline, as `swath-client --timeline FILE.csv` writes: all of a label make one curve, by the frames a
//   second of one server (or --single), whose timeline must be among them. A table's speed-ups are over one
//   server that only draws, which --single is nearer to.
// Curves are in the order of the inputs. Errors name the file, and the line or what it lacks.
Result<std::vector<Curve>> read_curves(std::span<const std::string> inputs);

// compare.csv (in the tables' schema, so that it can be an input), compare.svg and compare.png into the
// folder, which is made. Curves of one name have one colour; each label has its own way of drawing.
Status write_comparison(std::span<const Curve> curves, const std::filesystem::path& folder);

}  // namespace swath::sim
