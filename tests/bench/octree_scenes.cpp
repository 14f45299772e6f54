#include "tests/bench/octree_scenes.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "common/raycast/packets.h"
#include "common/scene/model.h"
#include "common/scene/procedural.h"
#include "tests/support/models.h"

namespace swath::bench {
namespace {

// Built-in models have a million by default, which takes the serial builder long.
constexpr int kBuiltinTriangles = 200'000;

RayView look(const glm::vec3& eye, const glm::vec3& target, float fov_y_degrees, float size, bool smoke) {
    RayView view;
    view.width = smoke ? 64 : 1024;
    view.height = smoke ? 48 : 768;
    view.eye = eye;
    view.near = 1e-3f * size;
    view.far = 4.0f * size;
    const glm::vec3 forward = glm::normalize(target - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    const float rows = static_cast<float>(view.height);
    const float pixel = 2 * std::tan(fov_y_degrees * std::numbers::pi_v<float> / 360) / rows;
    view.right = pixel * right;
    view.down = -pixel * up;
    view.first =
        forward - 0.5f * (static_cast<float>(view.width) - 1) * view.right - 0.5f * (rows - 1) * view.down;
    return view;
}

// Views from around the box and near to it; for a room, three from inside and one from outside.
std::vector<RayView> views_of(const Box& box, bool room, bool smoke) {
    const glm::vec3 centre = box.centre();
    const glm::vec3 half = 0.5f * box.size();
    const float size = glm::length(box.size());
    const auto from_outside = [&](const glm::vec3& direction, float distance, float fov) {
        return look(centre + distance * size * glm::normalize(direction), centre, fov, size, smoke);
    };
    if (!room)
        return {from_outside({0.2f, 0.3f, 1.0f}, 1.2f, 45), from_outside({1.0f, 0.2f, -0.1f}, 1.2f, 45),
                from_outside({-0.6f, 0.8f, -0.6f}, 1.2f, 45), from_outside({-0.3f, 0.2f, 1.0f}, 1.0f, 15)};
    const auto inside = [&](const glm::vec3& eye, const glm::vec3& target) {
        return look(centre + eye * half, centre + target * half, 60, size, smoke);
    };
    return {inside({0.6f, 0.2f, 0.2f}, {-0.5f, -0.3f, 0.0f}),
            inside({-0.8f, 0.3f, -0.7f}, {0.5f, -0.5f, 0.5f}),
            inside({0.1f, -0.2f, 0.0f}, {0.3f, -0.4f, 1.0f}), from_outside({0.5f, 0.9f, 0.6f}, 1.0f, 45)};
}

Result<OctreeScene> load(const std::string& name, const std::string& model, bool has_bars, bool smoke) {
    SWATH_TRY(auto mesh, load_model(model));
    OctreeScene scene{name, has_bars, build_objects(std::move(mesh), {}), {}, {}};
    std::vector<glm::vec3> positions;
    for (const Vertex& vertex : scene.set.mesh.vertices) positions.push_back(vertex.position);
    const SteadyClock clock;
    ThreadTeam alone(1, clock);
    kernel_corners(positions, scene.set.mesh.indices, alone, scene.corners);
    scene.views = views_of(scene.set.bounds, name == "conference", smoke);
    return scene;
}

// Finds a file of a real model.
std::optional<std::string> find_model(const std::string& file) {
    if (const auto shared = test::shared_model(file)) return shared->string();
    const std::filesystem::path fetched = std::filesystem::path(SWATH_SOURCE_DIR) / "models" / file;
    if (std::filesystem::exists(fetched)) return fetched.string();
    return std::nullopt;
}

}  // namespace

SahTriangles OctreeScene::triangles() const {
    return {reinterpret_cast<const std::byte*>(set.mesh.vertices.data()) + offsetof(Vertex, position),
            sizeof(Vertex), set.mesh.vertices.size(), set.mesh.indices};
}

std::size_t OctreeScene::rays() const {
    std::size_t rays = 0;
    for (const RayView& view : views) rays += view.rays();
    return rays;
}

Result<std::vector<OctreeScene>> octree_scenes(Figures& figures, const Effort& effort) {
    struct Wanted {
        std::string name;
        std::string model;
        bool has_bars;
    };
    std::vector<Wanted> wanted;
    if (effort.smoke) {
        wanted = {{"knot", effort.model, true}, {"town", "builtin:town:5000", false}};
    } else {
        for (const std::string name : {"bunny", "conference", "dragon"}) {
            if (const auto file = find_model(name + ".ply"))
                wanted.push_back({name, *file, true});
            else
                figures.note(fmt::format("left out: no {}.ply in ../shared/models or models", name));
        }
        for (const BuiltinModel& model : builtin_models())
            wanted.push_back(
                {model.name, fmt::format("builtin:{}:{}", model.name, kBuiltinTriangles), false});
    }
    std::vector<OctreeScene> scenes;
    for (const Wanted& one : wanted) {
        SWATH_TRY(auto scene, load(one.name, one.model, one.has_bars, effort.smoke));
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

}  // namespace swath::bench
