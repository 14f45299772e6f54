#include "common/scene/sah_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "common/geometry/morton.h"
#include "common/scene/objects.h"
#include "tests/support/models.h"

namespace swath {
namespace {

Mesh soup(std::uint32_t materials) {
    Mesh mesh = test::triangle_soup(3000, 5);
    for (std::size_t t = 0; t < mesh.triangle_count() && materials > 1; ++t)
        mesh.materials.push_back(static_cast<std::uint32_t>(t * 7 % materials));
    return mesh;
}

ObjectSet by_sah(Mesh mesh, std::size_t objects) {
    return build_objects(std::move(mesh), {.objects = objects, .by = ObjectsBy::kSah});
}

TEST(SahCells, HoldTrianglesOfOneCodeTogetherAndAreNumberedWithoutGaps) {
    std::mt19937 random(3);
    std::vector<SahTriangle> triangles;
    for (int i = 0; i < 2000; ++i) {
        const auto code = static_cast<std::uint32_t>(random() % 500) << 21;
        triangles.push_back({{glm::vec3(0), glm::vec3(1)}, code, static_cast<std::uint32_t>(random() % 3)});
    }
    for (const std::size_t objects : {1u, 2u, 60u, 1000u, 100'000u}) {
        const auto cells = sah_cells(triangles, {glm::vec3(0), glm::vec3(1)}, objects);
        ASSERT_EQ(cells.size(), triangles.size());
        std::map<std::uint32_t, std::uint32_t> cell_of;
        std::vector<bool> there(triangles.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            ASSERT_LT(cells[i], triangles.size());
            there[cells[i]] = true;
            EXPECT_EQ(cell_of.try_emplace(triangles[i].code, cells[i]).first->second, cells[i]);
        }
        const auto count = std::ranges::max(cells) + std::size_t{1};
        EXPECT_EQ(std::ranges::count(there, true), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(SahObjects, AreRangesOfTrianglesByMaterialOfAboutTheNumberAskedFor) {
    for (const std::uint32_t materials : {1u, 3u})
        for (const std::size_t asked : {1u, 10u, 100u, 700u}) {
            const ObjectSet set = by_sah(soup(materials), asked);
            EXPECT_EQ(set.cut, (Cut{ObjectsBy::kSah, 0, asked}));
            EXPECT_GE(set.objects.size(), asked);
            EXPECT_LE(set.objects.size(), asked + 7 * materials);
            std::uint32_t next = 0;
            std::uint32_t material = 0;
            for (const Object& object : set.objects) {
                EXPECT_EQ(object.first_triangle, next);
                EXPECT_GT(object.triangle_count, 0u);
                EXPECT_GE(object.material, material);
                material = object.material;
                for (std::uint32_t t = 0; t < object.triangle_count; ++t)
                    EXPECT_EQ(set.mesh.material(next + t), object.material);
                next += object.triangle_count;
            }
            EXPECT_EQ(next, set.mesh.triangle_count());
        }
}

// Small triangles, a hundred around each point, and their codes in the box around all.
std::vector<SahTriangle> crowds(const std::vector<glm::vec3>& places, Box& bounds) {
    std::mt19937 random(11);
    const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    std::vector<SahTriangle> triangles;
    for (const glm::vec3& place : places)
        for (int i = 0; i < 100; ++i) {
            const glm::vec3 low = place + glm::vec3(number(), number(), number());
            triangles.push_back({{low, low + 0.1f}, 0, 0});
            bounds.extend(triangles.back().box);
        }
    for (SahTriangle& triangle : triangles)
        triangle.code = morton_code(triangle.box.centre(), bounds.min, bounds.size());
    return triangles;
}

// Two crowds lie on one side of the middle and one on the other.
TEST(SahCells, OfCrowdsThatAreApartHaveTrianglesOfOneOnly) {
    Box bounds;
    const auto triangles = crowds({{0, 0, 0}, {1.5f, 0, 0}, {9, 0, 0}}, bounds);
    for (const std::size_t objects : {3u, 5u, 20u}) {
        const auto cells = sah_cells(triangles, bounds, objects);
        std::vector<std::set<std::size_t>> crowds_of(objects + 8);
        for (std::size_t i = 0; i < cells.size(); ++i) crowds_of.at(cells[i]).insert(i / 100);
        for (const auto& crowd : crowds_of) EXPECT_LE(crowd.size(), 1u);
    }
}

// A server cuts the objects that it has anew, a newcomer cuts the model: both must get the same.
TEST(SahObjects, AreTheSameWhateverTheModelWasCutIntoBefore) {
    const std::vector<Granularity> steps{{.objects = 40, .by = ObjectsBy::kSah},
                                         {4, 0},
                                         {.objects = 900, .by = ObjectsBy::kSah},
                                         {.objects = 5, .by = ObjectsBy::kSah},
                                         {0, 0}};
    const Mesh mesh = soup(3);
    Mesh last = mesh;
    for (const Granularity& step : steps) {
        const ObjectSet direct = build_objects(mesh, step);
        ObjectSet again = build_objects(std::move(last), step);
        EXPECT_EQ(again.mesh, direct.mesh);
        EXPECT_EQ(again.objects, direct.objects);
        EXPECT_EQ(again.leaves, direct.leaves);
        EXPECT_EQ(build_objects(mesh, granularity_of(direct.cut)).objects, direct.objects);
        last = std::move(again.mesh);
    }
}

TEST(SahObjects, OfATriangleOrOfManyInOnePlaceAreOne) {
    Mesh one = test::cube();
    one.indices.resize(3);
    EXPECT_EQ(by_sah(one, 1000).objects.size(), 1u);
    for (int i = 0; i < 100; ++i)
        for (int k = 0; k < 3; ++k) one.indices.push_back(one.indices[static_cast<std::size_t>(k)]);
    EXPECT_EQ(by_sah(one, 1000).objects.size(), 1u);
}

TEST(ObjectsBy, HaveNames) {
    EXPECT_EQ(parse<ObjectsBy>("sah"), ObjectsBy::kSah);
    EXPECT_EQ(parse<ObjectsBy>("uniform"), ObjectsBy::kUniform);
    EXPECT_THAT(parse<ObjectsBy>("kd").error().message, testing::HasSubstr("uniform, sah"));
    EXPECT_EQ(to_string(Cut{ObjectsBy::kUniform, 4, 0}), "octree depth 4");
    EXPECT_EQ(to_string(Cut{ObjectsBy::kSah, 0, 1500}), "SAH octree, 1500 asked for");
}

}  // namespace
}  // namespace swath
