#pragma once
#include "common/base/result.h"
#include "common/octree/sah/sah_settings.h"
#include "common/octree/sah/sah_triangles.h"

namespace swath {

// The least that a grain of 0 stands for.
inline constexpr std::uint32_t kMinSahGrain = 2048;

// Why no tree can be built of these triangles with these settings, or success: no triangles, positions that
// cannot be, settings out of range. Does not look at positions and indices.
Status check_sah(const SahTriangles& triangles, const SahSettings& settings);

}  // namespace swath
