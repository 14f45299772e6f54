#include "client/partition/partitioner.h"

#include "client/partition/hybrid.h"
#include "client/partition/kd_split.h"
#include "client/partition/mahd.h"
#include "client/partition/sort_last.h"
#include "common/base/check.h"

namespace swath {
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
