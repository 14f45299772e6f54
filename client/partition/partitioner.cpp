#include "client/partition/partitioner.h"

#include <array>

#include "client/partition/hybrid.h"
#include "client/partition/kd_split.h"
#include "client/partition/mahd.h"
#include "client/partition/sort_last.h"
#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::array kAlgorithms{Algorithm::kHybrid, Algorithm::kMahd, Algorithm::kKdSplit,
                                 Algorithm::kSortLast};

}  // namespace

std::span<const Algorithm> all_algorithms() { return kAlgorithms; }

std::string_view name_of(Algorithm algorithm) {
    switch (algorithm) {
        case Algorithm::kHybrid:
            return "hybrid";
        case Algorithm::kMahd:
            return "mahd";
        case Algorithm::kKdSplit:
            return "kd-split";
        case Algorithm::kSortLast:
            return "sort-last";
    }
    throw CheckFailed("algorithm without a name");
}

Grouping grouping_of(Algorithm algorithm) {
    switch (algorithm) {
        case Algorithm::kHybrid:
        case Algorithm::kSortLast:
            return Grouping::kExactlyOnce;
        case Algorithm::kMahd:
        case Algorithm::kKdSplit:
            return Grouping::kAtLeastOnce;
    }
    throw CheckFailed("algorithm without a grouping");
}

std::string algorithm_names() {
    std::string names;
    for (const Algorithm algorithm : kAlgorithms)
        names += (names.empty() ? "" : ", ") + std::string(name_of(algorithm));
    return names;
}

Result<Algorithm> parse_algorithm(std::string_view name) {
    for (const Algorithm algorithm : kAlgorithms)
        if (name_of(algorithm) == name) return algorithm;
    return fail("algorithm '{}' is not known; there are: {}", name, algorithm_names());
}

std::unique_ptr<Partitioner> make_partitioner(Algorithm algorithm, std::span<const Object> objects) {
    switch (algorithm) {
        case Algorithm::kHybrid:
            return std::make_unique<Hybrid>();
        case Algorithm::kMahd:
            return std::make_unique<Mahd>();
        case Algorithm::kKdSplit:
            return std::make_unique<KdSplit>();
        case Algorithm::kSortLast:
            return std::make_unique<SortLast>(objects);
    }
    throw CheckFailed("algorithm without a partitioner");
}

}  // namespace swath
