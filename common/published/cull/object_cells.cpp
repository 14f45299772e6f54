#include "common/published/cull/object_cells.h"

#include <algorithm>
#include <cmath>

#include "common/published/cull/cell_order.h"
#include "common/published/cull/walks.h"

namespace swath {
namespace {

// A leaf costs a test, like a box, so a tree with more leaves than boxes is not worth its walk.
constexpr double kBoxesPerLeaf = 4;
constexpr int kHighest = 7;  // 8 MB of table
constexpr std::size_t kLeavesPerBox = 2;
// Boxes in no cell cost a test each in every frame.
constexpr std::size_t kMostOfNoCellInverse = 16;

// The part of a plane expression that single precision may lose, relative to the sum of its terms, as in
// frustum.cpp. kTiny is for numbers so small that they lose more.
constexpr double kFloatLoss = 1e-6;
constexpr double kTiny = 1e-38;
// Single precision may overflow beyond this.
constexpr double kHuge = 1e37;

int height_of(const CellOrder& order) {
    int highest = kHighest;
    while (highest > 0 && UniformOctree(highest).leaf_count() > kLeavesPerBox * order.placed.size())
        --highest;
    return order.height_for(kBoxesPerLeaf, highest);
}

// True if a box lies in its cell, made half an edge larger all around.
bool fits(const Box& box, const OctreeCell& cell, const glm::dvec3& origin, double edge) {
    const glm::dvec3 centre = origin + edge * (glm::dvec3(cell.x, cell.y, cell.z) + 0.5);
    const glm::dvec3 reach =
        glm::max(glm::abs(glm::dvec3(box.min) - centre), glm::abs(glm::dvec3(box.max) - centre));
    return std::max({reach.x, reach.y, reach.z}) <= edge;
}

}  // namespace

ObjectCells::ObjectCells(std::span<const Box> boxes) {
    const CellOrder order = cell_order(boxes);
    origin_ = order.origin;
    std::vector<MortonKey> inside;
    std::vector<std::uint32_t> outside_of_cells;
    for (int height = height_of(order);; --height) {
        shape_ = UniformOctree(height);
        leaf_edge_ = order.side / static_cast<double>(1u << height);
        inside.clear();
        outside_of_cells = order.unplaced;
        for (MortonKey entry : order.placed) {
            entry.code >>= 3 * (UniformOctree::kMaxHeight - height);
            if (fits(boxes[entry.index], octree_cell(entry.code), origin_, leaf_edge_))
                inside.push_back(entry);
            else
                outside_of_cells.push_back(entry.index);
        }
        if (height == 0 || outside_of_cells.size() * kMostOfNoCellInverse <= boxes.size()) break;
    }

    const auto add = [&](std::uint32_t box) {
        boxes_.push_back(walk_box(boxes[box]));
        ids_.push_back(box);
    };
    boxes_.reserve(boxes.size());
    ids_.reserve(boxes.size());
    first_.assign(shape_.leaf_count() + std::size_t{1}, 0);
    for (const MortonKey& entry : inside) {
        ++first_[entry.code + std::size_t{1}];
        const Box& box = boxes[entry.index];
        reach_ = glm::max(reach_, glm::max(glm::abs(glm::dvec3(box.min)), glm::abs(glm::dvec3(box.max))));
        add(entry.index);
    }
    for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    for (const std::uint32_t box : outside_of_cells) add(box);
}

Frustum ObjectCells::loosened(const Frustum& frustum) const {
    Frustum result;
    for (std::size_t i = 0; i < frustum.planes.size(); ++i) {
        // A point is origin + edge * (the point in the tree's coordinates).
        const glm::dvec3 normal(frustum.planes[i]);
        const double distance = frustum.planes[i].w;
        const glm::dvec3 in_tree = leaf_edge_ * normal;
        const double steepness = std::abs(in_tree.x) + std::abs(in_tree.y) + std::abs(in_tree.z);
        const double at_origin = glm::dot(normal, origin_) + distance;
        // The sums of terms of the two expressions, the boxes' and the cells'.
        const double of_boxes = glm::dot(glm::abs(normal), reach_) + std::abs(distance);
        const double of_cells = steepness * (shape_.edge() + 1) + std::abs(at_origin);
        const double moved = at_origin + 0.5 * steepness + kFloatLoss * (of_boxes + of_cells) + kTiny;
        const bool safe = of_boxes < kHuge && of_cells < kHuge;  // false if not a number
        result.planes[i] = safe ? glm::vec4(in_tree, moved) : glm::vec4(0, 0, 0, 1);
    }
    return result;
}

}  // namespace swath
