#include "common/scene/objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "common/base/check.h"
#include "common/scene/model.h"
#include "common/scene/model_blob.h"
#include "tests/support/models.h"

namespace swath {
namespace {

ObjectSet at_depth(Mesh mesh, int depth) {
    return build_objects(std::move(mesh), {.depth = depth, .objects = 0});
}
ObjectSet by_count(Mesh mesh, std::size_t objects) {
    return build_objects(std::move(mesh), {.depth = {}, .objects = objects});
}

// The numbers of a triangle's three vertices, which can be compared.
using Corners = std::array<std::array<float, 4>, 3>;
Corners corners_of(const Mesh& mesh, std::size_t triangle) {
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c) {
        const Vertex& v = mesh.vertices[mesh.indices[3 * triangle + c]];
        corners[c] = {v.position.x, v.position.y, v.position.z, static_cast<float>(v.colour[0])};
    }
    return corners;
}

// Counts each triangle of each material.
std::map<std::pair<Corners, std::uint32_t>, int> triangles_of(const Mesh& mesh) {
    std::map<std::pair<Corners, std::uint32_t>, int> result;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) ++result[{corners_of(mesh, t), mesh.material(t)}];
    return result;
}

bool encloses(const Box& outer, const Box& inner) {
    Box both = outer;
    both.extend(inner);
    return both == outer;
}

// Finds the plain way in which of the 2^depth cells an axis a triangle's centre lies.
std::array<int, 3> cell_of(const ObjectSet& set, std::size_t triangle) {
    Box box;
    for (std::size_t c = 0; c < 3; ++c)
        box.extend(set.mesh.vertices[set.mesh.indices[3 * triangle + c]].position);
    std::array<int, 3> cell{};
    for (int axis = 0; axis < 3; ++axis) {
        double low = double{set.bounds.min[axis]};
        double high = double{set.bounds.max[axis]};
        const double centre = (double{box.min[axis]} + double{box.max[axis]}) / 2;
        for (int level = 0; level < set.cut.depth; ++level) {
            const double middle = (low + high) / 2;
            const bool upper = high > low && centre >= middle;
            (upper ? low : high) = middle;
            int& number = cell[static_cast<std::size_t>(axis)];
            number = 2 * number + (upper ? 1 : 0);
        }
    }
    return cell;
}

TEST(ObjectsTest, objects_cover_all_triangles_in_contiguous_ranges) {
    for (const int depth : {0, 1, 2, 4, 7, 10}) {
        const ObjectSet set = at_depth(test::triangle_soup(3000, 7), depth);
        EXPECT_EQ(set.cut.depth, depth);
        std::uint32_t next = 0;
        for (const Object& object : set.objects) {
            EXPECT_EQ(object.first_triangle, next);
            EXPECT_GT(object.triangle_count, 0u);
            next += object.triangle_count;
        }
        EXPECT_EQ(next, set.mesh.triangle_count());
    }
}

TEST(ObjectsTest, no_triangle_is_lost_changed_or_added) {
    const Mesh mesh = test::triangle_soup(3000, 7);
    EXPECT_EQ(triangles_of(at_depth(mesh, 5).mesh), triangles_of(mesh));
}

TEST(ObjectsTest, an_object_is_the_triangles_whose_centres_share_a_cell) {
    for (const int depth : {1, 3, 5}) {
        const ObjectSet set = at_depth(test::triangle_soup(3000, 7), depth);
        std::map<std::array<int, 3>, std::size_t> owner;
        for (std::size_t id = 0; id < set.objects.size(); ++id)
            for (std::uint32_t i = 0; i < set.objects[id].triangle_count; ++i) {
                const auto cell = cell_of(set, set.objects[id].first_triangle + i);
                EXPECT_EQ(owner.try_emplace(cell, id).first->second, id);
            }
        EXPECT_EQ(owner.size(), set.objects.size());
    }
}

TEST(ObjectsTest, a_box_is_that_of_its_whole_triangles) {
    const ObjectSet set = at_depth(test::triangle_soup(3000, 7), 3);
    Box all;
    for (const Object& object : set.objects) {
        Box box;
        for (std::uint32_t i = 0; i < 3 * object.triangle_count; ++i)
            box.extend(set.mesh.vertices[set.mesh.indices[3 * object.first_triangle + i]].position);
        EXPECT_EQ(object.box, box);
        EXPECT_TRUE(encloses(set.bounds, box));
        all.extend(box);
    }
    EXPECT_EQ(set.bounds, all);
}

