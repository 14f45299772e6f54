#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/base/thread_team.h"
#include "common/octree/sah/sah_builder.h"
#include "common/raycast/packet_kernel.h"
#include "common/scene/objects.h"
#include "common/scene/triangle_range.h"

namespace swath {

// The triangles of a model, with a tree over all or some of them for rays. Coordinates are scaled by a power
// of two to at most 1. The thread that makes it also builds and selects, with its team; any thread may cast.
class CastScene {
  public:
    // `scene` and `team` must outlive it.
    CastScene(const ObjectSet& scene, ThreadTeam& team, SahDevice device);

    float scale() const { return scale_; }
    const SahBuilder& builder() const { return builder_; }
    const SahTree& tree() const { return tree_; }

    // Moves the triangles to a pose, which is 0 at first. Build a tree anew after that.
    void pose(float pose);

    // Builds a tree over all triangles.
    Status build_all(const SahSettings& settings);
    // Builds a tree over the triangles of `ranges` only, of which there must be one.
    Status build(std::span<const TriangleRange> ranges, const SahSettings& settings);

    // Limits what rays find in wanted() to the triangles of `ranges`, which the tree must have.
    void want(std::span<const TriangleRange> ranges);
    KernelTree wanted() const;
    // Rays find all of the tree's triangles in this.
    KernelTree all() const;

    glm::vec3 corner(std::uint32_t triangle, int number) const;  // scaled

  private:
    void move();
    // A bit for each of the 32 nodes from 32 * word on, set for leaves with a wanted triangle.
    std::uint32_t wanted_leaves(std::size_t word) const;

    const ObjectSet& scene_;
    ThreadTeam& team_;
    SahBuilder builder_;
    float scale_ = 1;
    float pose_ = 0;
    std::vector<glm::vec3> positions_;
    std::vector<float> corners_;
    SahTree tree_;
    bool want_all_ = true;
    std::vector<std::uint32_t> wanted_triangles_;  // a bit each
    std::vector<std::uint32_t> wanted_nodes_;
    std::vector<std::uint32_t> run_indices_;  // of build(), kept for their memory
    std::vector<std::uint32_t> run_triangles_;
};

}  // namespace swath
