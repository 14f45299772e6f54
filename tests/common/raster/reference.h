#pragma once
#include "common/geometry/camera.h"
#include "common/image/pixel_frame.h"
#include "common/scene/objects.h"

namespace swath::test {

// Draws a whole model, one triangle after the other, sample by sample, by the formulas of docs/raster.md in plain
// C++ with 64-bit edges: no meshlets, bins, vectors or occlusion. Slow.
PixelFrame reference_picture(const ObjectSet& scene, const View& view);

}  // namespace swath::test
