#include "common/raster/meshlets.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::uint32_t kNone = 0xffff'ffff;
constexpr std::size_t kReadBeyond = 16;

}  // namespace

Meshlets::Meshlets(const ObjectSet& scene) {
    const Mesh& mesh = scene.mesh;
    triangles_.reserve(mesh.triangle_count() + kReadBeyond);
    std::vector<std::uint32_t> local(mesh.vertices.size(), kNone);
    std::vector<std::uint32_t> used;
    const auto finish = [&](Meshlet& meshlet) {
        meshlet.first_block = static_cast<std::uint32_t>(vertices_.size());
        meshlet.block_count = static_cast<std::uint32_t>((used.size() + 15) / 16);
        for (std::size_t i = 0; i < 16 * std::size_t{meshlet.block_count}; ++i) {
            const std::uint32_t number = used[std::min(i, used.size() - 1)];
            const Vertex& vertex = mesh.vertices[number];
            if (i % 16 == 0) {
                vertices_.emplace_back();
                if (scene.moves()) motion_.emplace_back();
            }
            VertexBlock& block = vertices_.back();
            for (int axis = 0; axis < 3; ++axis) {
                block.position[axis][i % 16] = vertex.position[axis];
                block.normal[axis][i % 16] = vertex.normal[static_cast<std::size_t>(axis)];
                if (scene.moves()) motion_.back().motion[axis][i % 16] = mesh.motion[number][axis];
            }
            block.colour[i % 16] = vertex.colour[0] | std::uint32_t{vertex.colour[1]} << 8 |
                                   std::uint32_t{vertex.colour[2]} << 16;
        }
        for (const std::uint32_t vertex : used) {
            meshlet.box.extend(posed(mesh, vertex, 0));
            if (scene.moves()) meshlet.end_box.extend(posed(mesh, vertex, 1));
            local[vertex] = kNone;
        }
        used.clear();
        meshlets_.push_back(meshlet);
    };
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        first_of_object_.push_back(static_cast<std::uint32_t>(meshlets_.size()));
        Meshlet meshlet{.first_triangle = object.first_triangle};
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            const std::uint32_t* const corners = &mesh.indices[3 * std::size_t{object.first_triangle + i}];
            const auto fresh = [&] {
                std::size_t count = 0;
                for (int k = 0; k < 3; ++k) {
                    bool seen = local[corners[k]] != kNone;
                    for (int l = 0; l < k; ++l) seen |= corners[l] == corners[k];
                    count += seen ? 0 : 1;
                }
                return count;
            };
            if (meshlet.triangle_count == kMeshletTriangles || used.size() + fresh() > kMeshletVertices) {
                finish(meshlet);
                meshlet = {.first_triangle = object.first_triangle + i};
            }
            std::uint32_t word = 0;
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& number = local[corners[k]];
                if (number == kNone) {
                    number = static_cast<std::uint32_t>(used.size());
                    used.push_back(corners[k]);
                }
                word |= number << 8 * k;
            }
            triangles_.push_back(word);
            ++meshlet.triangle_count;
        }
        if (meshlet.triangle_count > 0) finish(meshlet);
        objects_.resize(meshlets_.size(), id);
    }
    first_of_object_.push_back(static_cast<std::uint32_t>(meshlets_.size()));
    triangles_.resize(triangles_.size() + kReadBeyond);
}

std::uint32_t Meshlets::of_triangle(ObjectId object, std::uint32_t triangle) const {
    const auto begin = meshlets_.begin() + first_of_object_[object];
    const auto end = meshlets_.begin() + first_of_object_[object + 1];
    const auto after = std::upper_bound(
        begin, end, triangle,
        [](std::uint32_t value, const Meshlet& meshlet) { return value < meshlet.first_triangle; });
    return static_cast<std::uint32_t>(after - meshlets_.begin()) - 1;
}

KernelMeshlet Meshlets::kernel(std::uint32_t meshlet, std::uint32_t first, std::uint32_t end,
                               bool may_clip) const {
    const Meshlet& of = meshlets_[meshlet];
    return {.vertices = &vertices_[of.first_block],
            .motion = motion_.empty() ? nullptr : &motion_[of.first_block],
            .triangles = &triangles_[of.first_triangle],
            .blocks = of.block_count,
            .first = first,
            .end = end,
            .number = kMeshletTriangles * meshlet,
            .may_clip = may_clip};
}

std::size_t Meshlets::bytes() const {
    return meshlets_.size() * (sizeof(Meshlet) + sizeof(ObjectId)) + vertices_.size() * sizeof(VertexBlock) +
           motion_.size() * sizeof(MotionBlock) + triangles_.size() * sizeof(std::uint32_t);
}

}  // namespace swath
