#pragma once
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "client/partition/partitioner.h"

namespace swath::test {

inline Object cube(const glm::vec3& centre, float half, std::uint32_t triangles) {
    Object object;
    object.box = {centre - glm::vec3(half), centre + glm::vec3(half)};
    object.triangle_count = triangles;
    return object;
}

// A camera at (0, 0, 4) that sees about [-1, 1] cubed.
inline View front_view(int width = 640, int height = 480) {
    Camera camera;
    camera.eye = {0, 0, 4};
    camera.fov_y = 0.6f;
    return make_view(camera, width, height);
}

struct Scene {
    std::string name;
    std::vector<Object> objects;
};

// Difficult objects for a partitioner, as front_view() sees them.
inline std::vector<Scene> awkward_scenes() {
    std::mt19937 random(11);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const auto somewhere = [&](float reach) {
        return glm::vec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
    };
    std::vector<Scene> scenes;
    scenes.push_back({"one object", {cube({0.2f, 0.1f, 0}, 0.1f, 50)}});
    scenes.push_back({"one object that is not in view", {cube({50, 0, 0}, 0.1f, 50)}});
    const auto many = [&](const std::string& name, std::size_t count, const auto& make) {
        Scene scene{name, {}};
        for (std::size_t i = 0; i < count; ++i) scene.objects.push_back(make());
        scenes.push_back(std::move(scene));
    };
    many("a sponge", 700,
         [&] { return cube(somewhere(1), 0.05f, 1 + static_cast<std::uint32_t>(random() % 500)); });
    many("behind the camera", 40, [&] { return cube(glm::vec3(0, 0, 20) + somewhere(5), 0.1f, 7); });
    many("all in one pixel", 100, [&] { return cube(somewhere(1e-5f), 1e-5f, 3); });
    many("the same box", 50, [&] { return cube({0.3f, 0.2f, 0}, 0.2f, 9); });
    many("larger than the screen", 30, [&] { return cube(somewhere(1), 30, 100); });
    many("around the camera", 300,
         [&] { return cube(glm::vec3(0, 0, 4) + somewhere(6), uniform(0, 1), 20); });
    many("without triangles", 60, [&] { return cube(somewhere(1), 0.1f, 0); });
    many("one heavy among light", 90,
         [&] { return cube(somewhere(1), 0.1f, random() % 40 == 0 ? 1u << 30 : 1u); });
    many("a line", 200, [&] { return cube({uniform(-1, 1), 0, 0}, 0.01f, 5); });
    many("flat boxes", 200, [&] {
        Object object = cube(somewhere(1), 0.1f, 5);
        object.box.max.z = object.box.min.z;
        return object;
    });
    return scenes;
}

inline PartitionInput input_of(const std::vector<ProjectedObject>& objects, const View& view,
                               std::size_t servers) {
    return {.frame = 42, .view = view, .objects = objects, .servers = servers};
}

inline ProjectedObject seen(const Rect& box, std::uint64_t work) { return {box, work, true}; }
inline ProjectedObject unseen(int x, int y) { return {{x, y, x + 1, y + 1}, 0, false}; }

// A plan by a partitioner that looks only at the screen.
template <class P>
FramePlan partition(const std::vector<ProjectedObject>& objects, int width, int height, std::size_t servers) {
    View view;
    view.width = width;
    view.height = height;
    return P().partition(input_of(objects, view, servers));
}

inline double work_of(const ServerShare& share, const std::vector<ProjectedObject>& objects) {
    double work = 0;
    for (const ObjectId id : share.group) work += static_cast<double>(objects[id].work);
    return work;
}

// Largest work of a server over the mean, minus one.
inline double imbalance(const FramePlan& plan, const std::vector<ProjectedObject>& objects) {
    double largest = 0;
    double sum = 0;
    for (const ServerShare& share : plan.servers) {
        largest = std::max(largest, work_of(share, objects));
        sum += work_of(share, objects);
    }
    return largest * static_cast<double>(plan.servers.size()) / sum - 1;
}

// The work of all servers over the work of all objects.
inline double overlap(const FramePlan& plan, const std::vector<ProjectedObject>& objects) {
    double done = 0;
    double all = 0;
    for (const ServerShare& share : plan.servers) done += work_of(share, objects);
    for (const ProjectedObject& object : objects) all += static_cast<double>(object.work);
    return done / all;
}

}  // namespace swath::test
