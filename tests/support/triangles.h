#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "common/geometry/box.h"
#include "common/octree/sah/sah_settings.h"
#include "common/octree/sah/sah_triangles.h"

namespace swath::test {

// Random numbers that are the same on every machine: the standard fixes the generator's, not the
// distributions'.
class Numbers {
  public:
    explicit Numbers(std::uint32_t seed) : generator_(seed) {}
    std::uint32_t below(std::size_t limit) { return static_cast<std::uint32_t>(generator_() % limit); }
    float fraction() { return static_cast<float>(generator_() >> 8) / 16777216.0f; }  // from 0, below 1
    float between(float low, float high) { return low + (high - low) * fraction(); }
    glm::vec3 point(float low = -1, float high = 1) {
        const float x = between(low, high);
        const float y = between(low, high);
        return {x, y, between(low, high)};
    }

  private:
    std::mt19937 generator_;
};

// Triangles in the form that trees are built over.
struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    std::size_t count() const { return indices.size() / 3; }
    const glm::vec3& corner(std::size_t triangle, std::size_t number) const {
        return positions[indices[3 * triangle + number]];
    }
    Box box_of(std::size_t triangle) const;
    Box box() const;
    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
    void add(const Triangles& more);
    // A view; this must outlive it.
    SahTriangles view() const {
        return {reinterpret_cast<const std::byte*>(positions.data()), sizeof(glm::vec3), positions.size(),
                indices};
    }
};

Triangles moved(Triangles triangles, float factor, const glm::vec3& by = glm::vec3(0));
// Triangles anywhere in a box of edge 2 around 0, each in a box of edge `size`.
Triangles soup(std::size_t count, float size, std::uint32_t seed);
// A closed mesh around 0: a sphere of radius 1 with dents as deep as `bumps`. Up to 0.5, its whole surface is
// seen from everywhere within 0.2 of the centre.
Triangles bumpy_sphere(std::uint32_t rings, float bumps, std::uint32_t seed);
// The faces of `edge` by `edge` by `edge` cells of edge 1 between (0, 0, 0) and (edge, edge, edge), each of
// two triangles: every vertex, edge and face lies in three, two and one axis planes with many others.
Triangles grid_of_squares(int edge);

// Inputs for trees and rays: soups, and difficult ones.
struct TriangleSet {
    std::string name;
    Triangles triangles;
};
const std::vector<TriangleSet>& triangle_sets();

// Settings at their limits, named by what is unusual about them.
struct NamedSettings {
    std::string name;
    SahSettings settings;
};
const std::vector<NamedSettings>& sah_settings();

}  // namespace swath::test
