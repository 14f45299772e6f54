#include "tests/support/triangles.h"

#include <cmath>

namespace swath::test {

Box Triangles::box_of(std::size_t triangle) const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) box.extend(corner(triangle, k));
    return box;
}

Box Triangles::box() const {
    Box box;
    for (std::size_t t = 0; t < count(); ++t) box.extend(box_of(t));
    return box;
}

void Triangles::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    for (const glm::vec3& corner : {a, b, c}) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(corner);
    }
}

void Triangles::add(const Triangles& more) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), more.positions.begin(), more.positions.end());
    for (const std::uint32_t index : more.indices) indices.push_back(first + index);
}

Triangles moved(Triangles triangles, float factor, const glm::vec3& by) {
    for (glm::vec3& position : triangles.positions) position = factor * position + by;
    return triangles;
}

Triangles soup(std::size_t count, float size, std::uint32_t seed) {
    Numbers numbers(seed);
    Triangles made;
    for (std::size_t t = 0; t < count; ++t) {
        const glm::vec3 place = numbers.point();
        const auto corner = [&] { return place + 0.5f * size * numbers.point(); };
        const glm::vec3 a = corner();
        const glm::vec3 b = corner();
        made.add(a, b, corner());
    }
    return made;
}

Triangles bumpy_sphere(std::uint32_t rings, float bumps, std::uint32_t seed) {
    Numbers numbers(seed);
    Triangles made;
    const std::uint32_t sectors = 2 * rings;
    const auto put = [&](double polar, double azimuth) {
        const glm::dvec3 at(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                            std::sin(polar) * std::sin(azimuth));
        made.positions.push_back((1 - bumps * numbers.fraction()) * glm::vec3(at));
    };
    constexpr double kPi = 3.14159265358979;
    put(0, 0);
    for (std::uint32_t ring = 1; ring < rings; ++ring)
        for (std::uint32_t sector = 0; sector < sectors; ++sector)
            put(kPi * ring / rings, 2 * kPi * sector / sectors);
    put(kPi, 0);
    const auto last = static_cast<std::uint32_t>(made.positions.size() - 1);
    const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
        if (ring == 0) return 0u;
        return ring == rings ? last : 1 + (ring - 1) * sectors + sector % sectors;
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const std::uint32_t corners[4] = {at(ring, sector), at(ring, sector + 1), at(ring + 1, sector),
                                              at(ring + 1, sector + 1)};
            if (ring > 0) made.indices.insert(made.indices.end(), {corners[0], corners[1], corners[2]});
            if (ring + 1 < rings)
                made.indices.insert(made.indices.end(), {corners[2], corners[1], corners[3]});
        }
    return made;
}

Triangles grid_of_squares(int edge) {
    Triangles made;
    for (int axis = 0; axis < 3; ++axis)
        for (int plane = 0; plane <= edge; ++plane)
            for (int u = 0; u < edge; ++u)
                for (int v = 0; v < edge; ++v) {
                    const auto corner = [&](int du, int dv) {
                        glm::vec3 at(0);
                        at[axis] = static_cast<float>(plane);
                        at[(axis + 1) % 3] = static_cast<float>(u + du);
                        at[(axis + 2) % 3] = static_cast<float>(v + dv);
                        return at;
                    };
                    made.add(corner(0, 0), corner(1, 0), corner(1, 1));
                    made.add(corner(0, 0), corner(1, 1), corner(0, 1));
                }
    return made;
}

namespace {

Triangles mixed_sizes() {
    Triangles made;
    for (std::uint32_t i = 0; i < 30; ++i)
        made.add(soup(40, std::ldexp(2.0f, -static_cast<int>(i)), 100 + i));
    return made;
}

Triangles clustered() {
    Triangles made;
    Numbers numbers(11);
    for (std::uint32_t cluster = 0; cluster < 8; ++cluster)
        made.add(moved(soup(150, 0.3f, 200 + cluster), cluster % 2 == 0 ? 1e-3f : 1e-2f, numbers.point()));
    return made;
}

// Points, needles with two corners in one place, corners on a line, along an axis or not; and some triangles.
Triangles degenerate() {
    Triangles made = soup(200, 0.3f, 12);
    Numbers numbers(13);
    for (int i = 0; i < 150; ++i) {
        const glm::vec3 a = numbers.point();
        const glm::vec3 b = numbers.point();
        made.add(a, a, a);
        made.add(a, a, b);
        made.add(a, b, a);
        made.add(b, a, a);
        made.add(a, 0.25f * a + 0.75f * b, b);
        const glm::vec3 along = a + glm::vec3(numbers.fraction(), 0, 0);
        made.add(a, along, 0.5f * (a + along));
    }
    return made;
}

// Triangles in three planes, on top of one another, each of them twice or thrice.
Triangles coplanar() {
    Triangles made;
    Numbers numbers(14);
    for (int i = 0; i < 120; ++i) {
        const int axis = i % 3;
        glm::vec3 corners[3];
        for (glm::vec3& corner : corners) {
            corner = numbers.point();
            corner[axis] = axis == 0 ? 0.0f : 0.5f;
        }
        for (int copy = 0; copy < 2 + i % 2; ++copy)
            made.add(corners[copy % 3], corners[(copy + 1) % 3], corners[(copy + 2) % 3]);
    }
    return made;
}

// Triangles as large as a unit in the last place or two.
Triangles grains() {
    Triangles made = soup(50, 0.5f, 15);
    Numbers numbers(16);
    for (int i = 0; i < 1500; ++i) {
        const glm::vec3 a = numbers.point();
        glm::vec3 corners[3] = {a, a, a};
        for (glm::vec3& corner : corners)
            for (int axis = 0; axis < 3; ++axis)
                for (std::uint32_t steps = numbers.below(3); steps > 0; --steps)
                    corner[axis] = std::nextafter(corner[axis], 2.0f);
        made.add(corners[0], corners[1], corners[2]);
    }
    return made;
}

Triangles signed_zeros() {
    Triangles made;
    Numbers numbers(17);
    for (int i = 0; i < 300; ++i) {
        glm::vec3 corners[3];
        for (glm::vec3& corner : corners)
            for (int axis = 0; axis < 3; ++axis) {
                const float x = numbers.fraction();
                corner[axis] = x < 0.2f ? 0.0f : (x < 0.4f ? -0.0f : x);
            }
        made.add(corners[0], corners[1], corners[2]);
    }
    return made;
}

Triangles on_a_line(const glm::vec3& direction) {
    Triangles made;
    Numbers numbers(18);
    for (int i = 0; i < 300; ++i)
        made.add(numbers.fraction() * direction, numbers.fraction() * direction,
                 numbers.fraction() * direction);
    return made;
}

Triangles all_alike(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Triangles made;
    made.positions = {a, b, c};
    for (int i = 0; i < 600; ++i) made.indices.insert(made.indices.end(), {0, 1, 2});
    return made;
}

}  // namespace

