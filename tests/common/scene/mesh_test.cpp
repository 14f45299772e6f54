#include "common/scene/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/models.h"

namespace swath {
namespace {

using ::testing::HasSubstr;
using Normal = std::array<std::int16_t, 3>;

std::string why_not(const Mesh& mesh) {
    const Status status = validate(mesh);
    return status ? "valid" : status.error().message;
}

TEST(MeshTest, a_cube_is_valid) { EXPECT_EQ(why_not(test::cube()), "valid"); }

TEST(MeshTest, a_mesh_without_triangles_is_invalid) {
    Mesh mesh = test::cube();
    mesh.indices.clear();
    EXPECT_EQ(why_not(mesh), "no triangles");
    EXPECT_EQ(why_not(Mesh{}), "no triangles");
}

TEST(MeshTest, a_triangle_that_is_cut_off_is_invalid) {
    Mesh mesh = test::cube();
    mesh.indices.pop_back();
    EXPECT_THAT(why_not(mesh), HasSubstr("35 indices"));
}

TEST(MeshTest, indices_out_of_range_are_counted_and_the_first_is_named) {
    Mesh mesh = test::cube();
    mesh.indices[7] = 8;
    mesh.indices[20] = 0xffffffff;
    EXPECT_EQ(why_not(mesh), "2 indices out of range, the first in triangle 2: 8 of 8 vertices");
}

TEST(MeshTest, coordinates_that_no_picture_can_hold_are_counted_and_the_first_is_named) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 1.1e18f, -3e38f}) {
        Mesh mesh = test::cube();
        mesh.vertices[3].position.y = bad;
        mesh.vertices[6].position.z = bad;
        EXPECT_THAT(why_not(mesh), HasSubstr("2 vertices not finite or beyond 1e+18, the first is vertex 3"));
    }
    EXPECT_EQ(why_not(test::cube(kMaxCoordinate)), "valid");
}

TEST(MeshTest, material_numbers_are_none_or_one_a_triangle_and_below_their_limit) {
    Mesh mesh = test::cube();
    EXPECT_EQ(mesh.material(11), 0u);
    mesh.materials.assign(11, 3);
    EXPECT_EQ(why_not(mesh), "11 material numbers for 12 triangles");
    mesh.materials.push_back(kMaxMaterials - 1);
    EXPECT_EQ(why_not(mesh), "valid");
    EXPECT_EQ(mesh.material(11), kMaxMaterials - 1);
    mesh.materials[4] = mesh.materials[9] = kMaxMaterials;
    EXPECT_EQ(why_not(mesh),
              "2 material numbers out of range, the first of triangle 4: 1048576, the limit is 1048575");
}

TEST(MeshTest, a_motion_is_none_or_one_a_vertex_and_ends_where_a_coordinate_may_be) {
    Mesh mesh = test::cube(2);
    mesh.motion.assign(7, glm::vec3(1));
    EXPECT_EQ(why_not(mesh), "7 motions for 8 vertices");
    mesh.motion.push_back(glm::vec3(-1e18f));
    EXPECT_EQ(why_not(mesh), "valid");
    mesh.motion[2].y = std::numeric_limits<float>::quiet_NaN();
    mesh.motion[5] = {0, 0, 3e38f};
    EXPECT_EQ(
        why_not(mesh),
        "2 vertices move to where they are not finite or beyond 1e+18, the first is vertex 2: by 1 nan 1");
    // Each is a valid coordinate, but their sum is not.
    mesh = test::cube(kMaxCoordinate);
    mesh.motion.assign(8, glm::vec3(0, 0, kMaxCoordinate));
    EXPECT_THAT(why_not(mesh), HasSubstr("4 vertices move to"));
}

