#include "client/path/path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "common/geometry/frustum.h"

namespace swath {
namespace {

using testing::HasSubstr;

const Box kModel{{-1, 0, 2}, {3, 1.5f, 4}};

std::vector<Camera> path(const std::string& spec, const PathOptions& options = {},
                         const Box& bounds = kModel) {
    Result<std::vector<Camera>> made = make_path(spec, bounds, options);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? *made : std::vector<Camera>{};
}

std::string path_error(const std::string& spec, const PathOptions& options = {}) {
    const Result<std::vector<Camera>> made = make_path(spec, kModel, options);
    return made ? "no error" : made.error().message;
}

// The box's corners in clip space, divided by w.
std::vector<glm::vec3> corners(const Camera& camera, const Box& box, int width, int height) {
    const View view = make_view(camera, width, height);
    std::vector<glm::vec3> all;
    for (int k = 0; k < 8; ++k) {
        const glm::vec4 clip = view.clip_from_model * glm::vec4(box.corner(k), 1.0f);
        EXPECT_GT(clip.w, 0);
        all.push_back(glm::vec3(clip) / clip.w);
    }
    return all;
}

// A file that is removed with the test.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& text)
        : path_(std::filesystem::temp_directory_path() / ("swath_path_test_" + std::to_string(getpid()))) {
        std::ofstream(path_) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path() const { return path_.string(); }

  private:
    std::filesystem::path path_;
};

TEST(Orbit, HasAsManyFramesAsAskedForAndFiftyOtherwise) {
    EXPECT_EQ(path("orbit", {.frames = 7}).size(), 7u);
    EXPECT_EQ(path("orbit").size(), 50u);
}

TEST(Orbit, KeepsTheWholeBoxInThePictureAndAboutFillsIt) {
    const std::vector<Box> models{
        kModel, {{-1, -50, -1}, {1, 50, 1}}, {{1e4f, 0, 0}, {1.2e4f, 10, 10}}, {{0, 0, 0}, {1e-3f, 0, 0}}};
    for (const Box& model : models)
        for (const auto& [width, height] : {std::pair{1280, 960}, {300, 900}, {1920, 300}}) {
            const float aspect = static_cast<float>(width) / static_cast<float>(height);
            float widest = 0;
            for (const Camera& camera : path("orbit", {.frames = 40, .aspect = aspect}, model))
                for (const glm::vec3& corner : corners(camera, model, width, height)) {
                    EXPECT_LE(std::abs(corner.x), 1);
                    EXPECT_LE(std::abs(corner.y), 1);
                    EXPECT_LE(std::abs(corner.z), 1);
                    widest = std::max({widest, std::abs(corner.x), std::abs(corner.y)});
                }
            EXPECT_GT(widest, 0.95f);
        }
}

TEST(Orbit, TurnsAroundTheCentreInEqualStepsAtOneDistance) {
    const std::vector<Camera> cameras = path("orbit", {.frames = 8});
    const float distance = glm::length(cameras[0].eye - kModel.centre());
    for (std::size_t k = 0; k < 8; ++k) {
        const glm::vec3 out = cameras[k].eye - kModel.centre();
        EXPECT_EQ(cameras[k].target, kModel.centre());
        EXPECT_NEAR(glm::length(out), distance, 1e-4f * distance);
        EXPECT_GT(out.y, 0);
        EXPECT_NEAR(std::remainder(std::atan2(out.x, out.z) - static_cast<float>(k) * 0.785398f, 6.283185f),
                    0, 1e-4f);
    }
}

TEST(Orbit, ComesCloserWithZoom) {
    const auto distance = [](const Camera& camera) { return glm::length(camera.eye - camera.target); };
    EXPECT_NEAR(distance(path("orbit", {.zoom = 2})[3]) * 2, distance(path("orbit")[3]), 1e-3f);
}

TEST(Orbit, OfAModelThatIsOnePointSeesIt) {
    for (const float at : {0.0f, 1000.0f}) {
        const Box point{glm::vec3(at), glm::vec3(at)};
        for (const Camera& camera : path("orbit", {.frames = 5}, point))
            EXPECT_FALSE(screen_bounds(point, make_view(camera, 100, 100)).empty());
    }
}

TEST(RandomPath, IsThePapersCamera) {
    const PathOptions options{.frames = 50, .zoom = 1.33f};
    float lowest = 1;
    float highest = -1;
    for (const Camera& camera : path("random", options)) {
        const glm::vec3 out = camera.eye - kModel.centre();
        const float distance = glm::length(out);
        EXPECT_FLOAT_EQ(camera.fov_y, 0.3f);
        // The longest side, 4, is 1.33 times as high as the screen.
        EXPECT_NEAR(2 * distance * std::tan(0.15f) * 1.33f, 4, 1e-3f);
        const float elevation = std::asin(out.y / distance);
        EXPECT_LE(std::abs(elevation), 0.6501f);
        lowest = std::min(lowest, elevation);
        highest = std::max(highest, elevation);
    }
    EXPECT_LT(lowest, -0.5f);
    EXPECT_GT(highest, 0.5f);
}

TEST(RandomPath, IsTheSameForTheSameSeedAndAnotherForAnother) {
    EXPECT_EQ(path("random", {.seed = 3}), path("random", {.seed = 3}));
    EXPECT_NE(path("random", {.seed = 3}), path("random", {.seed = 4}));
}

TEST(RandomPath, DrawsTheNumbersThatTheStandardPromises) {
    // The first output of a default mt19937_64 seeded with 5489 is 14514284786278117030.
    const double elevation = (2 * (14514284786278117030.0 / 18446744073709551616.0) - 1) * 0.65;
    const glm::vec3 out = path("random", {.seed = 5489})[0].eye - kModel.centre();
    EXPECT_NEAR(std::asin(out.y / glm::length(out)), elevation, 1e-5);
}

TEST(FilePath, IsRepeatedOrCutToTheFramesAskedFor) {
    const TemporaryFile file("0 0 9  0 0 0  0 1 0  30\n1 0 9  0 0 0  0 1 0  30\n2 0 9  0 0 0  0 1 0  30\n");
    EXPECT_EQ(path(file.path()).size(), 3u);
    EXPECT_EQ(path(file.path(), {.frames = 2}).size(), 2u);
    const std::vector<Camera> cyclic = path(file.path(), {.frames = 7});
    ASSERT_EQ(cyclic.size(), 7u);
    EXPECT_EQ(cyclic[5], cyclic[2]);
    EXPECT_EQ(cyclic[4].eye, glm::vec3(1, 0, 9));
    EXPECT_EQ(cyclic[4], with_depth_range(cyclic[4], kModel));
}

TEST(FilePath, ThatIsMissingOrWrongIsAnErrorThatNamesIt) {
    EXPECT_THAT(path_error("/nowhere/cameras.txt"), HasSubstr("/nowhere/cameras.txt"));
    const TemporaryFile file("# nothing\n\n0 0 9\n");
    EXPECT_THAT(path_error(file.path()), HasSubstr(file.path() + ":3:"));
}

TEST(PathOptions, OutOfRangeAreErrorsThatNameThem) {
    EXPECT_THAT(path_error("orbit", {.frames = 0}), HasSubstr("frames"));
    EXPECT_THAT(path_error("orbit", {.frames = kMaxPathFrames + 1}), HasSubstr("frames"));
    EXPECT_THAT(path_error("orbit", {.zoom = 0}), HasSubstr("zoom"));
    EXPECT_THAT(path_error("orbit", {.aspect = -1}), HasSubstr("aspect"));
}

TEST(DepthRange, HoldsTheWholeBoxFromOutside) {
    Camera camera;
    camera.eye = {30, 2, -8};
    camera.target = kModel.centre();
    for (const glm::vec3& corner : corners(with_depth_range(camera, kModel), kModel, 640, 480)) {
        EXPECT_GE(corner.z, -1);
        EXPECT_LE(corner.z, 1);
    }
}

TEST(DepthRange, FromInsideStartsCloseToTheEye) {
    Camera camera;
    camera.eye = kModel.centre();
    camera.target = camera.eye + glm::vec3(1, 0, 0);
    const Camera fitted = with_depth_range(camera, kModel);
    const float diagonal = glm::length(kModel.size());
    EXPECT_NEAR(fitted.near, 1e-3f * diagonal, 1e-5f);
    EXPECT_GE(fitted.far, 2);
}

TEST(DepthRange, LookingAwayIsStillARange) {
    Camera camera;
    camera.eye = {0, 0, 100};
    camera.target = {0, 0, 200};
    const Camera fitted = with_depth_range(camera, kModel);
    EXPECT_GT(fitted.near, 0);
    EXPECT_GT(fitted.far, fitted.near);
}

TEST(PathPose, GoesToAndFroInSteps) {
    EXPECT_EQ(path_pose(0), 0);
    EXPECT_EQ(path_pose(3), 0.1f);
    EXPECT_EQ(path_pose(15), 0.5f);
    EXPECT_EQ(path_pose(30), 1);
    EXPECT_EQ(path_pose(45), 0.5f);
    EXPECT_EQ(path_pose(57), 0.1f);
    EXPECT_EQ(path_pose(60), 0);
    EXPECT_EQ(path_pose(6'000'003), 0.1f);
}

}  // namespace
}  // namespace swath
