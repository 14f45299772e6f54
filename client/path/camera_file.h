#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/geometry/camera.h"

namespace swath {

// A camera in files and on the page: eye, target, up, vertical angle in degrees.
using CameraNumbers = std::array<float, 10>;

// Leaves near and far planes at their defaults. Errors say why nobody can look through it: a number that is
// not finite or above 1e18, eye and target at one point, up along the line of sight, an angle outside (0,
// 180).
Result<Camera> camera_of(const CameraNumbers& numbers);
CameraNumbers numbers_of(const Camera& camera);
// A line of a camera file, without its end. Read back it gives the same bits.
std::string to_line(const CameraNumbers& numbers);

// Reads cameras, one a line: `ex ey ez tx ty tz ux uy uz fov_degrees` (eye, target, up, vertical angle). '#'
// starts a comment, empty lines are skipped. There must be at least one, and camera_of() must accept each.
// Errors start with `name` and the line.
Result<std::vector<Camera>> parse_cameras(std::string_view text, std::string_view name);

// Reads a file of at most kMaxCameraFileBytes.
Result<std::vector<Camera>> read_cameras(const std::string& path);
inline constexpr std::uint64_t kMaxCameraFileBytes = 64 << 20;

}  // namespace swath
