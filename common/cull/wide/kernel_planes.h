#pragma once
#include <cstdint>

namespace swath {

// A plane of a frustum as kernels take it.
struct KernelPlane {
    float x, y, z, w;
    // The indices in a block at which the arrays with x, y and z of the p-vertex, and of the n-vertex, begin.
    std::uint32_t p[3];
    std::uint32_t n[3];
};
inline constexpr std::uint32_t kAllPlanes = 0x3f;

}  // namespace swath
