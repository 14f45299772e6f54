#include "common/raycast/pinhole.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "tests/support/triangles.h"

namespace swath {
namespace {

using test::Numbers;

View some_view(Numbers& numbers, int width, int height) {
    Camera camera;
    camera.target = 3.0f * numbers.point();
    camera.eye = camera.target + 5.0f * numbers.point() + glm::vec3(0.1f);
    camera.fov_y = numbers.between(0.1f, 2.5f);
    camera.near = 0.05f;
    camera.far = 50;
    return make_view(camera, width, height);
}

// Compares with the pixel and the depth that the view's matrix gives for a point on the ray.
TEST(Pinhole, RaysAreThoseOfPixelCentresAndDepthIsThatOfTheMatrix) {
    Numbers numbers(1);
    for (const auto& [width, height] : {std::pair{640, 480}, {33, 77}, {4096, 2160}, {1, 1}})
        for (int repeat = 0; repeat < 20; ++repeat)
            for (const float scale : {1.0f, 0x1p-9f, 0x1p20f}) {
                const View view = some_view(numbers, width, height);
                const auto rays = Pinhole::of(view, scale);
                ASSERT_TRUE(rays.has_value()) << rays.error().message;
                const int x = static_cast<int>(numbers.below(static_cast<std::size_t>(width)));
                const int y = static_cast<int>(numbers.below(static_cast<std::size_t>(height)));
                const RayPacket packet = rays->packet(x, y);
                EXPECT_EQ(packet.active, 0xffffu);
                for (int lane = 0; lane < kPacketRays; ++lane) {
                    const double t = static_cast<double>(numbers.between(1.0f, 40.0f) * scale);
                    glm::dvec4 point(0, 0, 0, 1);
                    float largest = 0;
                    for (int axis = 0; axis < 3; ++axis) {
                        EXPECT_EQ(packet.origin[axis][lane], rays->eye()[axis]);
                        largest = std::max(largest, std::abs(packet.direction[axis][lane]));
                        point[axis] = (static_cast<double>(packet.origin[axis][lane]) +
                                       t * static_cast<double>(packet.direction[axis][lane])) /
                                      static_cast<double>(scale);
                    }
                    EXPECT_GT(largest, 0x1p-20f);
                    EXPECT_LT(largest, 0x1p20f);
                    const glm::dvec4 clip = glm::dmat4(view.clip_from_model) * point;
                    ASSERT_GT(clip.w, 0);
                    EXPECT_NEAR(0.5 * (clip.x / clip.w + 1) * width, x + lane % 4 + 0.5,
                                1e-5 * (width + 100));
                    EXPECT_NEAR(0.5 * (clip.y / clip.w + 1) * height, y + lane / 4 + 0.5,
                                1e-5 * (height + 100));
                    EXPECT_NEAR(static_cast<double>(packet.depth_offset[lane]) -
                                    static_cast<double>(packet.depth_scale) / t,
                                0.5 * (clip.z / clip.w + 1), 1e-6);
                }
            }
}

TEST(Pinhole, RaysOfAPixelAreTheSameInAnyPacket) {
    Numbers numbers(2);
    const auto rays = Pinhole::of(some_view(numbers, 640, 480), 1);
    ASSERT_TRUE(rays.has_value());
    const RayPacket one = rays->packet(100, 200);
    for (int dx = 0; dx < 4; ++dx)
        for (int dy = 0; dy < 4; ++dy) {
            const RayPacket other = rays->packet(100 - dx, 200 - dy);
            const int lane = dx + 4 * dy;
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_EQ(one.direction[axis][0], other.direction[axis][lane]);
            EXPECT_EQ(one.depth_offset[0], other.depth_offset[lane]);
        }
}

TEST(Pinhole, NeedsAPerspectiveWithAnInverse) {
    Numbers numbers(3);
    const View good = some_view(numbers, 64, 64);
    ASSERT_TRUE(Pinhole::of(good, 1).has_value());
    const auto expect_refused = [&](const glm::mat4& matrix, const char* what) {
        View view = good;
        view.clip_from_model = matrix;
        const auto rays = Pinhole::of(view, 1);
        ASSERT_FALSE(rays.has_value()) << what;
        EXPECT_NE(rays.error().message.find("ray caster"), std::string::npos);
    };
    const glm::mat4 look = glm::lookAt(glm::vec3(1, 2, 3), glm::vec3(0), glm::vec3(0, 1, 0));
    expect_refused(glm::mat4(0.0f), "zero");
    expect_refused(glm::mat4(1.0f), "one");
    expect_refused(glm::ortho(-1.0f, 1.0f, -1.0f, 1.0f, 0.1f, 10.0f) * look, "orthographic");
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
                glm::mat4 matrix = good.clip_from_model;
                matrix[column][row] = bad;
                expect_refused(matrix, "not a number");
            }
    glm::mat4 twice = good.clip_from_model;
    for (int column = 0; column < 4; ++column) twice[column][1] = twice[column][0];
    expect_refused(twice, "two rows alike");
    for (int column = 0; column < 4; ++column) twice[column][3] = twice[column][1] = 0;
    expect_refused(twice, "rows of zeros");
    glm::mat4 behind = good.clip_from_model;
    for (int column = 0; column < 4; ++column) behind[column][2] = -behind[column][2];
    expect_refused(behind, "far before near");
    Camera wide;
    wide.fov_y = 3.1415925f;
    expect_refused(make_view(wide, 64, 64).clip_from_model, "too wide");
}

}  // namespace
}  // namespace swath
