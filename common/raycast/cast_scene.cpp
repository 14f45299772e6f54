#include "common/raycast/cast_scene.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/parts.h"
#include "common/raycast/packets.h"

namespace swath {
namespace {

// Fewer are not worth a thread.
constexpr std::size_t kLeastVertices = 1u << 14;
constexpr std::size_t kLeastWords = 1u << 6;  // of 32 nodes

// The power of two that brings every coordinate of the box to at most 1.
float scale_for(const Box& box) {
    float largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::ldexp(1.0f, std::clamp(-exponent, -120, 120));
}

void set_bits(std::vector<std::uint32_t>& bits, std::size_t begin, std::size_t end) {
    for (; begin < end && begin % 32 != 0; ++begin) bits[begin / 32] |= 1u << begin % 32;
    for (; begin + 32 <= end; begin += 32) bits[begin / 32] = ~0u;
    for (; begin < end; ++begin) bits[begin / 32] |= 1u << begin % 32;
}
bool has(const std::vector<std::uint32_t>& bits, std::size_t i) { return (bits[i / 32] >> i % 32 & 1) != 0; }

}  // namespace

CastScene::CastScene(const ObjectSet& scene, ThreadTeam& team, SahDevice device)
    : scene_(scene), team_(team), builder_(team.size(), device), scale_(scale_for(scene.swept_bounds())) {
    positions_.resize(scene.mesh.vertices.size());
    move();
}

void CastScene::pose(float pose) {
    if (pose == pose_) return;
    pose_ = pose;
    move();
}

// Scaling by a power of two changes no digit.
void CastScene::move() {
    const std::size_t parts = parts_for(positions_.size(), kLeastVertices, team_);
    run_parts(team_, parts, [&](std::size_t index) {
        const Part part = part_of(positions_.size(), parts, index);
        for (std::size_t v = part.begin; v < part.end; ++v)
            positions_[v] = posed(scene_.mesh, static_cast<std::uint32_t>(v), pose_) * scale_;
    });
    kernel_corners(positions_, scene_.mesh.indices, team_, corners_);
}

Status CastScene::build_all(const SahSettings& settings) {
    auto tree = builder_.build({reinterpret_cast<const std::byte*>(positions_.data()), sizeof(glm::vec3),
                                positions_.size(), scene_.mesh.indices},
                               settings);
    if (!tree) return fail_in("ray caster", tree.error());
    tree_ = std::move(*tree);
    want_all_ = true;
    return {};
}

Status CastScene::build(std::span<const TriangleRange> ranges, const SahSettings& settings) {
    run_indices_.clear();
    run_triangles_.clear();
    for (const TriangleRange& range : ranges) {
        const auto first =
            scene_.mesh.indices.begin() + 3 * static_cast<std::ptrdiff_t>(range.first_triangle);
        run_indices_.insert(run_indices_.end(), first,
                            first + 3 * static_cast<std::ptrdiff_t>(range.triangle_count));
        for (std::uint32_t t = 0; t < range.triangle_count; ++t)
            run_triangles_.push_back(range.first_triangle + t);
    }
    auto tree = builder_.build({reinterpret_cast<const std::byte*>(positions_.data()), sizeof(glm::vec3),
                                positions_.size(), run_indices_},
                               settings);
    if (!tree) return fail_in("ray caster", tree.error());
    tree_ = std::move(*tree);
    for (std::uint32_t& triangle : tree_.triangles) triangle = run_triangles_[triangle];
    want_all_ = true;
    return {};
}

void CastScene::want(std::span<const TriangleRange> ranges) {
    std::size_t count = 0;
    for (const TriangleRange& range : ranges) count += range.triangle_count;
    want_all_ = count == scene_.mesh.triangle_count();
    if (want_all_) return;
    wanted_triangles_.assign((scene_.mesh.triangle_count() + 31) / 32, 0);
    for (const TriangleRange& range : ranges)
        set_bits(wanted_triangles_, range.first_triangle,
                 std::size_t{range.first_triangle} + range.triangle_count);
    // Leaves come first, by words, which threads do not share.
    wanted_nodes_.resize((tree_.nodes.size() + 31) / 32);
    const std::size_t parts = parts_for(wanted_nodes_.size(), kLeastWords, team_);
    run_parts(team_, parts, [&](std::size_t index) {
        const Part part = part_of(wanted_nodes_.size(), parts, index);
        for (std::size_t word = part.begin; word < part.end; ++word)
            wanted_nodes_[word] = wanted_leaves(word);
    });
    // A node is wanted if a child is. Children come after their parents, so this goes backwards.
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
        const SahNode& node = tree_.nodes[i];
        if (node.is_leaf()) continue;
        bool wanted = false;
        for (std::uint32_t child = 0; child < node.child_count() && !wanted; ++child)
            wanted = has(wanted_nodes_, node.first_child() + child);
        if (wanted) wanted_nodes_[i / 32] |= 1u << i % 32;
    }
}

std::uint32_t CastScene::wanted_leaves(std::size_t word) const {
    std::uint32_t bits = 0;
    const std::size_t first = 32 * word;
    const std::size_t end = std::min(first + 32, tree_.nodes.size());
    for (std::size_t i = first; i < end; ++i) {
        const SahNode& node = tree_.nodes[i];
        if (!node.is_leaf()) continue;
        bool wanted = false;
        for (std::uint32_t t = 0; t < node.count() && !wanted; ++t)
            wanted = has(wanted_triangles_, tree_.triangles[node.first() + t]);
        if (wanted) bits |= 1u << (i - first);
    }
    return bits;
}

KernelTree CastScene::wanted() const {
    KernelTree tree = all();
    if (!want_all_) {
        tree.wanted_nodes = wanted_nodes_.data();
        tree.wanted_triangles = wanted_triangles_.data();
    }
    return tree;
}

KernelTree CastScene::all() const { return kernel_tree(tree_, corners_); }

glm::vec3 CastScene::corner(std::uint32_t triangle, int number) const {
    const float* at = corners_.data() + 9 * std::size_t{triangle} + 3 * static_cast<std::size_t>(number);
    return {at[0], at[1], at[2]};
}

}  // namespace swath
