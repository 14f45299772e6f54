#pragma once
#include <memory>

#include "common/base/result.h"
#include "common/render/renderer.h"

namespace swath {

// Makes a ray caster for `scene`, which must outlive it, on the calling thread. It casts one ray through the
// centre of every pixel, from the eye of the view's matrix. Except at edges, pixels are about the
// rasteriser's: colours are shaded per vertex, and depth is the same function of the point. A pixel depends
// on the objects and the view only; of surfaces with the same float as depth the smaller object id shows,
// then the smaller triangle. Fails if the tree cannot be built; drawing fails if the view is no perspective
// or its matrix has no inverse.
Result<std::unique_ptr<Renderer>> make_raycast_renderer(const RendererSetup& setup, const ObjectSet& scene);

}  // namespace swath
