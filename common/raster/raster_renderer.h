#pragma once
#include <memory>

#include "common/base/instruction_set.h"
#include "common/base/result.h"
#include "common/render/renderer.h"

namespace swath {

// Makes our own rasteriser for `scene`, which must outlive it, on the calling thread. docs/raster.md says which
// pixels it draws; they depend on the objects and the view only, to the last bit, whatever the processor. Of
// fragments at the same depth the smaller triangle shows. A picture has at most 16384x16384 pixels.
Result<std::unique_ptr<Renderer>> make_raster_renderer(const RendererSetup& setup, const ObjectSet& scene,
                                                       InstructionSet set = best_instruction_set());

}  // namespace swath
