#include "common/scene/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/scene/procedural.h"
#include "tests/support/models.h"

namespace swath {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Colour = std::array<std::uint8_t, 4>;

std::string why_no_model(const std::string& name) {
    const Result<Mesh> mesh = load_model(name);
    return mesh ? "valid" : mesh.error().message;
}

constexpr const char* kObj =
    "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nusemtl red\nf 1 2 3 4\nl 1 5\np 5\n";
constexpr const char* kMtl = "newmtl red\nKd 1.0 0.5 0.0\n";

constexpr const char* kStl =
    "solid s\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 0 -1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid "
    "s\n";

constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

// A triangle (0,0,0) (1,0,0) (0,1,0), its normals +z, painted (1, 0.5, 0); `nodes` is the JSON of the nodes,
// of which node 0 is the root.
std::string gltf(const std::string& nodes) {
    // 9 floats of positions, then 9 of normals, then the indices 0 1 2 as bytes.
    const std::string base64 =
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
        "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
        "AAEC";
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":2,"componentType":5121,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},
{"buffer":0,"byteOffset":72,"byteLength":3}],
"buffers":[{"byteLength":75,"uri":"data:application/octet-stream;base64,)" +
           base64 + R"("}]})";
}

TEST(ModelTest, a_builtin_loads_by_name_and_number_of_triangles) {
    EXPECT_EQ(load_model("builtin:knot:5000"), make_builtin("knot", 5000));
    EXPECT_EQ(load_model("builtin:town"), make_builtin("town", 1'000'000));
    EXPECT_TRUE(is_builtin("builtin:knot"));
    EXPECT_FALSE(is_builtin("knot.ply"));
}

TEST(ModelTest, a_wrong_builtin_says_what_there_is) {
    EXPECT_EQ(why_no_model("builtin:cow"),
              "builtin:cow: no built-in model `cow`, there are: knot, spheres, town, hand, swarm");
    EXPECT_THAT(why_no_model("builtin:"), HasSubstr("there are: knot, spheres, town, hand, swarm"));
    EXPECT_EQ(why_no_model("builtin:knot:many"), "builtin:knot:many: `many` is no number of triangles");
    EXPECT_THAT(why_no_model("builtin:knot:"), HasSubstr("no number of triangles"));
    EXPECT_THAT(why_no_model("builtin:knot:-5"), HasSubstr("no number of triangles"));
    EXPECT_THAT(why_no_model("builtin:knot:5"), HasSubstr("the limits are 12 and 50000000"));
}

TEST(ModelTest, a_ply_file_is_known_by_its_ending_in_any_case) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.ply", "b.PLY", "c.Ply"}) {
        const Result<Mesh> mesh = load_model(folder.write(name, kPly));
        ASSERT_TRUE(mesh) << mesh.error().message;
        EXPECT_EQ(mesh->triangle_count(), 1u);
    }
}

TEST(ModelTest, an_error_names_the_file_once) {
    const test::TemporaryFolder folder;
    for (const std::string& path :
         {folder.path_of("missing.ply"), folder.path_of("missing.obj"), folder.write("broken.ply", "ply\n"),
          folder.write("text.ply", "hello"), folder.write("points.obj", "v 0 0 0\np 1\n"),
          folder.write("empty.stl", ""), folder.write("broken.gltf", "{"), folder.write("no.ending", "hello"),
          folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}) {
        const std::string why = why_no_model(path);
        EXPECT_THAT(why, StartsWith(path + ": "));
        EXPECT_THAT(why, ::testing::Not(StartsWith(path + ": " + path + ": ")));
        EXPECT_EQ(why.find('\n'), std::string::npos);
        EXPECT_GT(why.size(), path.size() + 5);
    }
}

TEST(ModelTest, an_obj_has_its_polygons_and_the_colours_of_its_materials) {
    const test::TemporaryFolder folder;
    folder.write("paint.mtl", kMtl);
    const Result<Mesh> mesh = load_model(folder.write("square.obj", kObj));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangle_count(), 2u) << "points and lines are dropped";
    EXPECT_EQ(mesh->vertices.size(), 4u);
    EXPECT_EQ(bounds(*mesh), (Box{{0, 0, 0}, {1, 1, 0}}));
    for (const Vertex& vertex : mesh->vertices) {
        EXPECT_EQ(vertex.colour, (Colour{255, 128, 0, 255}));
        EXPECT_EQ(vertex.normal, pack_normal({0, 0, 1}));
    }
}

TEST(ModelTest, an_obj_without_its_material_file_loads_all_the_same) {
    const test::TemporaryFolder folder;
    const Result<Mesh> mesh = load_model(folder.write("square.obj", kObj));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangle_count(), 2u);
}

TEST(ModelTest, an_objs_vertex_colours_win_over_its_material) {
    const test::TemporaryFolder folder;
    const Result<Mesh> mesh =
        load_model(folder.write("colours.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n"));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->vertices[0].colour, (Colour{255, 0, 0, 255}));
}

