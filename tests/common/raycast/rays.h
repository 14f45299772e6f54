#pragma once
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/octree/sah/sah_builder.h"
#include "common/raycast/packets.h"
#include "tests/support/triangles.h"

namespace swath::test {

inline SahTree sah_tree(SahBuilder& builder, const Triangles& triangles, const SahSettings& settings) {
    auto tree = builder.build(triangles.view(), settings);
    CHECK(tree.has_value() == true);
    return std::move(*tree);
}

inline std::vector<float> corners_of(const Triangles& triangles) {
    const SteadyClock clock;
    ThreadTeam alone(1, clock);
    std::vector<float> corners;
    kernel_corners(triangles.positions, triangles.indices, alone, corners);
    return corners;
}

// Rays at triangles, of all kinds in turn: from inside and outside, near and far; at corners and edges; from
// corners; along axes and in axis planes through corners; with components that are zero of either sign,
// denormal, or tiny.
inline std::vector<Ray> rays_at(const Triangles& triangles, std::size_t count, std::uint32_t seed) {
    Numbers numbers(seed);
    const Box box = triangles.box();
    const glm::vec3 size = glm::max(box.size(), glm::vec3(1e-3f * std::max(box.size().x, box.size().y)));
    const float length = std::max({glm::length(size), 1e-6f * glm::length(box.max), 1e-12f});
    const auto inside = [&] { return box.min + numbers.point(0, 1) * box.size(); };
    const auto around = [&] { return box.centre() + length * numbers.point(); };
    const auto corner = [&] {
        return triangles.positions[triangles.indices[numbers.below(triangles.indices.size())]];
    };
    const auto on_an_edge = [&] {
        const std::uint32_t t = numbers.below(triangles.count());
        const std::uint32_t k = numbers.below(3);
        const float at = numbers.fraction();
        return (1 - at) * triangles.corner(t, k) + at * triangles.corner(t, (k + 1) % 3);
    };
    const auto from_to = [](const glm::vec3& from, const glm::vec3& to) { return Ray{from, to - from}; };
    constexpr float kLittle[] = {0.0f,    -0.0f,  1e-40f,  -1e-40f, 1e-19f,
                                 -1e-19f, 1e-17f, -1e-17f, 1e-7f,   -1e-7f};
    std::vector<Ray> rays;
    while (rays.size() < count) {
        Ray ray;
        switch (rays.size() % 13) {
            case 0:
                ray = from_to(around(), inside());
                break;
            case 1:
                ray = {inside(), numbers.point()};
                break;
            case 2:
                ray = from_to(around(), corner());
                break;
            case 3:
                ray = from_to(inside(), corner());
                break;
            case 4:
                ray = from_to(around(), on_an_edge());
                break;
            case 5:
                ray = {corner(), numbers.point()};
                break;
            case 6:
                ray = from_to(corner(), corner());
                break;
            case 7:  // along an axis, through a corner
            case 8: {
                ray.origin = corner();
                ray.direction = glm::vec3(numbers.below(2) == 0 ? 0.0f : -0.0f);
                const int axis = static_cast<int>(numbers.below(3));
                ray.direction[axis] = numbers.below(2) == 0 ? 1.0f : -1.0f;
                ray.origin[axis] -= 2 * length * ray.direction[axis] * (numbers.below(2) == 0 ? 0.0f : 1.0f);
                break;
            }
            case 9:  // in an axis plane through a corner
            case 10: {
                const glm::vec3 at = corner();
                ray = from_to(around(), inside());
                const int axis = static_cast<int>(numbers.below(3));
                ray.origin[axis] = at[axis];
                ray.direction[axis] = kLittle[numbers.below(std::size(kLittle))];
                break;
            }
            case 11:
                ray = from_to(box.centre() + 1000.0f * length * numbers.point(), corner());
                break;
            default: {  // mostly along one axis
                ray = {around(), numbers.point()};
                for (const int axis : {0, 1, 2})
                    if (numbers.below(2) == 0)
                        ray.direction[axis] *= std::abs(kLittle[numbers.below(std::size(kLittle))]);
            }
        }
        const glm::vec3 reach = glm::abs(ray.direction);
        // All corners may be one.
        if (!(std::max({reach.x, reach.y, reach.z}) > 0)) ray.direction = numbers.point();
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace swath::test
