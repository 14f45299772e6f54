#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/geometry/box.h"
#include "common/geometry/camera.h"

namespace swath {

struct PathOptions {
    // 1 to kMaxPathFrames. If none: 50 as in the paper, or as many as a file has.
    std::optional<std::size_t> frames = std::nullopt;
    std::uint64_t seed = 1;      // of `random`
    float aspect = 4.0f / 3.0f;  // width / height of the picture
    float zoom = 1.0f;           // at 1 the model about fills the screen; ignored for a file
};
inline constexpr std::size_t kDefaultPathFrames = 50;
inline constexpr std::size_t kMaxPathFrames = 1'000'000;

// Makes the cameras of a run. `spec` is one of
//   orbit    once around the model at equal steps of azimuth, a little above it, as near as the whole box
//            fits in the picture (at zoom 1)
//   random   the path of Samanta 2000's simulations, as far as its Table 1 pins it down: once around, each
//            frame at a random elevation within 0.65 rad, 0.3 rad of view, the screen as high as the box's
//            longest side divided by `zoom`. The same seed gives the same bits everywhere.
//   a file   of cameras, see read_cameras(); repeated from its start if it has fewer than `frames`
// All have the depth range of with_depth_range(). `bounds` contains the model at every pose and is not empty.
// Errors name the option, or the file and line.
Result<std::vector<Camera>> make_path(const std::string& spec, const Box& bounds, const PathOptions& options);

// Sets near and far planes about `bounds` as seen from the camera, so that nothing of it is clipped in depth.
// From inside, or very close, near is a thousandth of the box's diagonal.
Camera with_depth_range(Camera camera, const Box& bounds);

// The pose of a moving model in a frame of a path: from 0 to 1 in kPoseFrames frames, back to 0 in as many,
// and so on.
inline constexpr std::size_t kPoseFrames = 30;
float path_pose(FrameNumber frame);

}  // namespace swath
