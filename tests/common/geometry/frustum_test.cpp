#include "common/geometry/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace swath {
namespace {

// Random cameras and boxes, and points in those boxes.
class Scene {
  public:
    explicit Scene(unsigned seed) : random_(seed) {}

    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    glm::vec3 point(float reach) {
        return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
    }
    View view() {
        Camera camera;
        eye_ = camera.eye = point(3);
        camera.target = point(1);
        camera.fov_y = uniform(0.05f, 2.5f);
        camera.near = std::exp(uniform(std::log(1e-3f), 0));
        camera.far = camera.near + uniform(0.5f, 20);
        return make_view(camera, static_cast<int>(random_() % 2000) + 1,
                         static_cast<int>(random_() % 2000) + 1);
    }
    // Every other box is near or around the last view's eye; some are flat.
    Box box() {
        Box box;
        const glm::vec3 middle = random_() % 2 == 0 ? point(4) : eye_ + point(0.5f);
        const float size = std::exp(uniform(-5, 1));
        box.extend(middle + point(size));
        if (random_() % 8 != 0) box.extend(middle + point(size));
        return box;
    }
    glm::vec3 in(const Box& box) {
        glm::vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            // Bounds go wrong at corners, edges and faces.
            const auto where = random_() % 4;
            p[axis] = where == 0   ? box.min[axis]
                      : where == 1 ? box.max[axis]
                                   : std::clamp(uniform(box.min[axis], std::nextafter(box.max[axis], 1e9f)),
                                                box.min[axis], box.max[axis]);
        }
        return p;
    }

  private:
    std::mt19937 random_;
    glm::vec3 eye_{0};  // the last view's
};

template <class Vec4>
bool in_frustum(const Vec4& c) {
    return c.w > 0 && std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && std::abs(c.z) <= c.w;
}

