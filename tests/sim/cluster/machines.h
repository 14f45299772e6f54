#pragma once
#include "client/cost/hardware.h"
#include "common/geometry/camera.h"

namespace swath::test {

inline constexpr double kNothing = 1e-6;  // upper limit of a frame's seconds on free_hardware()

// Machines and a network that take almost no time.
inline Hardware free_hardware() {
    constexpr double kFast = 1e15;  // per second, for all units
    Hardware hardware;
    hardware.name = "free";
    hardware.network.bytes_per_s = kFast;
    hardware.network.swath_bytes_per_pixel = 8;
    hardware.network.tile_bytes_per_pixel = 4;
    hardware.server.fill_pixels_per_s = kFast;
    hardware.server.colour = {0, kFast, kFast};
    hardware.server.depth = {0, kFast, kFast};
    hardware.server.pack_pixels_per_s = kFast;
    hardware.server.merge_pixels_per_s = kFast;
    hardware.display.colour = {0, kFast, kFast};
    return hardware;
}

// Lies at (0, 0, 4) and sees about [-1, 1] cubed.
inline Camera front_camera() {
    Camera camera;
    camera.eye = {0, 0, 4};
    camera.fov_y = 0.6f;
    return camera;
}

}  // namespace swath::test