TEST(ObjectsTest, boxes_are_around_what_moves_at_every_pose) {
    Mesh mesh = test::triangle_soup(3000, 7);
    const Mesh elsewhere = test::triangle_soup(3000, 8);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        mesh.motion.push_back(3.0f * elsewhere.vertices[i].position - mesh.vertices[i].position);
    const ObjectSet set = at_depth(mesh, 3);
    EXPECT_TRUE(set.moves());
    ASSERT_EQ(set.mesh.motion.size(), set.mesh.vertices.size());
    // Vertices keep their values.
    EXPECT_EQ(bounds(set.mesh, 1), bounds(mesh, 1));
    EXPECT_EQ(set.end_bounds, bounds(mesh, 1));
    EXPECT_TRUE(encloses(set.swept_bounds(), set.end_bounds));
    for (const float pose : {0.0f, 1e-9f, 0.1f, 1.0f / 3, 0.5f, 0.77f, 0.9999999f, 1.0f}) {
        EXPECT_TRUE(encloses(set.bounds_at(pose), bounds(mesh, pose)));
        EXPECT_TRUE(encloses(set.swept_bounds(), set.bounds_at(pose)));
        for (const Object& object : set.objects) {
            EXPECT_TRUE(encloses(set.bounds_at(pose), object.box_at(pose)));
            for (std::uint32_t i = object.first_leaf; i < object.first_leaf + object.leaf_count; ++i) {
                const Leaf& leaf = set.leaves[i];
                EXPECT_TRUE(encloses(object.box_at(pose), leaf.box_at(pose)));
                Box box;
                for (std::uint32_t c = 0; c < 3 * leaf.triangle_count; ++c)
                    box.extend(posed(set.mesh, set.mesh.indices[3 * leaf.first_triangle + c], pose));
                EXPECT_TRUE(encloses(leaf.box_at(pose), box));
            }
        }
    }
}

TEST(ObjectsTest, a_model_that_does_not_move_has_its_boxes_at_every_pose) {
    const ObjectSet set = at_depth(test::triangle_soup(300, 7), 2);
    EXPECT_FALSE(set.moves());
    EXPECT_EQ(set.bounds_at(0.5f), set.bounds);
    EXPECT_EQ(set.swept_bounds(), set.bounds);
    for (const Object& object : set.objects) EXPECT_EQ(object.box_at(0.5f), object.box);
    for (const Leaf& leaf : set.leaves) EXPECT_EQ(leaf.box_at(0.5f), leaf.box);
}

TEST(ObjectsTest, the_order_of_triangles_and_vertices_is_the_same_at_every_depth) {
    const Mesh mesh = test::triangle_soup(3000, 7);
    const Mesh expected = at_depth(mesh, 0).mesh;
    for (int depth = 1; depth <= kMaxOctreeDepth; ++depth) EXPECT_EQ(at_depth(mesh, depth).mesh, expected);
}

TEST(ObjectsTest, a_deeper_cut_divides_the_objects_of_a_shallower_one) {
    const Mesh mesh = test::triangle_soup(3000, 7);
    for (int depth = 0; depth < kMaxOctreeDepth; ++depth) {
        const ObjectSet coarse = at_depth(mesh, depth);
        const ObjectSet fine = at_depth(mesh, depth + 1);
        EXPECT_LE(coarse.objects.size(), fine.objects.size());
        std::size_t at = 0;
        for (const Object& object : coarse.objects) {
            while (fine.objects[at].first_triangle < object.first_triangle) ++at;
            EXPECT_EQ(fine.objects[at].first_triangle, object.first_triangle);
        }
    }
}

TEST(ObjectsTest, vertices_are_numbered_by_first_use_and_the_unused_are_dropped) {
    Mesh mesh = test::triangle_soup(500, 3);
    mesh.vertices.resize(mesh.vertices.size() + 100);
    const ObjectSet set = at_depth(mesh, 4);
    std::uint32_t next = 0;
    for (const std::uint32_t index : set.mesh.indices) {
        EXPECT_LE(index, next);
        next = std::max(next, index + 1);
    }
    EXPECT_EQ(next, set.mesh.vertices.size());
}

