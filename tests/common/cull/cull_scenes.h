#pragma once
#include <numeric>
#include <random>
#include <vector>

#include "common/geometry/camera.h"
#include "common/scene/objects.h"
#include "tests/support/models.h"

namespace swath::test {

// A model with triangles of all sizes, moved away from the origin, in leaves of a few.
inline ObjectSet soup(std::uint32_t seed, const glm::vec3& offset = {}, std::uint32_t leaf_triangles = 8,
                      int depth = 3) {
    Mesh mesh = triangle_soup(3000, seed);
    for (Vertex& vertex : mesh.vertices) vertex.position += offset;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) mesh.materials.push_back(t / 7 % 3);
    return build_objects(std::move(mesh), {.depth = depth, .leaf_triangles = leaf_triangles});
}

// The same at pose 0; at pose 1 every vertex is somewhere else in or around the model.
inline ObjectSet moving_soup(std::uint32_t seed, const glm::vec3& offset = {},
                             std::uint32_t leaf_triangles = 8) {
    ObjectSet still = soup(seed, offset, leaf_triangles);
    Mesh& mesh = still.mesh;
    const glm::vec3 size = still.bounds.size();
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<float>(random() >> 8) / 16777216.0f - 0.5f; };
    mesh.motion.resize(mesh.vertices.size());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const glm::vec3 by = 1.5f * size * glm::vec3(number(), number(), number());
        for (std::size_t c = 0; c < 3; ++c) mesh.motion[mesh.indices[3 * t + c]] = by;
    }
    return build_objects(std::move(mesh), {.depth = 3, .leaf_triangles = leaf_triangles});
}

inline std::vector<ObjectId> all_ids(const ObjectSet& scene) {
    std::vector<ObjectId> ids(scene.objects.size());
    std::iota(ids.begin(), ids.end(), ObjectId{0});
    return ids;
}

// Cameras in, at and around the model, with any angle of view, sometimes with the eye on a surface.
class RandomViews {
  public:
    explicit RandomViews(std::uint32_t seed) : random_(seed) {}

    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_()) % limit; }
    float number(float low, float high) {
        return low + (high - low) * static_cast<float>(random_() >> 8) / 16777216.0f;
    }
    View view(const ObjectSet& scene) {
        const float size = glm::length(scene.bounds.size());
        Camera camera;
        const auto near_by = [&](float reach) {
            return scene.bounds.centre() +
                   size * glm::vec3(number(-reach, reach), number(-reach, reach), number(-reach, reach));
        };
        camera.eye = near_by(below(3) == 0 ? 2.0f : 0.3f);
        if (below(4) == 0)
            camera.eye =
                scene.mesh.vertices[below(static_cast<std::uint32_t>(scene.mesh.vertices.size()))].position;
        camera.target = near_by(0.5f);
        camera.up = {0.3f, 1, 0.1f};
        camera.fov_y = number(0.02f, 2.6f);
        camera.near = size * (below(2) == 0 ? 1e-5f : 0.01f);
        camera.far = size * number(0.2f, 4);
        return make_view(camera, 1 + static_cast<int>(below(300)), 1 + static_cast<int>(below(200)));
    }
    // A view at some pose.
    View posed_view(const ObjectSet& scene) {
        View made = view(scene);
        made.pose = below(5) == 0 ? static_cast<float>(below(2)) : number(0, 1);
        return made;
    }
    // The whole viewport, a part of it, or a pixel.
    Rect rect(const View& view) {
        if (below(4) == 0) return view.viewport();
        const int x = static_cast<int>(below(static_cast<std::uint32_t>(view.width)));
        const int y = static_cast<int>(below(static_cast<std::uint32_t>(view.height)));
        if (below(4) == 0) return {x, y, x + 1, y + 1};
        return {x, y, x + 1 + static_cast<int>(below(static_cast<std::uint32_t>(view.width - x))),
                y + 1 + static_cast<int>(below(static_cast<std::uint32_t>(view.height - y)))};
    }

  private:
    std::mt19937 random_;
};

}  // namespace swath::test