TEST(ScreenBounds, ContainThePixelOfEveryVisiblePointOfTheBox) {
    Scene scene(7);
    int seen = 0;
    int crossing = 0;
    for (int round = 0; round < 30'000; ++round) {
        const View view = scene.view();
        const Box box = scene.box();
        const Rect bounds = screen_bounds(box, view);
        ASSERT_TRUE(view.viewport().contains(bounds));
        for (int sample = 0; sample < 20; ++sample) {
            const glm::dvec4 c = glm::dmat4(view.clip_from_model) * glm::dvec4(glm::dvec3(scene.in(box)), 1);
            crossing += c.z + c.w < 0 && !bounds.empty() ? 1 : 0;
            // The closed upper border belongs to no pixel.
            if (!in_frustum(c) || c.x >= c.w || c.y >= c.w) continue;
            ++seen;
            const int x = static_cast<int>(std::floor((c.x / c.w * 0.5 + 0.5) * view.width));
            const int y = static_cast<int>(std::floor((c.y / c.w * 0.5 + 0.5) * view.height));
            ASSERT_TRUE(bounds.contains({x, y, x + 1, y + 1}))
                << bounds << " misses " << x << ',' << y << " of " << view.viewport();
        }
    }
    EXPECT_GT(seen, 20'000);
    EXPECT_GT(crossing, 10'000);
}

// A renderer computes in single precision. A point that reaches past the bounds by half a pixel could cover
// the next pixel's centre.
TEST(ScreenBounds, StayWithinHalfAPixelOfSinglePrecisionPoints) {
    Scene scene(8);
    int seen = 0;
    for (int round = 0; round < 30'000; ++round) {
        View view = scene.view();
        glm::vec3 offset(0);
        if (round % 2 == 1) {  // far from the origin single precision loses many digits
            offset = scene.point(300);
            Camera camera;
            camera.target = offset;
            camera.eye = offset + scene.point(1);
            camera.near = 1e-3f;
            view = make_view(camera, 1000, 1000);
        }
        Box box = scene.box();
        box.min += offset;
        box.max += offset;
        const Rect bounds = screen_bounds(box, view);
        for (int sample = 0; sample < 20; ++sample) {
            const glm::vec4 c = view.clip_from_model * glm::vec4(scene.in(box), 1.0f);
            if (!in_frustum(c)) continue;
            ++seen;
            const float x = (c.x / c.w * 0.5f + 0.5f) * static_cast<float>(view.width);
            const float y = (c.y / c.w * 0.5f + 0.5f) * static_cast<float>(view.height);
            ASSERT_FALSE(bounds.empty());
            ASSERT_LT(static_cast<float>(bounds.x0) - 0.5f, x);
            ASSERT_GT(static_cast<float>(bounds.x1) + 0.5f, x);
            ASSERT_LT(static_cast<float>(bounds.y0) - 0.5f, y);
            ASSERT_GT(static_cast<float>(bounds.y1) + 0.5f, y);
        }
    }
    EXPECT_GT(seen, 20'000);
}

TEST(ScreenBounds, AreThoseOfTheCornersForEveryBoxOfAView) {
    Scene scene(9);
    int in_full_view = 0;
    for (int round = 0; round < 3'000; ++round) {
        const View view = scene.view();
        const ScreenBounds bounds(view);
        for (int k = 0; k < 20; ++k) {
            const Box box = scene.box();
            const Rect found = bounds.of(box);
            ASSERT_EQ(found, screen_bounds(box, view));
            glm::dvec2 low(1e9);
            glm::dvec2 high(-1e9);
            double nearest = 1e9;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p((corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                                   (corner & 4 ? box.max : box.min).z);
                const glm::dvec4 c = glm::dmat4(view.clip_from_model) * glm::dvec4(p, 1);
                const glm::dvec2 at = (glm::dvec2(c) / c.w * 0.5 + 0.5) * glm::dvec2(view.width, view.height);
                low = glm::min(low, at);
                high = glm::max(high, at);
                nearest = std::min({nearest, c.w, c.z + c.w});
            }
            // Margins are larger close to the eye.
            if (nearest < 0.1 || low.x < 1 || low.y < 1 || high.x > view.width - 1 ||
                high.y > view.height - 1 || found.empty())
                continue;
            ++in_full_view;
            ASSERT_NEAR(found.x0, std::floor(low.x), 1);
            ASSERT_NEAR(found.y0, std::floor(low.y), 1);
            ASSERT_NEAR(found.x1, std::floor(high.x) + 1, 1);
            ASSERT_NEAR(found.y1, std::floor(high.y) + 1, 1);
        }
    }
    EXPECT_GT(in_full_view, 2'000);
}

TEST(ScreenBounds, AreTightForABoxInFullView) {
    Camera camera;
    camera.eye = {0, 0, 10};
    camera.fov_y = 2 * std::atan(0.1f);  // at distance 10 the screen is 2 units high
    const View view = make_view(camera, 400, 200);
    Box box;
    box.extend(glm::vec3(-0.505f, -0.255f, 0));
    box.extend(glm::vec3(0.505f, 0.255f, 0));
    EXPECT_EQ(screen_bounds(box, view), (Rect{149, 74, 251, 126}));
}

TEST(ScreenBounds, AreEmptyForWhatCannotBeSeen) {
    const View view = make_view(Camera{}, 640, 480);  // at z = 1, looks along -z, sees to z = -99
    const auto cube = [](const glm::vec3& centre) {
        return Box{centre - glm::vec3(0.1f), centre + glm::vec3(0.1f)};
    };
    EXPECT_TRUE(screen_bounds(Box{}, view).empty());
    EXPECT_TRUE(screen_bounds(cube({0, 0, 2}), view).empty()) << "behind the eye";
    EXPECT_TRUE(screen_bounds(cube({9, 0, 0}), view).empty()) << "right";
    EXPECT_TRUE(screen_bounds(cube({0, -9, 0}), view).empty()) << "below";
    EXPECT_TRUE(screen_bounds(cube({0, 0, -200}), view).empty()) << "beyond the far plane";
    EXPECT_FALSE(screen_bounds(cube({0, 0, 0}), view).empty());
}

TEST(ScreenBounds, AreTheWholeScreenAroundTheEye) {
    const View view = make_view(Camera{}, 640, 480);
    EXPECT_EQ(screen_bounds(Box{glm::vec3(-5), glm::vec3(5)}, view), view.viewport());
    EXPECT_EQ(screen_bounds(Box{glm::vec3(-1e15f), glm::vec3(1e15f)}, view), view.viewport());
}

TEST(Frustum, KeepsEveryBoxWithAPointInView) {
    Scene scene(9);
    int kept = 0;
    int dropped = 0;
    for (int round = 0; round < 50'000; ++round) {
        const View view = scene.view();
        const Box box = scene.box();
        const bool out = outside(make_frustum(view), box);
        dropped += out ? 1 : 0;
        for (int sample = 0; sample < 10; ++sample) {
            glm::dvec4 c = glm::dmat4(view.clip_from_model) * glm::dvec4(glm::dvec3(scene.in(box)), 1);
            c.w -= 1e-5;  // the planes are in single precision
            if (!in_frustum(c)) continue;
            ++kept;
            ASSERT_FALSE(out);
        }
    }
    EXPECT_GT(kept, 20'000);
    EXPECT_GT(dropped, 10'000);
}

TEST(Frustum, DropsABoxExactlyWhenAllCornersAreOutsideOfOnePlane) {
    Scene scene(10);
    for (int round = 0; round < 50'000; ++round) {
        const View view = scene.view();
        const Box box = scene.box();
        const Frustum frustum = make_frustum(view);
        bool certain = false;
        bool possible = false;
        for (const glm::vec4& plane : frustum.planes) {
            double farthest = -1e30;
            for (int k = 0; k < 8; ++k)
                farthest = std::max(farthest, glm::dot(glm::dvec4(plane), glm::dvec4(box.corner(k), 1)));
            certain = certain || farthest < -1e-3;
            possible = possible || farthest < 1e-3;
        }
        const bool out = outside(frustum, box);
        ASSERT_TRUE(!certain || out);
        ASSERT_TRUE(!out || possible);
    }
}

}  // namespace
}  // namespace swath
