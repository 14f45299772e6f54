#pragma once
#include <memory>

#include "common/base/result.h"
#include "common/render/renderer.h"

namespace swath {

// Makes a renderer of any kind on the calling thread. The scene must outlive it. Fails when the library or
// the driver is missing, or the scene does not fit.
Result<std::unique_ptr<Renderer>> make_renderer(const RendererSetup& setup, const ObjectSet& scene);

// Whether ray casters' trees can be built on a CUDA device of this machine (RendererSetup::cuda). Where they
// cannot, the log gets a line that says why, and that threads build them: so ask once.
bool can_build_on_cuda();

}  // namespace swath
