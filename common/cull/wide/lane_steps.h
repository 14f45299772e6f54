#pragma once
// Steps that the kernels of the hierarchy and of the octree share. Only for kernels, like lanes.h.
#include <cstddef>
#include <cstdint>

#include "common/base/lanes/lanes.h"
#include "common/cull/wide/kernel_planes.h"

namespace swath::SWATH_KERNEL {
namespace {

alignas(64) constexpr std::uint32_t kCounting[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

// plane_distance() of frustum.h for 16 boxes at once. `at` is plane.p or plane.n.
inline Floats distance(const KernelPlane& plane, const float* block, const std::uint32_t (&at)[3]) {
    return fused(
        all(plane.x), load(block + at[0]),
        fused(all(plane.y), load(block + at[1]), fused(all(plane.z), load(block + at[2]), all(plane.w))));
}

// Three planes with their p-vertices, as many as fit into registers.
struct ThreePlanes {
    explicit ThreePlanes(const KernelPlane* planes) {
        for (int k = 0; k < 3; ++k) {
            x[k] = all(planes[k].x);
            y[k] = all(planes[k].y);
            z[k] = all(planes[k].z);
            w[k] = all(planes[k].w);
            for (int axis = 0; axis < 3; ++axis) at[k][axis] = planes[k].p[axis];
        }
    }
    std::uint32_t outside(const float* block) const {
        std::uint32_t gone = 0;
        for (int k = 0; k < 3; ++k)
            gone |= below_zero(
                fused(x[k], load(block + at[k][0]),
                      fused(y[k], load(block + at[k][1]), fused(z[k], load(block + at[k][2]), w[k]))));
        return gone;
    }
    Floats x[3];
    Floats y[3];
    Floats z[3];
    Floats w[3];
    std::size_t at[3][3];
};

// Writes the ids [first, last) in steps of 16, and the last 8 or fewer in one of 8. Scribbles no further.
inline std::uint32_t* fill(std::uint32_t first, std::uint32_t last, std::uint32_t* out) {
    Words ids = add(all(first), load(kCounting));
    const Words step = all(16u);
    std::uint32_t* const end = out + (last - first);
    for (; end - out > 8; out += 16) {
        store(out, ids);
        ids = add(ids, step);
    }
    if (out < end) store8(out, ids);
    return end;
}

}  // namespace
}  // namespace swath::SWATH_KERNEL
