#pragma once
#include <memory>
#include <string>

#include "common/base/result.h"
#include "common/render/renderer.h"

namespace swath {

// Makes a renderer of any kind on the calling thread. The scene must outlive it. Fails when the library or
// the driver is missing, or the scene does not fit.
Result<std::unique_ptr<Renderer>> make_renderer(const RendererSetup& setup, const ObjectSet& scene);

struct DefaultRenderer {
    RendererKind kind;
    std::string description;  // its library and version, or what the others lack; for people
};
// What draws where nobody says with what: the first that works on this machine of OSMesa, EGL and the ray
// caster, which always does. Of the calling thread as try_gl().
DefaultRenderer default_renderer();

// For people, a line for each renderer: what it is on this machine, or why it cannot draw here. Of the calling
// thread as try_gl().
std::string renderers_here();

// Whether ray casters' trees can be built on a CUDA device of this machine (RendererSetup::cuda). Where they
// cannot, the log gets a line that says why, and that threads build them: so ask once.
bool can_build_on_cuda();

}  // namespace swath