TEST(ModelTest, triangles_have_the_numbers_of_their_materials_unless_there_is_only_one) {
    const test::TemporaryFolder folder;
    folder.write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    const std::string corners = "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    const auto mesh =
        load_model(folder.write("two.obj", corners + "usemtl red\nf 1 2 3\nusemtl blue\nf 2 4 3\nf 1 4 2\n"));
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->materials.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t) {
        const bool red = mesh->vertices[mesh->indices[3 * t]].colour == Colour{255, 0, 0, 255};
        EXPECT_EQ(mesh->material(t) == mesh->material(0),
                  red == (mesh->vertices[mesh->indices[0]].colour == Colour{255, 0, 0, 255}));
    }
    EXPECT_NE(mesh->materials.front(), mesh->materials.back());
    const auto one = load_model(folder.write("one.obj", corners + "usemtl blue\nf 1 2 3\nf 2 4 3\n"));
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_TRUE(one->materials.empty());
}

TEST(ModelTest, an_stl_has_its_facets_normals_and_joined_vertices) {
    const test::TemporaryFolder folder;
    const Result<Mesh> mesh = load_model(folder.write("square.stl", kStl));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangle_count(), 2u);
    EXPECT_EQ(mesh->vertices.size(), 4u);
    for (const Vertex& vertex : mesh->vertices) EXPECT_EQ(vertex.normal, pack_normal({0, 0, -1}));
}

TEST(ModelTest, a_gltfs_nodes_are_flattened_with_their_transforms) {
    const test::TemporaryFolder folder;
    const std::string nodes = R"([{"children":[1,2],"translation":[10,0,0]},{"mesh":0,"scale":[2,3,4]},
{"mesh":0,"translation":[0,0,-7]}])";
    const Result<Mesh> mesh = load_model(folder.write("nodes.gltf", gltf(nodes)));
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->vertices.size(), 6u);
    EXPECT_EQ(mesh->vertices[1].position, glm::vec3(12, 0, 0));
    EXPECT_EQ(mesh->vertices[2].position, glm::vec3(10, 3, 0));
    EXPECT_EQ(mesh->vertices[4].position, glm::vec3(11, 0, -7));
    EXPECT_EQ(mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh->vertices[0].colour, (Colour{255, 128, 0, 255}));
}

TEST(ModelTest, normals_stay_across_their_surface_under_any_transform) {
    const test::TemporaryFolder folder;
    const auto normal_under = [&](const std::string& matrix) {
        const Result<Mesh> mesh =
            load_model(folder.write("m.gltf", gltf(R"([{"mesh":0,"matrix":[)" + matrix + "]}]")));
        return mesh ? mesh->vertices[0].normal : std::array<std::int16_t, 3>{};
    };
    // Matrices are by column. A shear of z along x tilts nothing: the surface stays in the plane z = 0 ...
    EXPECT_EQ(normal_under("1,0,0,0, 0,1,0,0, 5,0,1,0, 0,0,0,1"), pack_normal({0, 0, 1}));
    // ... one of x along z tilts the surface, and a scale squeezes it.
    EXPECT_EQ(normal_under("1,0,1,0, 0,1,0,0, 0,0,1,0, 0,0,0,1"), pack_normal({-1, 0, 1}));
    EXPECT_EQ(normal_under("1,0,1,0, 0,1,0,0, 0,0,9,0, 0,0,0,1"), pack_normal({-1, 0, 1}));
    // A mirror image keeps the side: x turns round, +z does not; a mirrored z does.
    EXPECT_EQ(normal_under("-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1"), pack_normal({0, 0, 1}));
    EXPECT_EQ(normal_under("1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1"), pack_normal({0, 0, -1}));
    // A flattened z has no inverse, but the surface has a normal.
    EXPECT_EQ(normal_under("1,0,0,0, 0,1,0,0, 0,0,0,0, 0,0,0,1"), pack_normal({0, 0, 1}));
}

TEST(ModelTest, a_node_that_moves_the_model_out_of_all_bounds_is_refused) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("far.gltf", gltf(R"([{"mesh":0,"translation":[1e30,0,0]}])"));
    EXPECT_THAT(why_no_model(path), HasSubstr("3 vertices not finite or beyond 1e+18"));
}

TEST(ModelTest, loading_is_deterministic) {
    const test::TemporaryFolder folder;
    folder.write("paint.mtl", kMtl);
    const std::string path = folder.write("square.obj", kObj);
    EXPECT_EQ(load_model(path), load_model(path));
}

TEST(ModelTest, the_shared_models_load) {
    struct Known {
        const char* name;
        std::size_t triangles;
        std::size_t colours;  // at least
    };
    bool any = false;
    for (const Known& known : {Known{"female02/female02.obj", 6'233, 1},
                               {"house/scene.gltf", 56'674, 2},
                               {"engine/2CylinderEngine.gltf", 121'496, 7}}) {
        const auto path = test::shared_model(known.name);
        if (!path) continue;
        any = true;
        const Result<Mesh> mesh = load_model(path->string());
        ASSERT_TRUE(mesh) << mesh.error().message;
        EXPECT_EQ(mesh->triangle_count(), known.triangles) << known.name;
        std::vector<Colour> colours;
        for (const Vertex& vertex : mesh->vertices) colours.push_back(vertex.colour);
        std::sort(colours.begin(), colours.end());
        colours.erase(std::unique(colours.begin(), colours.end()), colours.end());
        EXPECT_GE(colours.size(), known.colours) << known.name;
    }
    if (!any) GTEST_SKIP() << "no shared models found";
}

}  // namespace
}  // namespace swath
