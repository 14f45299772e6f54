#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/base/result.h"
#include "common/base/thread_team.h"
#include "common/geometry/box.h"
#include "common/geometry/frustum.h"

namespace swath {

// Finds which of a fixed set of boxes may be seen. Whatever the algorithm, the answer is the same: all boxes
// that are not outside(frustum, box), ascending. One thread at a time; the ThreadTeam it was made with must
// outlive it and be idle when it is called.
class Culler {
  public:
    virtual ~Culler() = default;
    // Indices of the boxes, ascending. The span is valid until the next call.
    virtual std::span<const std::uint32_t> cull(const Frustum& frustum) = 0;
    // The level of the octree at which the last call shared out its work, of algorithms that have one.
    virtual std::optional<int> split_level() const { return std::nullopt; }
};

enum class CullAlgorithm {
    kWide,   // the best we know: a hierarchy of 16 children a node, tested at once
    kA2ssb,  // adaptive two-step static balancing over a uniform octree
    kAdsb,   // adaptive delayed static balancing over a uniform octree
    kNone,   // everything may be seen
};

// "wide", "a2ssb", "adsb", "none".
std::string_view name_of(CullAlgorithm algorithm);
std::string cull_algorithm_names();  // with commas between
Result<CullAlgorithm> parse_cull_algorithm(std::string_view name);

// Copies what it needs of `boxes`, which should come in an order in which neighbours are near (as leaves of
// an ObjectSet do): any order is right, but a bad one is slow. At most 2^31 boxes.
std::unique_ptr<Culler> make_culler(CullAlgorithm algorithm, std::span<const Box> boxes, ThreadTeam& team);

}  // namespace swath
