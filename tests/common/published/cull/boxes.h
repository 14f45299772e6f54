#pragma once
#include <cmath>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "common/geometry/box.h"

namespace swath {

// Boxes to cull, all in or near the cube [0, 100]^3.
class BoxMaker {
  public:
    explicit BoxMaker(unsigned seed) : random_(seed) {}

    float number(float low, float high) {
        return low + (high - low) * static_cast<float>(random_() % 1'000'001) / 1'000'000.0f;
    }
    glm::vec3 point(float low, float high) {
        return {number(low, high), number(low, high), number(low, high)};
    }
    static Box around(const glm::vec3& centre, const glm::vec3& half) {
        return {centre - half, centre + half};
    }

    std::vector<Box> scattered(int count, float largest) {
        std::vector<Box> boxes;
        for (int i = 0; i < count; ++i) boxes.push_back(around(point(0, 100), point(0, largest / 2)));
        return boxes;
    }
    std::vector<Box> clustered(int count) {
        std::vector<Box> boxes;
        glm::vec3 centre(0);
        for (int i = 0; i < count; ++i) {
            if (i % 100 == 0) centre = point(0, 100);
            boxes.push_back(around(centre + point(-1, 1) * number(0, 3), point(0, 0.1f)));
        }
        return boxes;
    }
    // Boxes from specks to the size of everything.
    std::vector<Box> mixed(int count) {
        std::vector<Box> boxes;
        for (int i = 0; i < count; ++i)
            boxes.push_back(around(point(0, 100), point(0, 50) * std::pow(10.0f, number(-6, 0))));
        return boxes;
    }

  private:
    std::mt19937 random_;
};

struct BoxSet {
    std::string_view name;
    std::vector<Box> boxes;
};

inline std::vector<BoxSet> all_sorts_of_boxes() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    BoxMaker make(11);
    const Box one{{10, 20, 30}, {11, 22, 33}};
    std::vector<Box> far_away = make.scattered(1'000, 1);
    for (Box& box : far_away) box = {box.min + glm::vec3(1e6f), box.max + glm::vec3(1e6f)};
    std::vector<Box> outlier = make.scattered(1'000, 1);
    outlier.push_back({glm::vec3(1e9f), glm::vec3(1e9f)});
    std::vector<Box> odd = make.scattered(500, 2);
    odd.push_back({});
    odd.push_back({glm::vec3(-kInfinity), glm::vec3(kInfinity)});
    odd.push_back({{-kInfinity, 3, 4}, {5, 6, 7}});
    odd.push_back({glm::vec3(kNan), glm::vec3(kNan)});
    odd.push_back({{3, 3, 3}, {2, 4, kNan}});
    odd.push_back({{60, 60, 60}, {40, 50, 70}});  // inside out
    odd.push_back({glm::vec3(-3e38f), glm::vec3(3e38f)});
    std::vector<Box> flat = make.scattered(2'000, 1);
    for (Box& box : flat) box.min.y = box.max.y = 5;
    return {{"none", {}},
            {"one", {one}},
            {"a point", {{one.min, one.min}}},
            {"the same", std::vector<Box>(500, one)},
            {"the same point", std::vector<Box>(500, Box{one.min, one.min})},
            {"scattered", make.scattered(5'000, 1)},
            {"scattered, large", make.scattered(5'000, 30)},
            {"clustered", make.clustered(5'000)},
            {"mixed", make.mixed(3'000)},
            {"flat", flat},
            {"far away", far_away},
            {"an outlier", outlier},
            {"odd", odd}};
}

}  // namespace swath
