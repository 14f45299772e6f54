#include "client/partition/partitioner.h"

#include <array>
#include <string>

#include "client/partition/hybrid.h"
#include "client/partition/sort_last.h"
#include "common/base/check.h"

namespace swath {
namespace {

struct Entry {
    Algorithm algorithm;
    std::string_view name;
    Grouping grouping;
};
constexpr std::array kAlgorithms{
    Entry{Algorithm::kHybrid, "hybrid", Grouping::kExactlyOnce},
    Entry{Algorithm::kSortLast, "sort-last", Grouping::kExactlyOnce},
};

const Entry& entry_of(Algorithm algorithm) {
    for (const Entry& entry : kAlgorithms)
        if (entry.algorithm == algorithm) return entry;
    throw CheckFailed("algorithm without an entry");
}

}  // namespace

std::string_view name_of(Algorithm algorithm) { return entry_of(algorithm).name; }

Grouping grouping_of(Algorithm algorithm) { return entry_of(algorithm).grouping; }

Result<Algorithm> parse_algorithm(std::string_view name) {
    std::string known;
    for (const Entry& entry : kAlgorithms) {
        if (entry.name == name) return entry.algorithm;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    return fail("algorithm '{}' is not known; there are: {}", name, known);
}

std::unique_ptr<Partitioner> make_partitioner(Algorithm algorithm, std::span<const Object> objects) {
    switch (algorithm) {
        case Algorithm::kHybrid:
            return std::make_unique<Hybrid>();
        case Algorithm::kSortLast:
            return std::make_unique<SortLast>(objects);
    }
    throw CheckFailed("algorithm without a partitioner");
}

}  // namespace swath
