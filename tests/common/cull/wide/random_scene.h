#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "common/geometry/frustum.h"
#include "common/geometry/morton.h"

namespace swath {

enum class Layout { kMorton, kRandom, kClustered, kIdentical, kDegenerate };
inline constexpr Layout kLayouts[] = {Layout::kMorton, Layout::kRandom, Layout::kClustered,
                                      Layout::kIdentical, Layout::kDegenerate};

// Boxes in and around [0, 1]^3, and frusta that may cut through it.
class RandomScene {
  public:
    explicit RandomScene(unsigned seed) : random_(seed) {}

    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    glm::vec3 point(float low, float high) {
        const float x = uniform(low, high);
        const float y = uniform(low, high);
        return {x, y, uniform(low, high)};
    }
    std::vector<Box> boxes(std::size_t count, Layout layout) {
        std::vector<Box> made;
        const glm::vec3 centres[3] = {point(0, 1), point(0, 1), point(0, 1)};
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec3 at = point(0, 1);
            if (layout == Layout::kClustered) at = centres[random_() % 3] + 0.02f * at;
            if (layout == Layout::kIdentical) at = centres[0];
            const glm::vec3 half = layout == Layout::kIdentical ? glm::vec3(0.01f) : 0.5f * point(0, 0.02f);
            made.push_back({at - half, at + half});
            if (layout == Layout::kDegenerate) spoil(made.back());
        }
        if (layout == Layout::kMorton || layout == Layout::kClustered) {
            std::vector<Box> sorted;
            for (const std::uint32_t i : morton_order(made)) sorted.push_back(made[i]);
            made.swap(sorted);
        }
        return made;
    }
    // The frustum of a camera, at any distance from the boxes.
    Frustum frustum() {
        Camera camera;
        camera.eye = point(-0.5f, 1.5f);
        camera.target = point(0, 1);
        camera.fov_y = uniform(0.1f, 1.5f);
        camera.near = 0.001f;
        camera.far = std::exp(uniform(-3, 2));
        return make_frustum(make_view(camera, 400, 300));
    }
    // A frustum that no camera has, or only a broken one.
    Frustum odd_frustum(int kind) {
        const float odd[] = {0.0f, -0.0f, nan(), infinity(), -infinity(), 1e30f, -1e-40f};
        Frustum frustum = this->frustum();
        for (glm::vec4& plane : frustum.planes) switch (kind) {
                case 0:  // everything is inside
                    plane = {0, 0, 0, 1};
                    break;
                case 1:  // everything is outside
                    plane = {0, 0, 0, -1};
                    break;
                case 2:
                    plane = {0, 0, 0, 0};
                    break;
                case 3:
                    plane = glm::vec4(nan());
                    break;
                case 4:  // along the axes, through the middle
                    plane = glm::vec4(0);
                    plane[static_cast<int>(random_() % 3)] = 1;
                    plane.w = -0.5f;
                    break;
                default:
                    if (random_() % 2 == 0) plane[static_cast<int>(random_() % 4)] = odd[random_() % 7];
            }
        return frustum;
    }
    static constexpr int kOddFrusta = 9;

    std::uint32_t number(std::uint32_t below) { return static_cast<std::uint32_t>(random_() % below); }

  private:
    static float nan() { return std::numeric_limits<float>::quiet_NaN(); }
    static float infinity() { return std::numeric_limits<float>::infinity(); }
    // Makes about every other box empty, infinite or NaN in some coordinates.
    void spoil(Box& box) {
        const float odd[] = {nan(), infinity(), -infinity(), 3e38f, -3e38f, 0.5f};
        if (random_() % 8 == 0) box = Box{};
        if (random_() % 8 == 0) std::swap(box.min, box.max);
        for (int axis = 0; axis < 3; ++axis) {
            if (random_() % 8 == 0) box.min[axis] = odd[random_() % 6];
            if (random_() % 8 == 0) box.max[axis] = odd[random_() % 6];
        }
    }

    std::mt19937 random_;
};

inline std::vector<std::uint32_t> by_brute_force(std::span<const Box> boxes, const Frustum& frustum) {
    std::vector<std::uint32_t> visible;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!outside(frustum, boxes[i])) visible.push_back(static_cast<std::uint32_t>(i));
    return visible;
}

inline std::vector<std::uint32_t> copy_of(std::span<const std::uint32_t> ids) {
    return {ids.begin(), ids.end()};
}

}  // namespace swath
