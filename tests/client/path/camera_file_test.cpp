#include "client/path/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace swath {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string error_of(std::string_view text) {
    const Result<std::vector<Camera>> cameras = parse_cameras(text, "tour.txt");
    return cameras ? "no error" : cameras.error().message;
}

TEST(CameraFile, HasOneCameraALine) {
    const auto cameras = parse_cameras(
        "# a tour\r\n"
        "0 0 9  1 2 3  0 1 0  30   # front\r\n"
        "\n"
        "\t+1.5 -2e1 .5 0 0 0 0 0 1 90",
        "tour.txt");
    ASSERT_TRUE(cameras);
    ASSERT_EQ(cameras->size(), 2u);
    EXPECT_EQ((*cameras)[0].target, glm::vec3(1, 2, 3));
    EXPECT_FLOAT_EQ((*cameras)[0].fov_y, 0.5235988f);
    EXPECT_EQ((*cameras)[1].eye, glm::vec3(1.5f, -20, 0.5f));
    EXPECT_EQ((*cameras)[1].up, glm::vec3(0, 0, 1));
}

TEST(CameraFile, ErrorsNameTheFileTheLineAndTheFault) {
    EXPECT_THAT(error_of("#\n1 2 3\n"), StartsWith("tour.txt:2: "));
    EXPECT_THAT(error_of("1 2 3"), HasSubstr("expected 10 numbers"));
    EXPECT_THAT(error_of("0 0 9 0 0 0 0 1 0 30 5"), HasSubstr("found 11"));
    EXPECT_THAT(error_of("0 0 nine 0 0 0 0 1 0 30"), HasSubstr("'nine' is not a number"));
    EXPECT_THAT(error_of("0 0 9, 0 0 0 0 1 0 30"), HasSubstr("'9,' is not a number"));
    EXPECT_THAT(error_of("0 0 + 0 0 0 0 1 0 30"), HasSubstr("'+' is not a number"));
    EXPECT_THAT(error_of("0 0 nan 0 0 0 0 1 0 30"), HasSubstr("'nan'"));
    EXPECT_THAT(error_of("0 0 -inf 0 0 0 0 1 0 30"), HasSubstr("'-inf'"));
    EXPECT_THAT(error_of("0 0 1e30 0 0 0 0 1 0 30"), HasSubstr("'1e30'"));
    EXPECT_THAT(error_of("0 0 1e300 0 0 0 0 1 0 30"), HasSubstr("'1e300'"));
    EXPECT_THAT(error_of("0 0 9 0 0 0 0 1 0 180"), HasSubstr("fov_degrees"));
    EXPECT_THAT(error_of("0 0 9 0 0 0 0 1 0 0"), HasSubstr("fov_degrees"));
    EXPECT_THAT(error_of("0 0 9 0 0 9 0 1 0 30"), HasSubstr("same point"));
    EXPECT_THAT(error_of("0 0 9 0 0 0 0 0 0 30"), HasSubstr("up is zero"));
    EXPECT_THAT(error_of("0 0 9 0 0 0 0 0 -2 30"), HasSubstr("line of sight"));
}

TEST(CameraNumbers, AreTheSameBitsWhenALineOfThemIsRead) {
    const CameraNumbers numbers{0.1f,  -1e-7f, 123456.789f, 1.0f / 3, 0,
                                -0.0f, 0.01f,  0.99f,       1e-3f,    34.377468f};
    const auto cameras = parse_cameras(to_line(numbers), "view.camera");
    ASSERT_TRUE(cameras);
    EXPECT_EQ((*cameras)[0], *camera_of(numbers));
    EXPECT_EQ(camera_of(numbers_of((*cameras)[0]))->eye, (*cameras)[0].eye);
    EXPECT_EQ(camera_of(numbers_of((*cameras)[0]))->up, (*cameras)[0].up);
}

TEST(CameraNumbers, ThatNobodyCanLookThroughAreRefused) {
    CameraNumbers numbers{0, 0, 9, 0, 0, 0, 0, 1, 0, 30};
    ASSERT_TRUE(camera_of(numbers));
    numbers[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(camera_of(numbers).error().message, HasSubstr("nan is not within 1e+18"));
    numbers[3] = std::numeric_limits<float>::infinity();
    EXPECT_THAT(camera_of(numbers).error().message, HasSubstr("inf is not within"));
}

TEST(CameraFile, WithoutCamerasIsAnError) {
    EXPECT_EQ(error_of(""), "tour.txt: no cameras");
    EXPECT_EQ(error_of("# none\n \t \n"), "tour.txt: no cameras");
}

}  // namespace
}  // namespace swath
