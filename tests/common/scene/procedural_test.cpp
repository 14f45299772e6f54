#include "common/scene/procedural.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "common/scene/model_blob.h"
#include "common/scene/objects.h"

namespace swath {
namespace {

using ::testing::HasSubstr;

Mesh make(const std::string& name, std::size_t triangles) {
    Result<Mesh> mesh = make_builtin(name, triangles);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return mesh ? *std::move(mesh) : Mesh{};
}

glm::dvec2 flat(const glm::vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

// Twice the signed area of a, b, p.
double side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// True if a line along `axis` through `at` passes inside triangle t.
bool passes(const Mesh& mesh, std::size_t t, int axis, const glm::dvec2& at) {
    const glm::dvec2 a = flat(mesh.vertices[mesh.indices[3 * t]].position, axis);
    const glm::dvec2 b = flat(mesh.vertices[mesh.indices[3 * t + 1]].position, axis);
    const glm::dvec2 c = flat(mesh.vertices[mesh.indices[3 * t + 2]].position, axis);
    const double u = side(a, b, at);
    const double v = side(b, c, at);
    const double w = side(c, a, at);
    return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

TEST(ProceduralTest, there_is_a_knot_a_field_of_spheres_a_town_a_hand_and_a_swarm) {
    std::set<std::string> names;
    for (const BuiltinModel& model : builtin_models()) names.insert(model.name);
    EXPECT_EQ(names, (std::set<std::string>{"knot", "spheres", "town", "hand", "swarm"}));
}

TEST(ProceduralTest, every_model_is_valid_and_as_large_as_wished_within_5_percent) {
    for (const BuiltinModel& model : builtin_models())
        for (const std::size_t wish : {1000u, 3001u, 10'000u, 33'333u, 100'000u, 1'000'000u}) {
            const Mesh mesh = make(model.name, wish);
            EXPECT_TRUE(validate(mesh)) << model.name << ' ' << wish;
            const double count = static_cast<double>(mesh.triangle_count());
            EXPECT_NEAR(count, static_cast<double>(wish), 0.05 * static_cast<double>(wish)) << model.name;
        }
}

TEST(ProceduralTest, small_wishes_are_met_roughly) {
    for (const BuiltinModel& model : builtin_models())
        for (std::size_t wish = 12; wish < 1000; wish += 7) {
            const Mesh mesh = make(model.name, wish);
            EXPECT_TRUE(validate(mesh));
            EXPECT_LE(mesh.triangle_count(), wish + wish / 4) << model.name << ' ' << wish;
            EXPECT_GE(mesh.triangle_count(), wish - wish / 4) << model.name << ' ' << wish;
        }
}

TEST(ProceduralTest, the_default_is_a_million_triangles_and_the_papers_number_for_the_hand) {
    for (const BuiltinModel& model : builtin_models())
        EXPECT_EQ(model.default_triangles, model.name == "hand" ? 654'666u : 1'000'000u);
}

TEST(ProceduralTest, the_models_have_the_same_bits_on_every_machine) {
    const auto hex = [](const std::string& name) {
        return to_hex(digest(write_blob(make(name, 10'000)).bytes()));
    };
    // From g++ and clang++ on x86-64. Only a change of a formula may change them.
    EXPECT_EQ(hex("knot"), "ff1d3fa7640fa4b375e56462c6a6aac06ddb77a7fb2f13835f1b1acec4bff97e");
    EXPECT_EQ(hex("spheres"), "09313ffddc5998214560abc82366cdf9ab50d2a10a6e49a0e7b8d5c99bd6be2c");
    EXPECT_EQ(hex("town"), "c2393ee12d73b7746e8cc66d1d2f0301dbbdbdb546048f698a558e8439e929c0");
    EXPECT_EQ(hex("hand"), "427f5d0aac85d0e2f5c36cc2188a14d70eb9b17421eb458781bac05f406a370f");
    EXPECT_EQ(hex("swarm"), "f8506d25e13f9db99abaf4dc749f3e4dec0b847656f2b4591ba53a682c3c42bf");
}

TEST(ProceduralTest, a_wish_out_of_the_limits_is_refused) {
    for (const BuiltinModel& model : builtin_models())
        for (const std::size_t wish :
             {std::size_t{0}, std::size_t{11}, std::size_t{50'000'001}, ~std::size_t{0}}) {
            const Result<Mesh> mesh = make_builtin(model.name, wish);
            ASSERT_FALSE(mesh);
            EXPECT_THAT(mesh.error().message, HasSubstr("the limits are 12 and 50000000"));
        }
}

TEST(ProceduralTest, an_unknown_name_is_refused_with_the_list_of_names) {
    EXPECT_EQ(make_builtin("teapot", 1000).error().message,
              "no built-in model `teapot`, there are: knot, spheres, town, hand, swarm");
}

TEST(ProceduralTest, the_knot_is_closed_smooth_and_of_even_triangles) {
    const Mesh mesh = make("knot", 100'000);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::vector<double> areas;
    double agreement = 1;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t* corner = &mesh.indices[3 * t];
        for (int c = 0; c < 3; ++c) ++edges[{corner[c], corner[(c + 1) % 3]}];
        const glm::dvec3 a(mesh.vertices[corner[0]].position);
        const glm::dvec3 across = glm::cross(glm::dvec3(mesh.vertices[corner[1]].position) - a,
                                             glm::dvec3(mesh.vertices[corner[2]].position) - a);
        areas.push_back(glm::length(across));
        const auto& n = mesh.vertices[corner[0]].normal;
        agreement =
            std::min(agreement, glm::dot(glm::normalize(across), glm::dvec3(n[0], n[1], n[2]) / 32767.0));
    }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first})) << "an edge is open";
    }
    EXPECT_GT(agreement, 0.85) << "a normal is far from its triangle's";
    std::sort(areas.begin(), areas.end());
    EXPECT_LT(areas[areas.size() * 99 / 100] / areas[areas.size() / 100], 6) << "triangles are uneven";
}

TEST(ProceduralTest, triangles_face_the_way_that_their_normals_point) {
    for (const BuiltinModel& model : builtin_models()) {
        const Mesh mesh = make(model.name, 70'000);
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            const auto corner = [&](std::size_t c) -> const Vertex& {
                return mesh.vertices[mesh.indices[3 * t + c]];
            };
            const glm::dvec3 a(corner(0).position);
            const glm::dvec3 across =
                glm::cross(glm::dvec3(corner(1).position) - a, glm::dvec3(corner(2).position) - a);
            const glm::dvec3 normal(corner(0).normal[0], corner(0).normal[1], corner(0).normal[2]);
            ASSERT_GT(glm::dot(across, normal), 0) << model.name << " triangle " << t;
        }
    }
}

TEST(ProceduralTest, the_spheres_lie_more_than_ten_deep_along_every_axis) {
    const Mesh mesh = make("spheres", 70'000);
    const Box box = bounds(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        constexpr int kRays = 6;  // each way, in the middle third
        int hits = 0;
        for (int i = 0; i < kRays * kRays; ++i) {
            const double u = 1.0 / 3 + (i % kRays + 0.5) / (3.0 * kRays);
            const double v = 1.0 / 3 + (i / kRays + 0.5) / (3.0 * kRays);
            const glm::dvec2 low = flat(box.min, axis);
            const glm::dvec2 at = low + glm::dvec2(u, v) * (flat(box.max, axis) - low);
            for (std::size_t t = 0; t < mesh.triangle_count(); ++t) hits += passes(mesh, t, axis, at) ? 1 : 0;
        }
        EXPECT_GT(hits, 10 * kRays * kRays) << "axis " << axis;
    }
}

TEST(ProceduralTest, the_spheres_have_many_colours) {
    const Mesh mesh = make("spheres", 70'000);
    std::set<std::array<std::uint8_t, 4>> colours;
    for (const Vertex& vertex : mesh.vertices) colours.insert(vertex.colour);
    EXPECT_GT(colours.size(), 500u);
}

TEST(ProceduralTest, the_towns_coplanar_faces_overlap_across_objects_in_different_colours) {
    const ObjectSet set = build_objects(make("town", 10'000), {.depth = 3, .objects = 0});
    const Mesh& mesh = set.mesh;
    const auto position = [&](std::size_t t, std::size_t c) {
        return mesh.vertices[mesh.indices[3 * t + c]].position;
    };
    std::vector<std::size_t> owner(mesh.triangle_count());
    for (std::size_t id = 0; id < set.objects.size(); ++id)
        for (std::uint32_t i = 0; i < set.objects[id].triangle_count; ++i)
            owner[set.objects[id].first_triangle + i] = id;

    std::map<std::pair<int, float>, std::vector<std::size_t>> planes;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        for (int axis = 0; axis < 3; ++axis) {
            const float at = position(t, 0)[axis];
            if (position(t, 1)[axis] == at && position(t, 2)[axis] == at) planes[{axis, at}].push_back(t);
        }
    std::array<int, 3> ties{};
    for (const auto& [plane, triangles] : planes)
        for (const std::size_t a : triangles) {
            const int axis = plane.first;
            const glm::dvec2 centre =
                (flat(position(a, 0), axis) + flat(position(a, 1), axis) + flat(position(a, 2), axis)) / 3.0;
            for (const std::size_t b : triangles)
                if (owner[a] != owner[b] && passes(mesh, b, axis, centre) &&
                    mesh.vertices[mesh.indices[3 * a]].colour != mesh.vertices[mesh.indices[3 * b]].colour)
                    ++ties[static_cast<std::size_t>(axis)];
        }
    for (const int count : ties) EXPECT_GT(count, 100);
}

TEST(ProceduralTest, the_towns_faces_are_flat) {
    const Mesh mesh = make("town", 10'000);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        for (std::size_t c = 1; c < 3; ++c) {
            const Vertex& first = mesh.vertices[mesh.indices[3 * t]];
            const Vertex& other = mesh.vertices[mesh.indices[3 * t + c]];
            ASSERT_EQ(first.normal, other.normal);
            ASSERT_EQ(first.colour, other.colour);
        }
}

// Numbers the connected pieces of a mesh; one number for each triangle.
std::vector<std::size_t> pieces(const Mesh& mesh) {
    std::vector<std::size_t> root(mesh.vertices.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        for (std::size_t c = 1; c < 3; ++c) root[find(mesh.indices[3 * t + c])] = find(mesh.indices[3 * t]);
    std::vector<std::size_t> piece;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) piece.push_back(find(mesh.indices[3 * t]));
    return piece;
}

TEST(ProceduralTest, the_hand_has_29_bones_and_each_is_closed) {
    const Mesh mesh = make("hand", 30'000);
    const std::vector<std::size_t> piece = pieces(mesh);
    EXPECT_EQ(std::set<std::size_t>(piece.begin(), piece.end()).size(), 29u);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_TRUE(edges.insert({mesh.indices[3 * t + c], mesh.indices[3 * t + (c + 1) % 3]}).second);
    for (const auto& [from, to] : edges) ASSERT_TRUE(edges.contains({to, from})) << "an edge is open";
}

TEST(ProceduralTest, the_hands_bones_are_the_right_way_out_and_of_bony_sizes) {
    const Mesh mesh = make("hand", 30'000);
    const std::vector<std::size_t> piece = pieces(mesh);
    std::map<std::size_t, double> volume;  // of each bone, by the divergence theorem
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto corner = [&](std::size_t c) {
            return glm::dvec3(mesh.vertices[mesh.indices[3 * t + c]].position);
        };
        volume[piece[t]] += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6;
    }
    for (const auto& [bone, size] : volume) {
        EXPECT_GT(size, 200) << "cubic millimetres of bone " << bone;
        EXPECT_LT(size, 30'000) << "cubic millimetres of bone " << bone;
    }
}

TEST(ProceduralTest, the_swarms_spheres_keep_their_shape_and_only_they_move) {
    for (const BuiltinModel& model : builtin_models())
        EXPECT_EQ(make(model.name, 10'000).motion.empty(), model.name != "swarm") << model.name;
    const Mesh mesh = make("swarm", 100'000);
    ASSERT_EQ(mesh.motion.size(), mesh.vertices.size());
    const std::vector<std::size_t> piece = pieces(mesh);
    EXPECT_EQ(std::set<std::size_t>(piece.begin(), piece.end()).size(), 500u);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_EQ(mesh.motion[mesh.indices[3 * t + c]], mesh.motion[piece[t]]);
}

// Triangles that share a cell of an octree at pose 0 are spread out at pose 1.
TEST(ProceduralTest, the_swarm_leaves_nobody_where_he_was) {
    const ObjectSet set = build_objects(make("swarm", 100'000), {.depth = 3, .objects = 0});
    double start = 0;
    double end = 0;
    for (const Object& object : set.objects) {
        const auto half_area = [](const glm::dvec3& size) {
            return size.x * size.y + size.y * size.z + size.z * size.x;
        };
        start += half_area(glm::dvec3(object.box.size()));
        end += half_area(glm::dvec3(object.end_box.size()));
    }
    EXPECT_GT(end, 8 * start);
}

TEST(ProceduralTest, the_hand_is_cut_into_about_as_many_objects_as_the_papers) {
    const Mesh mesh = make("hand", 654'666);
    EXPECT_NEAR(static_cast<double>(mesh.triangle_count()), 654'666, 100);
    const ObjectSet set = build_objects(mesh, {.depth = 4, .objects = 0});
    EXPECT_NEAR(static_cast<double>(set.objects.size()), 643, 25);  // 643 in Samanta 2000
    const glm::vec3 size = set.bounds.size();
    EXPECT_LT(size.z, 0.4f * size.x);
    EXPECT_LT(size.z, 0.25f * size.y);
}

}  // namespace
}  // namespace swath
