#pragma once
#include <cstddef>
#include <cstdint>

namespace swath {

// How SAH trees are built. The bins are those of the SAH octree paper, section 4.1, after Günther and others
// 2007.
struct SahSettings {
    // A node of n triangles is sampled at n / bin_ratio places an axis, at least min_bins and at most
    // max_bins.
    std::uint32_t min_bins = 8;    // at least 2
    std::uint32_t max_bins = 128;  // at most kMaxBins
    std::uint32_t bin_ratio = 6;   // at least 1
    // Nodes of at most so many triangles become kd-trees (0: never).
    std::uint32_t kd_triangles = 256;
    // Nodes of at most so many triangles are finished by one thread, larger ones are shared out; at least
    // kd_triangles. 0 is for as many as fit: a 64th of all, 2,048 to kMaxGrain. Trees of different grains
    // differ in the order of nodes only.
    std::uint32_t grain = 0;
    // An octree node is cut along an axis only where that gains at least so much of what the best axis gains:
    // 0 for always, 1 for the best one only. (The paper has always: in scenes of flat, unlike parts that
    // costs a fifth of a tree's worth.)
    float least_gain = 0.7f;
    // Whether the places beside the best sample are looked at, too, where a box ends or begins: a pass more.
    bool refine = true;
    // Of visiting a node and of testing a triangle; only their ratio counts.
    float traversal_cost = 3.0f;
    float intersection_cost = 1.0f;
    // A triangle that crosses planes stands in several leaves. All leaves together have at most so many times
    // as many triangles as there are, an empty one counting as having one; what would need more is not cut.
    std::uint32_t max_duplication = 4;  // at least 1
    // The most memory that building may take, the tree included.
    std::size_t max_bytes = std::size_t{64} << 30;
    bool operator==(const SahSettings&) const = default;
};
inline constexpr std::uint32_t kMaxBins = 256;
inline constexpr std::uint32_t kMaxGrain = 1u << 14;
inline constexpr float kMaxSahCoordinate = 1e18f;  // its square times a number of triangles is still a float

// The paper's two settings. The fast one also makes larger leaves.
inline constexpr SahSettings kDefaultSah{};
inline constexpr SahSettings kFastSah{.min_bins = 4,
                                      .max_bins = 32,
                                      .bin_ratio = 16,
                                      .kd_triangles = 32,
                                      .least_gain = 0.0f,
                                      .refine = false,
                                      .traversal_cost = 20.0f,
                                      .max_duplication = 2};

}  // namespace swath
