#include "common/renderers/make_renderer.h"

#include <spdlog/spdlog.h>

#include "common/octree/sah/sah_builder.h"
#include "common/raycast/raycast_renderer.h"
#include "common/render/gl_renderer.h"

namespace swath {

Result<std::unique_ptr<Renderer>> make_renderer(const RendererSetup& setup, const ObjectSet& scene) {
    if (setup.kind == RendererKind::kRaycast) return make_raycast_renderer(setup, scene);
    return make_gl_renderer(setup.kind, scene);
}

bool can_build_on_cuda() {
    const std::string missing = missing_cuda();
    if (!missing.empty()) spdlog::warn("--trees-on cuda: {}; threads build the trees", missing);
    return missing.empty();
}

}  // namespace swath
