#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.h"

namespace swath {

// A space whose points are combinations of resources: it has a dimension for each kind of resource (shader,
// texture, mesh, ...) and a coordinate for each resource of that kind (ADSB, section 8.2; A2SSB, section 3.10
// b). A point's key is its number if the last dimension counts fastest, so ascending keys change the first
// dimension's resource least often: put first what is dearest to change. A value.
class ResourceSpace {
  public:
    // Fails unless there is a dimension, each has a resource, and there are at most 2^32 points in all.
    static Result<ResourceSpace> make(std::span<const std::uint64_t> sizes);

    std::size_t dimensions() const { return sizes_.size(); }
    std::span<const std::uint64_t> sizes() const { return sizes_; }
    std::uint64_t points() const { return points_; }

    // Fails if there are not as many coordinates as dimensions, or one is not below its dimension's size.
    Result<std::uint32_t> key(std::span<const std::uint32_t> coordinates) const;
    // The inverse of key(). `key` must be below points().
    std::vector<std::uint32_t> coordinates(std::uint32_t key) const;

    bool operator==(const ResourceSpace&) const = default;

  private:
    ResourceSpace(std::span<const std::uint64_t> sizes, std::uint64_t points)
        : sizes_(sizes.begin(), sizes.end()), points_(points) {}

    std::vector<std::uint64_t> sizes_;
    std::uint64_t points_;
};

}  // namespace swath
