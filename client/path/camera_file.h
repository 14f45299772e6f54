#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/geometry/camera.h"

namespace swath {

// A camera as files and viewers write it: eye, target, up, vertical angle in degrees.
using CameraNumbers = std::array<float, 10>;

// Near and far planes are left at their defaults. Errors say why nobody can look through it: numbers that are
// not finite or above 1e18, eye and target at one point, up along the line of sight, an angle outside (0,
// 180).
Result<Camera> camera_of(const CameraNumbers& numbers);
CameraNumbers numbers_of(const Camera& camera);
// As a line of a camera file, without its end; read back, it is the same bits.
std::string to_line(const CameraNumbers& numbers);

// Cameras from text, one a line: `ex ey ez tx ty tz ux uy uz fov_degrees` (eye, target, up, vertical angle).
// '#' starts a comment, empty lines are skipped. Near and far planes are left at their defaults. At least
// one camera, each one that can be looked through: finite numbers, eye and target apart, up not along the
// line of sight, the angle within (0, 180). Errors start with `name` and the line.
Result<std::vector<Camera>> parse_cameras(std::string_view text, std::string_view name);

// The same from a file of at most kMaxCameraFileBytes.
Result<std::vector<Camera>> read_cameras(const std::string& path);
inline constexpr std::uint64_t kMaxCameraFileBytes = 64 << 20;

}  // namespace swath
