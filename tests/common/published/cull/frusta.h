#pragma once
#include <limits>
#include <random>
#include <vector>

#include "common/geometry/camera.h"
#include "common/geometry/frustum.h"

namespace swath {

inline Frustum frustum_of(const Camera& camera, int width = 4, int height = 3) {
    return make_frustum(make_view(camera, width, height));
}

// The frustum of ADSB's tables 2 and 3, in leaf edges of a tree of 9 levels: 30 degrees, 4:3, along +y. The
// paper prints neither planes nor eye; all 40 counts agree with these.
inline Frustum adsb_frustum(const glm::vec3& eye) {
    Camera camera;
    camera.eye = eye;
    camera.target = eye + glm::vec3(0, 1, 0);
    camera.up = {0, 0, 1};
    camera.fov_y = glm::radians(30.0f);
    camera.near = 0.25f;
    camera.far = 25.0f;
    return frustum_of(camera);
}

inline Frustum everything() {
    Frustum frustum;
    frustum.planes.fill({0, 0, 0, 1});
    return frustum;
}

inline Frustum nothing() {
    Frustum frustum = everything();
    frustum.planes[3] = {0, 0, 0, -1};
    return frustum;
}

// Cameras in and around a cube of `edge`, then frusta that no camera makes.
inline std::vector<Frustum> all_sorts_of_frusta(float edge, int cameras, unsigned seed) {
    std::mt19937 random(seed);
    const auto within = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() % 10'001) / 10'000.0f;
    };
    std::vector<Frustum> frusta;
    for (int i = 0; i < cameras; ++i) {
        Camera camera;
        camera.eye = edge * glm::vec3(within(-0.3f, 1.3f), within(-0.3f, 1.3f), within(-0.3f, 1.3f));
        camera.target = edge * glm::vec3(within(0, 1), within(0, 1), within(0, 1));
        camera.up = glm::vec3(within(-1, 1), within(-1, 1), within(-1, 1));
        camera.fov_y = within(0.1f, 2.5f);
        camera.near = edge * 0.001f;
        camera.far = edge * within(0.1f, 3);
        frusta.push_back(frustum_of(camera));
    }
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    frusta.push_back(everything());
    frusta.push_back(nothing());
    Frustum frustum;
    frustum.planes.fill({0, 0, 0, 0});
    frusta.push_back(frustum);
    frustum.planes.fill({kNan, kNan, kNan, kNan});
    frusta.push_back(frustum);
    frustum = frusta[0];
    frustum.planes[2].y = kNan;
    frusta.push_back(frustum);
    frustum.planes[4] = {0, 0, 1, -kInfinity};
    frusta.push_back(frustum);
    frustum.planes[4] = {0, kInfinity, -1, 0};
    frusta.push_back(frustum);
    frustum = frusta[0];
    for (glm::vec4& plane : frustum.planes) plane *= 1e-41f;  // denormal numbers
    frusta.push_back(frustum);
    frustum = frusta[0];
    for (glm::vec4& plane : frustum.planes) plane *= 1e36f / edge;
    frusta.push_back(frustum);
    return frusta;
}

}  // namespace swath
