// The published algorithms cull objects as a plain loop does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/cullers/make_culler.h"
#include "common/published/cull/object_cells.h"
#include "common/published/cull/object_octree.h"
#include "common/published/cull/octree_culler.h"
#include "tests/common/published/cull/boxes.h"
#include "tests/common/published/cull/frusta.h"
#include "tests/support/steady_clock.h"

namespace swath {
namespace {

using testing::ElementsAreArray;

using test::kClock;

std::vector<std::uint32_t> brute_force(std::span<const Box> boxes, const Frustum& frustum) {
    std::vector<std::uint32_t> visible;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!outside(frustum, boxes[i])) visible.push_back(static_cast<std::uint32_t>(i));
    return visible;
}

Frustum moved(const Frustum& frustum, const glm::vec3& by) {
    Frustum result = frustum;
    for (glm::vec4& plane : result.planes) plane.w -= glm::dot(glm::vec3(plane), by);
    return result;
}

std::vector<Frustum> frusta() {
    std::vector<Frustum> all = all_sorts_of_frusta(100, 10, 13);
    for (std::size_t i = 0; i < 5; ++i) all.push_back(moved(all[i], glm::vec3(1e6f)));
    return all;
}

TEST(OctreeCuller, FindsWhatALoopFindsOfAnyBoxesInAnyViewForAnyTeam) {
    const std::vector<Frustum> views = frusta();
    for (const BoxSet& set : all_sorts_of_boxes())
        for (const std::size_t members : {1u, 3u, 16u, 64u}) {
            ThreadTeam team(members, kClock);
            for (const CullAlgorithm algorithm : {CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb}) {
                const auto culler = make_culler(algorithm, set.boxes, team);
                for (std::size_t i = 0; i < views.size(); ++i)
                    ASSERT_THAT(culler->cull(views[i]), ElementsAreArray(brute_force(set.boxes, views[i])))
                        << name_of(algorithm) << ", " << set.name << ", " << members << " members, view "
                        << i;
            }
        }
}

TEST(OctreeCuller, WorksWithEveryPublishedAlgorithm) {
    const std::vector<Frustum> views = frusta();
    std::vector<Box> boxes = BoxMaker(5).scattered(3'000, 2);
    // Some are too large for cells.
    for (const Box& box : BoxMaker(6).scattered(100, 200)) boxes.push_back(box);
    ASSERT_LT(ObjectCells(boxes).first_of_no_cell(), boxes.size() - 50);
    ThreadTeam team(3, kClock);
    for (const PublishedAlgorithm algorithm :
         {PublishedAlgorithm::kAdsb, PublishedAlgorithm::kAlgo1, PublishedAlgorithm::kAlgo2,
          PublishedAlgorithm::kAlgo3, PublishedAlgorithm::kAlgo4, PublishedAlgorithm::kAlgo5,
          PublishedAlgorithm::kAlgo1Lanes, PublishedAlgorithm::kAlgo4Lanes}) {
        const auto culler = make_octree_culler(algorithm, boxes, team);
        for (const Frustum& view : views)
            EXPECT_THAT(culler->cull(view), ElementsAreArray(brute_force(boxes, view))) << name_of(algorithm);
    }
}

TEST(OctreeCuller, FindsBoxesWhereTheyHaveMovedTo) {
    const std::vector<Frustum> views = frusta();
    ThreadTeam team(3, kClock);
    for (const CullAlgorithm algorithm : {CullAlgorithm::kA2ssb, CullAlgorithm::kAdsb}) {
        std::vector<Box> boxes = BoxMaker(5).scattered(3'000, 2);
        const auto culler = make_culler(algorithm, boxes, team);
        for (std::uint32_t round = 0; round < 6; ++round) {
            boxes = BoxMaker(7 + round).scattered(3'000, round % 2 == 0 ? 2 : 40);
            // All boxes in one place make a tree of another height.
            if (round == 3) boxes.assign(3'000, boxes.front());
            culler->refit(boxes);
            for (const Frustum& view : views)
                ASSERT_THAT(culler->cull(view), ElementsAreArray(brute_force(boxes, view))) << round;
        }
    }
}

TEST(OctreeCuller, SaysAtWhichLevelItSharedOutItsWork) {
    const std::vector<Box> boxes = BoxMaker(6).scattered(20'000, 1);
    ThreadTeam team(2, kClock);
    const auto a2ssb = make_culler(CullAlgorithm::kA2ssb, boxes, team);
    const auto adsb = make_culler(CullAlgorithm::kAdsb, boxes, team);
    EXPECT_EQ(a2ssb->split_level(), std::nullopt);
    a2ssb->cull(everything());
    adsb->cull(everything());
    EXPECT_EQ(a2ssb->split_level(), 1);
    EXPECT_EQ(adsb->split_level(), 0);
    adsb->cull(everything());
    EXPECT_EQ(adsb->split_level(), 1);
}

TEST(ObjectOctree, FindsWhatALoopFindsOfAnyBoxesInAnyView) {
    const std::vector<Frustum> views = frusta();
    for (const BoxSet& set : all_sorts_of_boxes())
        for (const double boxes_per_leaf : {1.0, 4.0, 100.0}) {
            ObjectOctree tree(set.boxes, boxes_per_leaf);
            for (std::size_t i = 0; i < views.size(); ++i) {
                const auto found = tree.cull(views[i]);
                std::vector<std::uint32_t> visible(found.begin(), found.end());
                std::ranges::sort(visible);
                ASSERT_THAT(visible, ElementsAreArray(brute_force(set.boxes, views[i])))
                    << set.name << ", " << boxes_per_leaf << " to a leaf, view " << i;
            }
        }
}

TEST(ObjectOctree, HasOnlyNodesWithObjects) {
    const std::vector<Box> boxes = BoxMaker(7).scattered(5'000, 1);
    const ObjectOctree tree(boxes);
    EXPECT_EQ(tree.height(), 4);  // 8^3 leaves are too few for four to a leaf
    EXPECT_LE(tree.node_count(), UniformOctree(4).node_count());
    EXPECT_GE(tree.node_count(), 5'000u / 4);
    EXPECT_EQ(ObjectOctree(std::vector<Box>{}).node_count(), 0u);
    EXPECT_EQ(ObjectOctree(std::vector<Box>(100, boxes[0])).height(), UniformOctree::kMaxHeight);
}

TEST(ObjectCells, HoldMostBoxesInCellsUnlessTheyAreTooLarge) {
    BoxMaker make(8);
    const ObjectCells small(make.scattered(5'000, 1));
    EXPECT_EQ(small.shape().height(), 4);
    EXPECT_GT(small.first_of_no_cell(), 4'990u);
    // Larger boxes get a lower tree, so that few must be tested one by one.
    const ObjectCells large(make.scattered(5'000, 30));
    EXPECT_LT(large.shape().height(), 4);
    EXPECT_GE(large.shape().height(), 1);
    EXPECT_GT(large.first_of_no_cell(), 5'000u * 15 / 16);
    EXPECT_EQ(large.box_count(), 5'000u);
    // All in one place: one cell around them.
    const ObjectCells same(std::vector<Box>(500, Box{{1, 2, 3}, {2, 4, 6}}));
    EXPECT_EQ(same.shape().height(), 0);
    EXPECT_EQ(same.first_of_no_cell(), 500u);
}

// Boxes as large as a leaf with centres on faces of leaves, so that they reach as far beyond as a box in a
// cell can, and planes that just touch one of them, up to a bit.
void expect_no_visible_box_lost(const glm::vec3& corner) {
    BoxMaker make(9);
    std::vector<Box> boxes;
    for (int i = 0; i < 3'000; ++i)
        boxes.push_back(BoxMaker::around(corner + glm::floor(make.point(0, 16.99f)),
                                         glm::vec3(i % 20 == 0 ? 0.54f : 0.5f)));  // some reach too far
    const ObjectCells cells(boxes);
    const UniformOctree& shape = cells.shape();
    ASSERT_EQ(shape.height(), 4);
    const CellBoxes by_cell = cells.cells();
    int visible = 0;
    int lost = 0;
    for (int round = 0; round < 100; ++round) {
        Frustum frustum = everything();
        glm::vec4& plane = frustum.planes[0];
        plane = glm::vec4(make.point(-1, 1), 0);
        plane.w = -p_vertex_distance(plane, boxes[static_cast<std::size_t>(make.number(0, 2'999))]);
        const Frustum loosened = cells.loosened(frustum);
        for (std::uint32_t code = 0; code < shape.leaf_count(); ++code) {
            const bool dropped = outside(loosened, shape.box_of(shape.height(), code));
            for (std::uint32_t i = by_cell.first[code]; i < by_cell.first[code + 1]; ++i) {
                const bool seen = !outside(frustum, boxes[by_cell.ids[i]]);
                visible += seen;
                lost += seen && dropped;
            }
        }
    }
    EXPECT_GT(visible, 10'000);
    EXPECT_EQ(lost, 0);
}

TEST(ObjectCells, LoosenAFrustumSoThatNoCellOfAVisibleBoxIsOutside) {
    expect_no_visible_box_lost(glm::vec3(0));
    expect_no_visible_box_lost({-8, 100, 3});
    expect_no_visible_box_lost(glm::vec3(100'000));
}

// Single precision takes 1e39 for infinite and finds boxes inside; exact arithmetic does not.
TEST(ObjectCells, DropNothingByAPlaneThatOverflows) {
    std::vector<Box> boxes = BoxMaker(9).scattered(2'000, 0.1f);
    for (Box& box : boxes) box = {100.0f + 0.1f * box.min, 100.0f + 0.1f * box.max};
    Frustum frustum = everything();
    frustum.planes[0] = {-2e37f, 0, 1e37f, 0};
    ThreadTeam team(1, kClock);
    const std::vector<std::uint32_t> visible = brute_force(boxes, frustum);
    EXPECT_EQ(visible.size(), boxes.size());
    EXPECT_THAT(make_culler(CullAlgorithm::kA2ssb, boxes, team)->cull(frustum), ElementsAreArray(visible));
}

}  // namespace
}  // namespace swath
