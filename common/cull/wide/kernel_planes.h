#pragma once
#include <cstdint>

namespace swath {

// A plane of a frustum as kernels take it.
struct KernelPlane {
    float x, y, z, w;
    // Of the x, y and z arrays of a block's six, where those with the p-vertex's and the n-vertex's
    // coordinates begin, in numbers.
    std::uint32_t p[3];
    std::uint32_t n[3];
};
inline constexpr std::uint32_t kAllPlanes = 0x3f;

}  // namespace swath
