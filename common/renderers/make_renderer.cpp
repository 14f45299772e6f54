#include "common/renderers/make_renderer.h"

#include "common/raycast/raycast_renderer.h"
#include "common/render/gl_renderer.h"

namespace swath {

Result<std::unique_ptr<Renderer>> make_renderer(const RendererSetup& setup, const ObjectSet& scene) {
    if (setup.kind == RendererKind::kRaycast) return make_raycast_renderer(setup, scene);
    return make_gl_renderer(setup.kind, scene);
}

}  // namespace swath
