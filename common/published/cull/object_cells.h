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
// only that objects "can be stored on the leaves". The tree's frame is in leaf edges; boxes stay as they are
// and frusta come into the frame, so that walks are exact there and objects are tested exactly here. A cell
// reaches half a leaf edge beyond itself. Boxes that reach beyond even that, or are not finite, lie in no
// cell: they are to be tested one by one.
class ObjectCells {
  public:
    // Copies the boxes. At most 2^31.
    explicit ObjectCells(std::span<const Box> boxes);

    const UniformOctree& shape() const { return shape_; }
    // A frustum in the tree's coordinates that no leaf is outside of if `frustum` leaves any of its boxes:
    // half a leaf edge wider, and wider by what rounding may do.
    Frustum loosened(const Frustum& frustum) const;

    // Boxes by leaf; ids are indices into what the constructor got.
    CellBoxes cells() const { return {first_.data(), boxes_.data(), ids_.data()}; }
    std::size_t box_count() const { return ids_.size(); }
    // Boxes of no cell are the last ones, from this one on.
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
