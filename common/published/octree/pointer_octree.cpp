#include "common/published/octree/pointer_octree.h"

#include <numeric>
#include <random>

#include "common/base/check.h"

namespace swath {
namespace {

// Hands out indices of the array in the wished order.
class Places {
  public:
    Places(const UniformOctree& shape, AllocationOrder order, std::uint64_t seed) : order_(order) {
        if (order_ != AllocationOrder::kRandom) return;
        shuffled_.resize(shape.node_count());
        std::iota(shuffled_.begin(), shuffled_.end(), 0u);
        std::mt19937_64 random(seed);
        for (std::size_t i = shuffled_.size(); i > 1; --i)
            std::swap(shuffled_[i - 1], shuffled_[random() % i]);
    }

    // Call it in depth-first order.
    std::size_t next(int level, std::uint32_t code) {
        switch (order_) {
            case AllocationOrder::kDepthFirst:
                return handed_out_++;
            case AllocationOrder::kRandom:
                return shuffled_[handed_out_++];
            case AllocationOrder::kBreadthFirst:
                break;
        }
        return level == 0 ? 0 : UniformOctree(level - 1).node_count() + code;
    }

  private:
    AllocationOrder order_;
    std::vector<std::uint32_t> shuffled_;
    std::size_t handed_out_ = 0;
};

const OctreeNode* build(const UniformOctree& shape, int level, std::uint32_t code, Places& places,
                        std::vector<OctreeNode>& nodes) {
    OctreeNode& node = nodes[places.next(level, code)];
    const Box box = shape.box_of(level, code);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        node.box[axis] = box.min[axis];
        node.box[axis + 3] = box.max[axis];
    }
    node.code = code;
    node.level = static_cast<std::uint32_t>(level);
    for (std::uint32_t child = 0; child < 8; ++child)
        node.children[child] =
            level == shape.height() ? nullptr : build(shape, level + 1, 8 * code + child, places, nodes);
    return &node;
}

}  // namespace

PointerOctree::PointerOctree(const UniformOctree& shape, AllocationOrder order, std::uint64_t seed)
    : shape_(shape) {
    CHECK(shape.height() <= kMaxHeight);
    nodes_.resize(shape.node_count());
    Places places(shape, order, seed);
    root_ = build(shape, 0, 0, places, nodes_);
}

}  // namespace swath
