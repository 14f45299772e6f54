#include "common/published/cull/object_octree.h"

#include <algorithm>

#include "common/published/cull/cell_order.h"
#include "common/published/cull/walks.h"

namespace swath {

// Makes nodes depth first. Nodes must not move, so room for all is reserved before.
struct ObjectOctree::Build {
    std::span<const MortonKey> placed;
    std::span<const WalkBox> boxes;
    int height;
    std::vector<BoxNode>& nodes;

    // Makes the node of the entries `first` to `last`, at least one, which are those of one cell on `level`.
    const BoxNode* node(std::uint32_t first, std::uint32_t last, int level) {
        BoxNode& made = nodes.emplace_back();
        Box around;
        if (level == height) {
            made.first = first;
            made.count = last - first;
            for (std::uint32_t i = first; i < last; ++i) extend(around, boxes[i].numbers);
        } else {
            const int shift = 3 * (UniformOctree::kMaxHeight - level - 1);
            std::size_t children = 0;
            for (std::uint32_t begin = first; begin < last;) {
                const std::uint32_t cell = placed[begin].code >> shift;
                std::uint32_t end = begin + 1;
                while (end < last && placed[end].code >> shift == cell) ++end;
                made.children[children] = node(begin, end, level + 1);
                extend(around, made.children[children++]->box);
                begin = end;
            }
        }
        std::ranges::copy(walk_box(around).numbers, made.box);
        return &made;
    }

    static void extend(Box& around, const float* box) {
        around.extend(glm::vec3(box[0], box[1], box[2]));
        around.extend(glm::vec3(box[3], box[4], box[5]));
    }
};

ObjectOctree::ObjectOctree(std::span<const Box> boxes, double boxes_per_leaf) {
    const CellOrder order = cell_order(boxes);
    boxes_.reserve(boxes.size());
    ids_.reserve(boxes.size());
    for (const MortonKey& entry : order.placed) ids_.push_back(entry.index);
    ids_.insert(ids_.end(), order.unplaced.begin(), order.unplaced.end());
    for (const std::uint32_t id : ids_) boxes_.push_back(walk_box(boxes[id]));
    in_leaves_ = order.placed.size();
    if (in_leaves_ == 0) return;

    height_ = order.height_for(boxes_per_leaf, UniformOctree::kMaxHeight);
    std::size_t count = 0;
    for (int level = 0; level <= height_; ++level) count += order.occupied[static_cast<std::size_t>(level)];
    nodes_.reserve(count);
    Build{order.placed, boxes_, height_, nodes_}.node(0, static_cast<std::uint32_t>(in_leaves_), 0);
}

std::span<const std::uint32_t> ObjectOctree::cull(const Frustum& frustum) {
    const WalkPlanes planes = walk_planes(frustum);
    const WalkTable& walks = best_walk_table();
    visible_->size = 0;
    if (!nodes_.empty()) walks.cull_tree(planes, contents_of_leaves(), nodes_.front(), *visible_);
    walks.cull_boxes(planes, contents_of_leaves(), in_leaves_, ids_.size(), *visible_);
    return contents(*visible_);
}

}  // namespace swath
