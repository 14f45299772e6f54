#include "common/cull/frustum_cull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/geometry/frustum.h"

namespace swath {
namespace {

View view_of(const glm::vec3& eye) {
    Camera camera;
    camera.eye = eye;
    camera.fov_y = 0.6f;
    return make_view(camera, 640, 480);
}

Object box_at(const glm::vec3& centre, float half) {
    Object object;
    object.box = {centre - glm::vec3(half), centre + glm::vec3(half)};
    return object;
}

class CullTest : public testing::Test {
  protected:
    CullTest() {
        std::mt19937 random(1);
        const auto number = [&] { return static_cast<float>(random() % 20001) / 1000.0f - 10.0f; };
        for (int i = 0; i < 2000; ++i)
            objects_.push_back(
                box_at({number(), number(), number()}, 0.01f * static_cast<float>(random() % 100)));
    }
    std::vector<Object> objects_;
};

TEST_F(CullTest, KeepsWhatTheFrustumKeepsInTheOrderOfTheGroup) {
    std::mt19937 random(2);
    for (int round = 0; round < 20; ++round) {
        const float turn = 0.3f * static_cast<float>(round);
        const View view = view_of({6 * std::cos(turn), 1, 6 * std::sin(turn)});
        std::vector<ObjectId> group;
        for (ObjectId id = 0; id < objects_.size(); ++id)
            if (random() % 3 != 0) group.push_back(id);
        std::vector<ObjectId> expected;
        const Frustum frustum = make_frustum(view);
        std::copy_if(group.begin(), group.end(), std::back_inserter(expected),
                     [&](ObjectId id) { return !outside(frustum, objects_[id].box); });
        EXPECT_EQ(cull(objects_, group, view), expected);
        EXPECT_GT(expected.size(), 0u);
        EXPECT_LT(expected.size(), group.size());
    }
}

// Corner by corner in clip space: a box is surely invisible when all of it is on the far side of one plane.
TEST_F(CullTest, DropsNothingThatHasACornerInView) {
    const View view = view_of({0, 0, 6});
    std::vector<ObjectId> group(objects_.size());
    for (ObjectId id = 0; id < group.size(); ++id) group[id] = id;
    const std::vector<ObjectId> visible = cull(objects_, group, view);
    for (const ObjectId id : group) {
        bool in_view = false;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec4 clip = view.clip_from_model * glm::vec4(objects_[id].box.corner(corner), 1);
            in_view |= std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && std::abs(clip.z) < clip.w;
        }
        EXPECT_TRUE(!in_view || std::binary_search(visible.begin(), visible.end(), id)) << id;
    }
}

TEST(Cull, OfAnEmptyGroupIsEmpty) {
    const std::vector<Object> objects{box_at({0, 0, 0}, 1)};
    EXPECT_TRUE(cull(objects, {}, view_of({0, 0, 6})).empty());
}

TEST(Cull, DropsWhatIsBehindTheCameraAndKeepsWhatIsAroundIt) {
    const std::vector<Object> objects{box_at({0, 0, 0}, 1), box_at({0, 0, 12}, 1), box_at({0, 0, 6}, 2)};
    EXPECT_EQ(cull(objects, std::vector<ObjectId>{0, 1, 2}, view_of({0, 0, 6})),
              (std::vector<ObjectId>{0, 2}));
}

}  // namespace
}  // namespace swath
