#include "tests/bench/culling_peers.h"

// GCC does not see that Bullet's headers assign in every case.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace swath::bench {

struct BulletTree::Nodes {
    btDbvt tree;  // only its root is used: the tree would delete what it owns
    btAlignedObjectArray<btDbvtNode> nodes;
    // Builds over one box or more, and puts `ids` in the tree's order.
    btDbvtNode* build(std::span<const Box> boxes, std::span<std::uint32_t> ids);
};

namespace {

struct Collector final : btDbvt::ICollide {
    explicit Collector(std::vector<std::uint32_t>& into) : visible(into) {}
    void Process(const btDbvtNode* leaf) override {
        visible.push_back(static_cast<std::uint32_t>(leaf->dataAsInt));
    }
    std::vector<std::uint32_t>& visible;
};

btVector3 vector(const glm::vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

btDbvtNode* BulletTree::Nodes::build(std::span<const Box> boxes, std::span<std::uint32_t> ids) {
    nodes.push_back({});
    btDbvtNode* node = &nodes[nodes.size() - 1];  // stays in place, since the array is reserved
    node->parent = nullptr;
    if (ids.size() == 1) {
        const Box& box = boxes[ids[0]];
        node->volume = btDbvtVolume::FromMM(vector(box.min), vector(box.max));
        node->childs[1] = nullptr;
        node->dataAsInt = static_cast<int>(ids[0]);
        return node;
    }
    Box centres;
    for (const std::uint32_t id : ids) centres.extend(boxes[id].centre());
    const int axis = centres.longest_axis();
    const std::size_t half = ids.size() / 2;
    std::ranges::nth_element(ids, ids.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](std::uint32_t id) { return boxes[id].centre()[axis]; });
    node->childs[0] = build(boxes, ids.first(half));
    node->childs[1] = build(boxes, ids.subspan(half));
    for (btDbvtNode* child : node->childs) child->parent = node;
    Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume);
    return node;
}

BulletTree::BulletTree(std::span<const Box> boxes) : nodes_(std::make_unique<Nodes>()) {
    if (boxes.empty()) return;
    nodes_->nodes.reserve(static_cast<int>(2 * boxes.size() - 1));
    std::vector<std::uint32_t> ids(boxes.size());
    std::iota(ids.begin(), ids.end(), 0u);
    nodes_->tree.m_root = nodes_->build(boxes, ids);
}

BulletTree::~BulletTree() { nodes_->tree.m_root = nullptr; }

std::span<const std::uint32_t> BulletTree::cull(const Frustum& frustum) {
    std::array<btVector3, 6> normals;
    std::array<btScalar, 6> offsets;
    for (std::size_t i = 0; i < 6; ++i) {
        normals[i] = vector(glm::vec3(frustum.planes[i]));
        offsets[i] = frustum.planes[i].w;
    }
    visible_.clear();
    Collector collector(visible_);
    btDbvt::collideKDOP(nodes_->tree.m_root, normals.data(), offsets.data(), 6, collector);
    return visible_;
}

std::vector<std::uint32_t> settle_rounding(std::span<const std::uint32_t> ids, std::span<const Box> boxes,
                                           const Frustum& frustum) {
    constexpr float kRoundings = 4 * std::numeric_limits<float>::epsilon();
    std::vector<bool> in(boxes.size());
    for (const std::uint32_t id : ids) in[id] = true;
    std::vector<std::uint32_t> settled;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::vec3 farthest = glm::max(glm::abs(boxes[i].min), glm::abs(boxes[i].max));
        const bool open = std::ranges::any_of(frustum.planes, [&](const glm::vec4& plane) {
            const float sum = glm::dot(glm::abs(glm::vec3(plane)), farthest) + std::abs(plane.w);
            return std::abs(p_vertex_distance(plane, boxes[i])) <= kRoundings * sum;
        });
        if (open ? !outside(frustum, boxes[i]) : in[i]) settled.push_back(static_cast<std::uint32_t>(i));
    }
    return settled;
}

}  // namespace swath::bench
