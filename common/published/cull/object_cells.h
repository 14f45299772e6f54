#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/frustum.h"
#include "common/published/cull/walk_table.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// Objects in the leaves of a uniform octree, so that the published algorithms can cull them: the papers say
// only that objects "can be stored on the leaves". The tree's coordinates are in leaf edges. Frusta are
// transformed and boxes are not, so that walks are exact in the tree and objects are tested exactly outside.
// A cell holds boxes that reach up to half a leaf edge beyond it. Boxes that reach farther, or are not
// finite, lie in no cell and must be tested one by one.
class ObjectCells {
  public:
    // Copies the boxes. At most 2^31.
    explicit ObjectCells(std::span<const Box> boxes);

    const UniformOctree& shape() const { return shape_; }
    // A frustum in the tree's coordinates, wider by half a leaf edge and by what rounding may do: a leaf with
    // a box that is not outside of `frustum` is not outside of it.
    Frustum loosened(const Frustum& frustum) const;

    // The boxes by leaf. Ids are indices into the constructor's boxes.
    CellBoxes cells() const { return {first_.data(), boxes_.data(), ids_.data()}; }
    std::size_t box_count() const { return ids_.size(); }
    // Boxes in no cell come last, from this index on.
    std::size_t first_of_no_cell() const { return first_.back(); }

  private:
    UniformOctree shape_{0};
    glm::dvec3 origin_{0};
    double leaf_edge_ = 1;
    glm::dvec3 reach_{0};  // the largest coordinates, as magnitudes, of boxes in cells
    std::vector<std::uint32_t> first_;
    std::vector<WalkBox> boxes_;
    std::vector<std::uint32_t> ids_;
};

}  // namespace swath
