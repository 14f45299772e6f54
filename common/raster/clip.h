#pragma once
#include <array>
#include <span>
#include <vector>

#include "common/raster/raster_kernel.h"

namespace swath {

// A vertex before the division by w.
struct ClipVertex {
    std::array<float, 4> position{};  // x, y, z, w in clip space
    std::array<float, 3> colour{};    // shaded, 0 to 255
};

// Computes vertex `i` of a meshlet with the bits of the kernels.
ClipVertex clip_vertex(const KernelView& view, const KernelMeshlet& meshlet, std::uint32_t i);

// Returns whether a triangle with this vertex has to be clipped: it is not in front of the near plane or beyond
// the guard. Kernels draw the other triangles.
bool needs_clipping(const KernelView& view, const ClipVertex& vertex);

// Cuts a triangle at the near plane and the guard, a function of the triangle and the view alone, and adds what
// is left to `out`. Where two triangles share an edge, so do the parts.
void clip(const KernelView& view, const std::array<ClipVertex, 3>& triangle, std::uint32_t number,
          std::vector<ScreenTriangle>& out);

}  // namespace swath
