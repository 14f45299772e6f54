#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/geometry/camera.h"

namespace swath {

// Cameras from text, one a line: `ex ey ez tx ty tz ux uy uz fov_degrees` (eye, target, up, vertical angle).
// '#' starts a comment, empty lines are skipped. Near and far planes are left at their defaults. At least
// one camera, each one that can be looked through: finite numbers, eye and target apart, up not along the
// line of sight, the angle within (0, 180). Errors start with `name` and the line.
Result<std::vector<Camera>> parse_cameras(std::string_view text, std::string_view name);

// The same from a file of at most kMaxCameraFileBytes.
Result<std::vector<Camera>> read_cameras(const std::string& path);
inline constexpr std::uint64_t kMaxCameraFileBytes = 64 << 20;

}  // namespace swath
