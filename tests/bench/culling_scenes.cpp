#include "tests/bench/culling_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <random>

#include "common/geometry/morton.h"
#include "common/scene/model.h"

namespace swath::bench {
namespace {

constexpr float kWorld = 1000;
constexpr glm::vec3 kUp{0, 0, 1};

struct Eye {
    glm::vec3 at;
    glm::vec3 along;
    glm::vec3 up;
    float fov_y = 30;  // degrees
    float near = 0.25f;
    float far = 1;
};

Frustum frustum_of(const Eye& eye, int width, int height) {
    Camera camera;
    camera.eye = eye.at;
    camera.target = eye.at + eye.along;
    camera.up = eye.up;
    camera.fov_y = glm::radians(eye.fov_y);
    camera.near = eye.near;
    camera.far = eye.far;
    return make_frustum(make_view(camera, width, height));
}

Frustum wide_frustum(const Eye& eye) { return frustum_of(eye, 1600, 1000); }

float edge_of(int height) { return std::ldexp(1.0f, height); }

// The inside of `box`, less `margin` on all sides.
Frustum orthographic(const Box& box, float margin) {
    const glm::vec3 low = box.min + margin;
    const glm::vec3 high = box.max - margin;
    return {{{{1, 0, 0, -low.x},
              {-1, 0, 0, high.x},
              {0, 0, 1, -low.z},
              {0, 0, -1, high.z},
              {0, 1, 0, -low.y},
              {0, -1, 0, high.y}}}};
}

void sort_by_place(std::vector<Box>& boxes) {
    std::vector<Box> sorted;
    sorted.reserve(boxes.size());
    for (const std::uint32_t i : morton_order(boxes)) sorted.push_back(boxes[i]);
    boxes = std::move(sorted);
}

// Longest first; equal ones in the order y, x, z.
std::array<int, 3> axes_by_length(const Box& box) {
    std::array<int, 3> axes{1, 0, 2};
    std::ranges::stable_sort(axes, std::greater{}, [&](int axis) { return box.size()[axis]; });
    return axes;
}

Box box_around(const glm::vec3& centre, std::mt19937& random) {
    std::uniform_real_distribution<float> half(0.5f, 2.5f);
    const float x = half(random);
    const float y = half(random);
    const glm::vec3 size{x, y, half(random)};
    return {centre - size, centre + size};
}

const Box kWorldBox{glm::vec3(0), glm::vec3(kWorld)};

}  // namespace

TreeScene whole_tree(int height) {
    const float edge = edge_of(height);
    return {"W", height, orthographic({glm::vec3(0), glm::vec3(edge)}, 0.5f)};
}

TreeScene tree_from_centre(int height, int fov_y) {
    const float edge = edge_of(height);
    return {fmt::format("C{}", fov_y), height,
            wide_frustum({glm::vec3(edge / 2), {0, 1, 0}, kUp, static_cast<float>(fov_y), 0.25f, 2 * edge})};
}

TreeScene tree_from_corner(int height, int fov_y) {
    const float edge = edge_of(height);
    return {fmt::format("K{}", fov_y), height,
            wide_frustum({glm::vec3(0), glm::vec3(1), kUp, static_cast<float>(fov_y), 0.25f, 2 * edge})};
}

TreeScene table_2_camera() {
    return {"table 2", 8, frustum_of({{128, 115.5f, 128}, {0, 1, 0}, kUp, 30, 0.25f, 25}, 1280, 960)};
}

TreeScene table_3_camera() {
    return {"table 3", 8, frustum_of({{224, 213.75f, 224}, {0, 1, 0}, kUp, 30, 0.25f, 25}, 1280, 960)};
}

TreeScene walk(int height, int frame, int frames) {
    const float edge = edge_of(height);
    const float way = static_cast<float>(frame) / static_cast<float>(std::max(frames - 1, 1));
    const float turned = std::clamp((way - 0.45f) / 0.1f, 0.0f, 1.0f) * 1.5f * glm::pi<float>();
    const float angle = glm::pi<float>() / 4 + turned;
    return {"walk", height,
            wide_frustum({glm::vec3(edge * (0.1f + 0.8f * way)),
                          {std::cos(angle), std::sin(angle), 0.2f},
                          kUp,
                          60,
                          0.25f,
                          edge / 2})};
}

BoxSet random_boxes_in_random_order(std::size_t count, unsigned seed) {
    BoxSet set{"random order", {}, kWorldBox};
    set.boxes.reserve(count);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(0, kWorld);
    for (std::size_t i = 0; i < count; ++i) {
        const float x = place(random);
        const float y = place(random);
        set.boxes.push_back(box_around({x, y, place(random)}, random));
    }
    return set;
}

BoxSet random_boxes(std::size_t count, unsigned seed) {
    BoxSet set = random_boxes_in_random_order(count, seed);
    set.name = "random";
    sort_by_place(set.boxes);
    return set;
}

BoxSet clustered_boxes(std::size_t count, unsigned seed) {
    constexpr std::size_t kClouds = 200;
    BoxSet set{"clustered", {}, kWorldBox};
    set.boxes.reserve(count);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(0, kWorld);
    std::uniform_real_distribution<float> spread_of(10, 60);
    std::normal_distribution<float> off(0, 1);
    struct Cloud {
        glm::vec3 centre;
        float spread;
    };
    std::vector<Cloud> clouds;
    for (std::size_t i = 0; i < kClouds; ++i) {
        const float x = place(random);
        const float y = place(random);
        const float z = place(random);
        clouds.push_back({{x, y, z}, spread_of(random)});
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Cloud& cloud = clouds[i % kClouds];
        const float x = off(random);
        const float y = off(random);
        set.boxes.push_back(box_around(cloud.centre + cloud.spread * glm::vec3(x, y, off(random)), random));
    }
    sort_by_place(set.boxes);
    return set;
}

Result<BoxSet> triangle_boxes(const std::string& model, std::size_t count) {
    SWATH_TRY(const auto mesh, load_model(model));
    const Box room = bounds(mesh);
    const std::array<int, 3> axes = axes_by_length(room);
    const auto copies = (count + mesh.triangle_count() - 1) / mesh.triangle_count();
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(copies))));
    BoxSet set{"real", {}, {}};
    set.boxes.reserve(count);
    for (std::size_t copy = 0; set.boxes.size() < count; ++copy) {
        glm::vec3 place(0);
        place[axes[0]] = static_cast<float>(copy % columns) * room.size()[axes[0]];
        place[axes[1]] = static_cast<float>(copy / columns) * room.size()[axes[1]];
        for (std::size_t t = 0; t < mesh.triangle_count() && set.boxes.size() < count; ++t) {
            Box box;
            for (std::size_t k = 0; k < 3; ++k)
                box.extend(mesh.vertices[mesh.indices[3 * t + k]].position + place);
            set.boxes.push_back(box);
            set.view_bounds.extend(box);
        }
    }
    sort_by_place(set.boxes);
    return set;
}

std::vector<ObjectScene> object_scenes(const Box& bounds) {
    const std::array<int, 3> axes = axes_by_length(bounds);
    const float edge = bounds.size()[axes[0]];
    glm::vec3 along(0);
    along[axes[0]] = 1;
    glm::vec3 up(0);
    up[axes[2]] = 1;
    const float near = 0.00025f * edge;
    // Wide enough that no box sticks out: clouds have no bounds.
    Box everything{bounds.min - edge, bounds.max + edge};
    return {{"c60", wide_frustum({bounds.centre(), along, up, 60, near, 2 * edge})},
            {"k30", wide_frustum({bounds.min, bounds.size(), up, 30, near, 2 * edge})},
            {"far small", wide_frustum({bounds.centre(), along, up, 30, near, 0.15f * edge})},
            {"all", orthographic(everything, 0)}};
}

}  // namespace swath::bench
