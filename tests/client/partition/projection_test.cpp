#include "client/partition/projection.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/geometry/frustum.h"
#include "tests/client/partition/scenes.h"

namespace swath {
namespace {

using test::cube;
using test::front_view;

ProjectedObject project_one(const Object& object, Accounting accounting = Accounting::kCluster) {
    return project(std::vector{object}, front_view(), accounting).front();
}

TEST(Projection, OfAVisibleObjectIsItsScreenBoundsAndItsTriangles) {
    const Object object = cube({0.1f, 0.2f, 0}, 0.1f, 33);
    EXPECT_EQ(project_one(object), (ProjectedObject{screen_bounds(object.box, front_view()), 33, true}));
}

TEST(Projection, OfAnObjectThatMovesIsWhereItIsAtTheViewsPose) {
    Object object = cube({-30, 0, 0}, 0.1f, 33);
    object.end_box = cube({30, 0.2f, 0}, 0.1f, 33).box;
    View view = front_view();
    const auto at = [&](float pose) {
        view.pose = pose;
        return project(std::vector{object}, view).front();
    };
    EXPECT_EQ(at(0), project_one(object));
    EXPECT_FALSE(at(0).visible);
    EXPECT_EQ(at(0.5f), (ProjectedObject{screen_bounds(object.box_at(0.5f), view), 33, true}));
    EXPECT_EQ(at(1).box.x1, 640);
    EXPECT_FALSE(at(1).visible);
}

TEST(Projection, OfAnUnseenObjectIsThePixelOfTheBorderNearestToIt) {
    EXPECT_EQ(project_one(cube({-30, 0, 0}, 0.1f, 33)), (ProjectedObject{{0, 240, 1, 241}, 0, false}));
    EXPECT_EQ(project_one(cube({30, 0, 0}, 0.1f, 33)).box, (Rect{639, 240, 640, 241}));
    EXPECT_EQ(project_one(cube({0, 30, 0}, 0.1f, 33)).box, (Rect{320, 479, 321, 480}));
    EXPECT_EQ(project_one(cube({30, -30, 0}, 0.1f, 33)).box, (Rect{639, 0, 640, 1}));
}

TEST(Projection, OfAnObjectBehindTheCameraIsOnTheSideWhereItLies) {
    EXPECT_EQ(project_one(cube({5, 0, 6}, 0.1f, 33)).box, (Rect{639, 240, 640, 241}));
    EXPECT_EQ(project_one(cube({0.001f, 0, 40}, 0.1f, 33)).box, (Rect{639, 240, 640, 241}));
    const Rect straight = project_one(cube({0, 0, 40}, 0.1f, 33)).box;
    EXPECT_EQ(straight.area(), 1);
    EXPECT_TRUE(front_view().viewport().contains(straight));
}

TEST(Projection, CountsUnseenTrianglesOnlyInThePapersAccounting) {
    const Object object = cube({30, 0, 0}, 0.1f, 33);
    EXPECT_EQ(project_one(object).work, 0u);
    EXPECT_EQ(project_one(object, Accounting::kPaper).work, 33u);
    EXPECT_FALSE(project_one(object, Accounting::kPaper).visible);
}

TEST(Projection, TakesTheWorkFromTheCostsWhereThereAreSome) {
    const std::vector<Object> objects{cube({0.1f, 0.2f, 0}, 0.1f, 33), cube({0, 0, 0}, 0.1f, 12),
                                      cube({30, 0, 0}, 0.1f, 50)};
    const std::vector<std::uint32_t> costs{20, 7, 50};
    const auto projected = project(objects, front_view(), Accounting::kCluster, costs);
    EXPECT_EQ(projected[0].work, 20u);
    EXPECT_EQ(projected[1].work, 7u);
    EXPECT_EQ(projected[2].work, 0u);  // cannot be seen
    EXPECT_EQ(projected[0].box, project(objects, front_view())[0].box);
    const std::vector<std::uint32_t> too_few{1};
    EXPECT_THROW(project(objects, front_view(), Accounting::kCluster, too_few), CheckFailed);
}

TEST(Projection, OfEveryAwkwardObjectLiesOnTheScreen) {
    for (const test::Scene& scene : test::awkward_scenes())
        for (const auto& [width, height] : {std::pair{640, 480}, {1, 1}, {641, 3}})
            for (const ProjectedObject& object : project(scene.objects, front_view(width, height))) {
                ASSERT_FALSE(object.box.empty()) << scene.name;
                ASSERT_TRUE((Rect{0, 0, width, height}).contains(object.box)) << scene.name;
                ASSERT_TRUE(object.visible || object.box.area() == 1);
            }
}

TEST(Projection, SurvivesABoxThatIsEmpty) {
    const ProjectedObject object = project_one(Object{});
    EXPECT_FALSE(object.visible);
    EXPECT_EQ(object.box.area(), 1);
}

}  // namespace
}  // namespace swath
