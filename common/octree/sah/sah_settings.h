#pragma once
#include <cstddef>
#include <cstdint>

namespace swath {

// The settings of an SAH build. Bins are as in section 4.1 of the SAH octree paper (Günther and others 2007).
struct SahSettings {
    // A node of n triangles has n / bin_ratio bins an axis, at least min_bins and at most max_bins.
    std::uint32_t min_bins = 8;    // at least 2
    std::uint32_t max_bins = 128;  // at most kMaxBins
    std::uint32_t bin_ratio = 6;   // at least 1
    // Nodes of at most so many triangles become kd-trees (0: never).
    std::uint32_t kd_triangles = 256;
    // One thread builds all below a node of at most so many triangles; threads share larger nodes. At least
    // kd_triangles. 0 stands for a 64th of all triangles, 2,048 to kMaxGrain. Trees of different grains
    // differ in the order of nodes only.
    std::uint32_t grain = 0;
    // An octree node is cut across an axis only if that gains at least this part of what the best axis gains:
    // 0 for always, 1 for the best one only. (The paper has 0, which makes trees a fifth worse in scenes of
    // flat, unlike parts.)
    float least_gain = 0.7f;
    // Whether the sides of boxes beside the best sample are tried too, which takes one more pass.
    bool refine = true;
    // The costs of visiting a node and of testing a triangle. Only their ratio counts.
    float traversal_cost = 3.0f;
    float intersection_cost = 1.0f;
    // A triangle that crosses planes stands in several leaves. All leaves together have at most this many
    // times the triangles that there are, an empty leaf counting as having one. A node that would need more
    // is not cut.
    std::uint32_t max_duplication = 4;  // at least 1
    // The most memory that a build may take, the tree included.
    std::size_t max_bytes = std::size_t{64} << 30;
    bool operator==(const SahSettings&) const = default;
};
// The most cuts on a path from the root; an octree node counts as one.
inline constexpr std::uint32_t kMaxSahDepth = 48;
inline constexpr std::uint32_t kMaxBins = 256;
inline constexpr std::uint32_t kMaxGrain = 1u << 14;
inline constexpr float kMaxSahCoordinate = 1e18f;  // so that its square times a number of triangles is finite

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
