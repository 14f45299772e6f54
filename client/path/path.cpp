#include "client/path/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "client/path/camera_file.h"
#include "common/base/check.h"

namespace swath {
namespace {

constexpr float kOrbitFov = 0.6f;          // radians
constexpr double kOrbitElevation = 0.2;    // radians above the horizon
constexpr double kOrbitAir = 1.02;         // factor on the closest distance at which the box fits
constexpr float kRandomFov = 0.3f;         // radians; chosen as the next one to reproduce the paper's Table 1
constexpr double kRandomElevation = 0.65;  // radians, up and down
// The smallest near plane; depth keeps 1e-4 of the diagonal or better.
constexpr double kNearestOfDiagonal = 1e-3;
constexpr double kDepthAirOfDiagonal = 1e-2;

// The direction from the model to the eye: azimuth 0 looks along -z, up is the model's y.
glm::dvec3 direction(double azimuth, double elevation) {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

// The model's size as a length above 0, also if it is a single point.
double diagonal_of(const Box& bounds) {
    const double diagonal = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    const double reach =
        glm::length(glm::max(glm::abs(glm::dvec3(bounds.min)), glm::abs(glm::dvec3(bounds.max))));
    // A point far from the origin still needs distances that single precision can tell apart.
    return std::max({diagonal, 1e-4 * reach, 1e-12});
}

Camera camera_at(const Box& bounds, const glm::dvec3& towards_eye, double distance, float fov_y) {
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    Camera camera;
    camera.eye = glm::vec3(centre + towards_eye * distance);
    camera.target = glm::vec3(centre);
    camera.fov_y = fov_y;
    return with_depth_range(camera, bounds);
}

// The least distance from the centre along `towards_eye` at which the picture shows the whole box.
double fitting_distance(const Box& bounds, const glm::dvec3& towards_eye, double tan_x, double tan_y) {
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const glm::dvec3 side = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), towards_eye));
    const glm::dvec3 up = glm::cross(towards_eye, side);
    double distance = 0;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 corner = glm::dvec3(bounds.corner(k)) - centre;
        const double closer = glm::dot(corner, towards_eye);
        distance = std::max({distance, closer + std::abs(glm::dot(corner, side)) / tan_x,
                             closer + std::abs(glm::dot(corner, up)) / tan_y});
    }
    return distance;
}

double azimuth_of(std::size_t frame, std::size_t frames) {
    return 2 * std::numbers::pi * static_cast<double>(frame) / static_cast<double>(frames);
}

std::vector<Camera> orbit(const Box& bounds, std::size_t frames, const PathOptions& options) {
    const double tan_y = std::tan(0.5 * static_cast<double>(kOrbitFov));
    const double tan_x = tan_y * static_cast<double>(options.aspect);
    // All frames have one distance, so that the model does not breathe while it turns.
    double distance = 0.1 * diagonal_of(bounds);
    for (std::size_t k = 0; k < frames; ++k)
        distance = std::max(
            distance,
            fitting_distance(bounds, direction(azimuth_of(k, frames), kOrbitElevation), tan_x, tan_y));
    distance *= kOrbitAir / static_cast<double>(options.zoom);
    std::vector<Camera> cameras;
    cameras.reserve(frames);
    for (std::size_t k = 0; k < frames; ++k)
        cameras.push_back(
            camera_at(bounds, direction(azimuth_of(k, frames), kOrbitElevation), distance, kOrbitFov));
    return cameras;
}

std::vector<Camera> random(const Box& bounds, std::size_t frames, const PathOptions& options) {
    const glm::vec3 size = bounds.size();
    const double longest = std::max({static_cast<double>(size.x), static_cast<double>(size.y),
                                     static_cast<double>(size.z), 0.1 * diagonal_of(bounds)});
    const double visible_height = longest / static_cast<double>(options.zoom);
    const double distance = 0.5 * visible_height / std::tan(0.5 * static_cast<double>(kRandomFov));
    // The standard fixes the engine's numbers, but not those of its distributions.
    std::mt19937_64 engine(options.seed);
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };  // [0, 1)
    std::vector<Camera> cameras;
    cameras.reserve(frames);
    for (std::size_t k = 0; k < frames; ++k) {
        const double elevation = (2 * uniform() - 1) * kRandomElevation;
        cameras.push_back(
            camera_at(bounds, direction(azimuth_of(k, frames), elevation), distance, kRandomFov));
    }
    return cameras;
}

}  // namespace

Camera with_depth_range(Camera camera, const Box& bounds) {
    CHECK(!bounds.empty());
    const glm::dvec3 eye(camera.eye);
    const glm::dvec3 sight = glm::normalize(glm::dvec3(camera.target) - eye);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int k = 0; k < 8; ++k) {
        const double depth = glm::dot(glm::dvec3(bounds.corner(k)) - eye, sight);
        low = std::min(low, depth);
        high = std::max(high, depth);
    }
    const double diagonal = diagonal_of(bounds);
    const double near = std::max(low - kDepthAirOfDiagonal * diagonal, kNearestOfDiagonal * diagonal);
    const double far = std::max(high + kDepthAirOfDiagonal * diagonal, near + diagonal);
    camera.near = static_cast<float>(near);
    camera.far = static_cast<float>(far);
    return camera;
}

float path_pose(FrameNumber frame) {
    const FrameNumber at = frame % (2 * kPoseFrames);
    return static_cast<float>(std::min(at, 2 * kPoseFrames - at)) / static_cast<float>(kPoseFrames);
}

Result<std::vector<Camera>> make_path(const std::string& spec, const Box& bounds,
                                      const PathOptions& options) {
    CHECK(!bounds.empty());
    if (options.frames && (*options.frames < 1 || *options.frames > kMaxPathFrames))
        return fail("frames: {} is not within 1 to {}", *options.frames, kMaxPathFrames);
    if (!(options.zoom > 0 && std::isfinite(options.zoom)))
        return fail("zoom: {} is not positive", options.zoom);
    if (!(options.aspect > 0 && std::isfinite(options.aspect)))
        return fail("aspect: {} is not positive", options.aspect);
    const std::size_t frames = options.frames.value_or(kDefaultPathFrames);
    if (spec == "orbit") return orbit(bounds, frames, options);
    if (spec == "random") return random(bounds, frames, options);

    Result<std::vector<Camera>> from_file = read_cameras(spec);
    if (!from_file) return fail_in("camera path", from_file.error());
    std::vector<Camera> cameras;
    const std::size_t count = options.frames.value_or(from_file->size());
    cameras.reserve(count);
    for (std::size_t k = 0; k < count; ++k)
        cameras.push_back(with_depth_range((*from_file)[k % from_file->size()], bounds));
    return cameras;
}

}  // namespace swath