TEST(MeshTest, a_vertex_goes_straight_from_where_it_is_to_where_its_motion_ends) {
    Mesh mesh = test::cube(2);
    EXPECT_EQ(posed(mesh, 7, 0.5f), glm::vec3(2));
    mesh.motion.assign(8, glm::vec3(0));
    mesh.motion[7] = {4, -2, 0};
    EXPECT_EQ(posed(mesh, 7, 0), glm::vec3(2));
    EXPECT_EQ(posed(mesh, 7, 0.25f), glm::vec3(3, 1.5f, 2));
    EXPECT_EQ(posed(mesh, 7, 1), glm::vec3(6, 0, 2));
    EXPECT_EQ(bounds(mesh), (Box{glm::vec3(0), glm::vec3(2)}));
    EXPECT_EQ(bounds(mesh, 0.25f), (Box{glm::vec3(0), glm::vec3(3, 2, 2)}));
}

TEST(MeshTest, triangles_without_area_are_valid) {
    Mesh mesh = test::cube();
    mesh.indices[1] = mesh.indices[0];
    EXPECT_EQ(why_not(mesh), "valid");
}

TEST(MeshTest, a_packed_normal_has_unit_length_whatever_it_was_made_of) {
    EXPECT_EQ(pack_normal({5, 0, 0}), (Normal{32767, 0, 0}));
    EXPECT_EQ(pack_normal({0, -1e-30f, 0}), (Normal{0, -32767, 0}));
    EXPECT_EQ(pack_normal({0, 3e38f, 0}), (Normal{0, 32767, 0}));
    EXPECT_EQ(pack_normal({1, 1, 1}), (Normal{18918, 18918, 18918}));
}

TEST(MeshTest, what_has_no_direction_packs_to_plus_z) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(pack_normal({0, 0, 0}), (Normal{0, 0, 32767}));
    EXPECT_EQ(pack_normal({nan, 0, 1}), (Normal{0, 0, 32767}));
    EXPECT_EQ(pack_normal({std::numeric_limits<float>::infinity(), 0, 1}), (Normal{0, 0, 32767}));
}

TEST(MeshTest, computed_normals_are_weighted_by_area) {
    // A vertex with a triangle of area 2 facing +z and one of area 0.5 facing +x.
    Mesh mesh;
    for (const glm::vec3& position : {glm::vec3(0, 0, 0), glm::vec3(2, 0, 0), glm::vec3(0, 2, 0),
                                      glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        mesh.vertices.emplace_back();
        mesh.vertices.back().position = position;
    }
    mesh.indices = {0, 1, 2, 0, 3, 4};
    compute_normals(mesh);
    EXPECT_EQ(mesh.vertices[0].normal, pack_normal({0.5f, 0, 2}));
    EXPECT_EQ(mesh.vertices[1].normal, (Normal{0, 0, 32767}));
    EXPECT_EQ(mesh.vertices[3].normal, (Normal{32767, 0, 0}));
}

TEST(MeshTest, a_cubes_computed_normals_point_outwards_at_every_scale) {
    for (const float size : {1e-30f, 1.0f, 1e18f}) {
        const Mesh mesh = test::cube(size);
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                const int normal =
                    mesh.vertices[static_cast<std::size_t>(corner)].normal[static_cast<std::size_t>(axis)];
                EXPECT_GT((corner >> axis & 1) != 0 ? normal : -normal, 8000) << "corner " << corner;
            }
    }
}

TEST(MeshTest, a_vertex_without_area_gets_plus_z) {
    Mesh mesh = test::cube();
    mesh.vertices.emplace_back();
    mesh.vertices.back().normal = {1, 2, 3};
    for (std::uint32_t& index : mesh.indices) index = 0;
    compute_normals(mesh);
    EXPECT_EQ(mesh.vertices[0].normal, (Normal{0, 0, 32767}));
    EXPECT_EQ(mesh.vertices[8].normal, (Normal{0, 0, 32767}));
}

TEST(MeshTest, bounds_leave_unreferenced_vertices_out) {
    Mesh mesh = test::cube(2);
    mesh.vertices.emplace_back();
    mesh.vertices.back().position = {100, 0, 0};
    EXPECT_EQ(bounds(mesh), (Box{glm::vec3(0), glm::vec3(2)}));
    EXPECT_TRUE(bounds(Mesh{}).empty());
}

}  // namespace
}  // namespace swath
