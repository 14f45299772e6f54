#include "common/published/resource/resource_space.h"

#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 32;

}  // namespace

Result<ResourceSpace> ResourceSpace::make(std::span<const std::uint64_t> sizes) {
    if (sizes.empty()) return fail("resource space: there must be at least one dimension");
    std::uint64_t points = 1;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] == 0)
            return fail("resource space: dimension {} has no resources; at least 1 is needed", i);
        if (sizes[i] > kMaxPoints / points)
            return fail("resource space: with dimension {} (of {}) there are more than {} points", i,
                        sizes[i], kMaxPoints);
        points *= sizes[i];
    }
    return ResourceSpace(sizes, points);
}

Result<std::uint32_t> ResourceSpace::key(std::span<const std::uint32_t> coordinates) const {
    if (coordinates.size() != dimensions())
        return fail("resource space: {} coordinates for {} dimensions", coordinates.size(), dimensions());
    std::uint64_t key = 0;
    for (std::size_t i = 0; i < dimensions(); ++i) {
        if (coordinates[i] >= sizes_[i])
            return fail("resource space: coordinate {} in dimension {}, which has {} resources",
                        coordinates[i], i, sizes_[i]);
        key = key * sizes_[i] + coordinates[i];
    }
    return static_cast<std::uint32_t>(key);
}

std::vector<std::uint32_t> ResourceSpace::coordinates(std::uint32_t key) const {
    CHECK(std::uint64_t{key} < points_);
    std::vector<std::uint32_t> coordinates(dimensions());
    std::uint64_t left = key;
    for (std::size_t i = dimensions(); i-- > 0;) {
        coordinates[i] = static_cast<std::uint32_t>(left % sizes_[i]);
        left /= sizes_[i];
    }
    return coordinates;
}

}  // namespace swath
