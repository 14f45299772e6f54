#include "common/published/resource/cull_and_sort.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/check.h"
#include "common/geometry/camera.h"
#include "tests/common/published/resource/sample.h"

namespace swath {
namespace {

using Way = CullAndSort::Way;

std::vector<Box> random_boxes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<float>(random() % 20'001) / 1000.0f - 10.0f; };
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 centre(number(), number(), number());
        const float half = 0.005f * static_cast<float>(random() % 100);
        boxes.push_back({centre - glm::vec3(half), centre + glm::vec3(half)});
    }
    return boxes;
}

Frustum frustum_of(const glm::vec3& eye, float fov_y) {
    Camera camera;
    camera.eye = eye;
    camera.fov_y = fov_y;
    return make_frustum(make_view(camera, 640, 480));
}
const Frustum kLittle = frustum_of({0, 1, 6}, 0.2f);
const Frustum kMuch = frustum_of({1, 2, 15}, 0.9f);
const Frustum kEverything = frustum_of({0, 0, 60}, 1.2f);
const Frustum kNothing = frustum_of({0, 0, 300}, 1.2f);  // all boxes are beyond the far plane

Ids visible_by_key(const Frustum& frustum, std::span<const Box> boxes, const Ids& keys) {
    Ids visible;
    for (std::uint32_t id = 0; id < boxes.size(); ++id)
        if (!outside(frustum, boxes[id])) visible.push_back(id);
    return by_key_and_id(keys, visible);
}

class CullAndSortTest : public testing::Test {
  protected:
    const std::vector<Box> boxes_ = random_boxes(5000, 1);
    const Ids keys_ = random_keys(5000, 300, 2);
    ThreadTeam team_{3, kClock};
    CullAndSort cull_{boxes_, keys_, team_};
};

TEST_F(CullAndSortTest, AnswersTheSameEitherWay) {
    for (int turn = 0; turn < 30; ++turn) {
        const float angle = 0.2f * static_cast<float>(turn);
        const Frustum frustum = frustum_of({14 * std::cos(angle), 0.3f, 7 * std::sin(angle)},
                                           0.1f + 0.04f * static_cast<float>(turn));
        const Ids expected = visible_by_key(frustum, boxes_, keys_);
        EXPECT_EQ(copy(cull_.cull(frustum, Way::kHierarchy)), expected);
        EXPECT_EQ(cull_.way(), Way::kHierarchy);
        EXPECT_EQ(copy(cull_.cull(frustum, Way::kScan)), expected);
        EXPECT_EQ(cull_.way(), Way::kScan);
        EXPECT_EQ(copy(cull_.cull(frustum)), expected);
    }
}

TEST_F(CullAndSortTest, SeesEverythingAndNothing) {
    for (const Way way : {Way::kHierarchy, Way::kScan}) {
        EXPECT_EQ(copy(cull_.cull(kEverything, way)), by_key_and_id(keys_, all_ids(5000)));
        EXPECT_TRUE(cull_.cull(kNothing, way).empty());
    }
}

TEST_F(CullAndSortTest, GoesByHowMuchTheFrameBeforeSaw) {
    EXPECT_EQ(cull_.next_way(), Way::kHierarchy);
    const std::size_t much = cull_.cull(kMuch).size();
    EXPECT_GT(much, 2500u);
    EXPECT_LT(much, 4000u);
    EXPECT_EQ(cull_.way(), Way::kHierarchy);
    EXPECT_EQ(cull_.next_way(), Way::kScan);
    EXPECT_EQ(cull_.cull(kLittle).size(), visible_by_key(kLittle, boxes_, keys_).size());
    EXPECT_EQ(cull_.way(), Way::kScan);
    EXPECT_EQ(cull_.next_way(), Way::kHierarchy);
    cull_.cull(kEverything);
    EXPECT_EQ(cull_.next_way(), Way::kHierarchy);  // the hierarchy looks at few nodes to find everything
}

TEST_F(CullAndSortTest, NeverScansWhatIsNumberedByKey) {
    Ids keys = keys_;
    std::ranges::sort(keys);
    CullAndSort cull(boxes_, keys, team_);
    EXPECT_EQ(copy(cull.cull(kMuch, Way::kScan)), visible_by_key(kMuch, boxes_, keys));
    EXPECT_EQ(cull.way(), Way::kHierarchy);
    EXPECT_EQ(cull.next_way(), Way::kHierarchy);
}

TEST(CullAndSort, HasNothingToDo) {
    ThreadTeam team(2, kClock);
    CullAndSort cull({}, {}, team);
    EXPECT_TRUE(cull.cull(kEverything).empty());
    EXPECT_TRUE(cull.cull(kEverything, Way::kScan).empty());
}

TEST(CullAndSort, RefusesABoxWithoutAKey) {
    ThreadTeam team(1, kClock);
    EXPECT_THROW(CullAndSort(random_boxes(3, 1), Ids{0, 1}, team), CheckFailed);
}

}  // namespace
}  // namespace swath