TEST(ObjectsTest, a_far_vertex_that_nothing_uses_does_not_stretch_the_cells) {
    Mesh mesh = test::triangle_soup(500, 3);
    const ObjectSet before = at_depth(mesh, 4);
    mesh.vertices.emplace_back();
    mesh.vertices.back().position = {1e6f, 0, 0};
    const ObjectSet after = at_depth(mesh, 4);
    EXPECT_EQ(after.objects, before.objects);
    EXPECT_EQ(after.bounds, before.bounds);
}

TEST(ObjectsTest, triangles_of_one_cell_keep_the_models_order) {
    // Copies of one triangle, told apart by colour.
    Mesh mesh;
    for (std::uint32_t t = 0; t < 50; ++t)
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            Vertex vertex;
            vertex.position = {static_cast<float>(corner == 1), static_cast<float>(corner == 2), 0};
            vertex.colour[0] = static_cast<std::uint8_t>(t);
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.push_back(vertex);
        }
    EXPECT_EQ(at_depth(mesh, 10).mesh, mesh);
    EXPECT_EQ(at_depth(mesh, 10).objects.size(), 1u);
}

TEST(ObjectsTest, a_flat_model_is_cut_along_its_other_axes) {
    Mesh mesh = test::triangle_soup(3000, 7);
    for (Vertex& vertex : mesh.vertices) vertex.position.z = 5;
    const ObjectSet set = at_depth(mesh, 2);
    EXPECT_GT(set.objects.size(), 8u);
    EXPECT_LE(set.objects.size(), 16u);
}

TEST(ObjectsTest, a_single_point_is_one_object) {
    Mesh mesh = test::cube(0);
    const ObjectSet set = by_count(mesh, 100);
    EXPECT_EQ(set.objects.size(), 1u);
    EXPECT_EQ(set.cut.depth, 0);
}

TEST(ObjectsTest, the_largest_and_the_smallest_coordinates_are_cut_alike) {
    const Mesh mesh = test::triangle_soup(500, 3);
    const std::size_t expected = at_depth(mesh, 4).objects.size();
    for (const float scale : {0x1p-80f, 0x1p50f}) {
        Mesh scaled = mesh;
        for (Vertex& vertex : scaled.vertices) vertex.position *= scale;
        EXPECT_EQ(at_depth(scaled, 4).objects.size(), expected);
    }
}

TEST(ObjectsTest, a_number_of_objects_picks_the_depth_that_comes_closest) {
    const Mesh mesh = test::triangle_soup(3000, 7);
    std::array<std::size_t, kMaxOctreeDepth + 1> counts{};
    for (int depth = 0; depth <= kMaxOctreeDepth; ++depth)
        counts[static_cast<std::size_t>(depth)] = at_depth(mesh, depth).objects.size();
    for (const std::size_t wish : {0u, 1u, 4u, 5u, 30u, 300u, 1500u, 100000u}) {
        const auto distance = [&](std::size_t count) { return count > wish ? count - wish : wish - count; };
        const auto best = std::min_element(counts.begin(), counts.end(), [&](std::size_t a, std::size_t b) {
            return distance(a) < distance(b);
        });
        EXPECT_EQ(by_count(mesh, wish).cut.depth, best - counts.begin()) << "wish " << wish;
    }
}

TEST(ObjectsTest, the_shallower_of_two_equally_close_depths_is_picked) {
    // Three specks in three corners: one object at depth 0, three from depth 1 on.
    Mesh mesh;
    for (const glm::vec3& corner : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 1)})
        for (int i = 0; i < 3; ++i) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.emplace_back();
            mesh.vertices.back().position = corner;
        }
    EXPECT_EQ(by_count(mesh, 2).cut.depth, 0);
    EXPECT_EQ(by_count(mesh, 3).cut.depth, 1);
    EXPECT_EQ(by_count(mesh, 1000).cut.depth, 1);
}

TEST(ObjectsTest, the_same_mesh_gives_the_same_objects) {
    const ObjectSet a = by_count(test::triangle_soup(3000, 7), 200);
    const ObjectSet b = by_count(test::triangle_soup(3000, 7), 200);
    EXPECT_EQ(a.objects, b.objects);
    EXPECT_EQ(a.mesh, b.mesh);
}

// Materials in no order, with numbers that leave gaps.
Mesh painted(Mesh mesh, std::uint32_t materials) {
    mesh.materials.clear();
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
        mesh.materials.push_back((t * 2654435761u >> 8) % materials * 3001);
    return mesh;
}