const std::vector<TriangleSet>& triangle_sets() {
    static const std::vector<TriangleSet> sets = [] {
        std::vector<TriangleSet> all;
        const auto add = [&](const char* name, Triangles triangles) {
            all.push_back({name, std::move(triangles)});
        };
        add("small", soup(3000, 0.05f, 1));
        add("large", soup(250, 2.0f, 2));
        add("mixed sizes", mixed_sizes());
        add("clustered", clustered());
        add("degenerate", degenerate());
        add("coplanar", coplanar());
        add("grid of squares", grid_of_squares(5));
        add("bumpy sphere", bumpy_sphere(14, 0.5f, 3));
        add("huge", moved(soup(800, 0.2f, 4), 1e8f));
        add("tiny", moved(soup(800, 0.2f, 5), 1e-8f));
        add("far from 0", moved(soup(800, 0.2f, 6), 1.0f, glm::vec3(5000, -20000, 100)));
        add("grains", grains());
        add("signed zeros", signed_zeros());
        add("on an axis", on_a_line({1, 0, 0}));
        add("on a line", on_a_line({1, 2, -1}));
        add("flat", [] {
            Triangles flat = soup(500, 0.2f, 7);
            for (glm::vec3& position : flat.positions) position.y = 0.25f;
            return flat;
        }());
        add("one place", all_alike({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));
        add("all alike", all_alike({0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f}));
        add("one", soup(1, 1.0f, 8));
        add("two", soup(2, 1.0f, 9));
        return all;
    }();
    return sets;
}

const std::vector<NamedSettings>& sah_settings() {
    static const std::vector<NamedSettings> all = [] {
        std::vector<NamedSettings> made{{"default", kDefaultSah}, {"fast", kFastSah}};
        const auto add = [&](std::string name, auto change) {
            SahSettings settings = kDefaultSah;
            change(settings);
            made.push_back({std::move(name), settings});
        };
        add("no kd-trees", [](SahSettings& s) { s.kd_triangles = 0; });
        add("no kd-trees, small grain", [](SahSettings& s) { s.kd_triangles = 0, s.grain = 30; });
        add("kd-trees only", [](SahSettings& s) { s.kd_triangles = s.grain = kMaxGrain; });
        add("kd-trees below a small grain", [](SahSettings& s) { s.kd_triangles = s.grain = 64; });
        add("grain 1", [](SahSettings& s) { s.kd_triangles = 0, s.grain = 1; });
        add("grain 1, kd 1", [](SahSettings& s) { s.kd_triangles = s.grain = 1; });
        add("every gain", [](SahSettings& s) { s.least_gain = 0, s.kd_triangles = 0; });
        add("best gain only", [](SahSettings& s) { s.least_gain = 1, s.kd_triangles = 0, s.grain = 100; });
        add("not refined", [](SahSettings& s) { s.refine = false; });
        add("two bins", [](SahSettings& s) { s.min_bins = s.max_bins = 2; });
        add("most bins", [](SahSettings& s) { s.min_bins = s.max_bins = kMaxBins, s.grain = 300; });
        add("a bin a triangle", [](SahSettings& s) { s.bin_ratio = 1; });
        add("visits for nothing", [](SahSettings& s) { s.traversal_cost = 0, s.max_duplication = 8; });
        for (std::uint32_t most = 1; most <= 8; ++most)
            add("duplication " + std::to_string(most), [&](SahSettings& s) {
                s.max_duplication = most, s.grain = 200, s.kd_triangles = 50, s.traversal_cost = 0.5f;
            });
        return made;
    }();
    return all;
}

}  // namespace swath::test
