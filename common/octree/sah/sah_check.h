#pragma once
#include "common/base/result.h"
#include "common/octree/sah/sah_settings.h"
#include "common/octree/sah/sah_triangles.h"

namespace swath {

// The smallest grain that SahSettings::grain = 0 stands for.
inline constexpr std::uint32_t kMinSahGrain = 2048;

// Fails if no tree can be built: there are no triangles, the number or the stride of positions is impossible,
// or a setting is out of range. Does not read positions and indices.
Status check_sah(const SahTriangles& triangles, const SahSettings& settings);

}  // namespace swath