TEST(ObjectsTest, an_object_has_one_material_and_ascending_ids_group_equal_ones) {
    const Mesh mesh = painted(test::triangle_soup(3000, 7), 9);
    for (const int depth : {0, 2, 5}) {
        const ObjectSet set = at_depth(mesh, depth);
        std::uint32_t last = 0;
        for (const Object& object : set.objects) {
            EXPECT_GE(object.material, last);
            last = object.material;
            for (std::uint32_t i = 0; i < object.triangle_count; ++i)
                ASSERT_EQ(set.mesh.material(object.first_triangle + i), object.material);
        }
        EXPECT_EQ(set.objects.front().material, 0u);
        EXPECT_EQ(last, 8u * 3001);
    }
    EXPECT_EQ(at_depth(mesh, 0).objects.size(), 9u);
}

TEST(ObjectsTest, a_model_of_many_materials_keeps_its_order_of_triangles_at_every_depth) {
    const Mesh mesh = painted(test::triangle_soup(3000, 7), 30);
    const ObjectSet flat = at_depth(mesh, 0);
    EXPECT_EQ(triangles_of(flat.mesh), triangles_of(mesh));
    for (int depth = 1; depth <= kMaxOctreeDepth; ++depth) EXPECT_EQ(at_depth(mesh, depth).mesh, flat.mesh);
}

TEST(ObjectsTest, a_number_of_objects_counts_cells_of_each_material) {
    const Mesh mesh = painted(test::triangle_soup(3000, 7), 9);
    for (const std::size_t wish : {1u, 9u, 40u, 300u, 1500u}) {
        const ObjectSet set = by_count(mesh, wish);
        const auto distance = [&](int depth) {
            const auto count = static_cast<std::ptrdiff_t>(at_depth(mesh, depth).objects.size());
            return std::abs(count - static_cast<std::ptrdiff_t>(wish));
        };
        for (int depth = 0; depth <= kMaxOctreeDepth; ++depth)
            EXPECT_GE(distance(depth), distance(set.cut.depth)) << wish << " at " << depth;
    }
}

TEST(ObjectsTest, leaves_cut_every_object_into_even_runs_with_their_boxes) {
    for (const std::uint32_t size : {1u, 7u, 256u, 0xffff'ffffu}) {
        const ObjectSet set =
            build_objects(painted(test::triangle_soup(3000, 7), 2), {.depth = 2, .leaf_triangles = size});
        std::uint32_t leaf = 0;
        std::uint32_t triangle = 0;
        for (const Object& object : set.objects) {
            EXPECT_EQ(object.first_leaf, leaf);
            EXPECT_EQ(object.leaf_count, (std::uint64_t{object.triangle_count} + size - 1) / size);
            for (; leaf < object.first_leaf + object.leaf_count; ++leaf) {
                const Leaf& part = set.leaves[leaf];
                EXPECT_EQ(part.first_triangle, triangle);
                EXPECT_LE(part.triangle_count, size);
                EXPECT_GE(part.triangle_count, object.triangle_count / object.leaf_count);
                Box box;
                for (std::uint32_t i = 0; i < 3 * part.triangle_count; ++i)
                    box.extend(set.mesh.vertices[set.mesh.indices[3 * triangle + i]].position);
                EXPECT_EQ(part.box, box);
                triangle += part.triangle_count;
            }
            EXPECT_EQ(triangle, object.first_triangle + object.triangle_count);
        }
        EXPECT_EQ(leaf, set.leaves.size());
    }
}

TEST(ObjectsTest, a_depth_out_of_range_is_our_own_mistake) {
    EXPECT_THROW(at_depth(test::cube(), 11), CheckFailed);
    EXPECT_THROW(at_depth(test::cube(), -1), CheckFailed);
    EXPECT_THROW(at_depth(Mesh{}, 1), CheckFailed);
}

TEST(ObjectsTest, the_dragon_has_1259_objects_at_depth_4) {
    SWATH_SHARED_MODEL(path, "dragon.ply");
    Result<Mesh> dragon = load_model(path);
    ASSERT_TRUE(dragon) << dragon.error().message;
    const ObjectSet set = at_depth(*dragon, 4);
    EXPECT_EQ(set.objects.size(), 1259u);
    EXPECT_EQ(set.mesh.triangle_count(), 871'414u);
    EXPECT_EQ(build_objects(*std::move(dragon), {}).cut.depth, 4);
}

}  // namespace
}  // namespace swath
