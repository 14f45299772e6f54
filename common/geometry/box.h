#pragma once
#include <algorithm>
#include <glm/glm.hpp>
#include <limits>

namespace swath {

// An axis-aligned box in the model's coordinates. The default box is empty.
struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    glm::vec3 centre() const { return 0.5f * (min + max); }
    glm::vec3 size() const { return max - min; }
    // Corner k of 8: bit 0 picks x, bit 1 y, bit 2 z.
    glm::vec3 corner(int k) const {
        return {(k & 1) != 0 ? max.x : min.x, (k & 2) != 0 ? max.y : min.y, (k & 4) != 0 ? max.z : min.z};
    }
    void extend(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void extend(const Box& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    int longest_axis() const {
        const glm::vec3 s = size();
        return s.x >= s.y && s.x >= s.z ? 0 : (s.y >= s.z ? 1 : 2);
    }
    bool operator==(const Box&) const = default;
};

// The box at `pose`, 0 to 1, around points that move along straight lines. `start` contains all points at
// pose 0, `end` at pose 1; an empty `end` means that nothing moves and gives `start`.
// - It contains every point at + pose * motion, computed in single precision with one rounding or with two.
//   Coordinates must be far from the largest float, as kMaxCoordinate of a mesh is.
// - It is exact at 0 and 1, slightly too large in between, and never larger than the box around both ends.
// - It is monotone: a box that contains others at both ends contains them at every pose.
Box box_at(const Box& start, const Box& end, float pose);

}  // namespace swath
