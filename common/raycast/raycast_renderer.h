#pragma once
#include <memory>

#include "common/base/result.h"
#include "common/render/renderer.h"

namespace swath {

// A ray caster for `scene`, which must outlive it, on the calling thread: one ray through the centre of every
// pixel, from the eye that the view's matrix has. Pixels are the rasteriser's but for those at edges: colour
// is shaded per vertex alike, depth is the same function of the point. A pixel depends on the objects and the
// view only; of surfaces at the same depth, as a float, the smaller object id shows, then the smaller
// triangle. Drawing fails where the view is no perspective, or its matrix has no inverse.
Result<std::unique_ptr<Renderer>> make_raycast_renderer(const RendererSetup& setup, const ObjectSet& scene);

}  // namespace swath
