#include "common/renderers/make_renderer.h"

#include "common/base/log.h"
#include "common/octree/sah/sah_builder.h"
#include "common/raster/raster_renderer.h"
#include "common/raycast/raycast_renderer.h"
#include "common/render/gl_renderer.h"

namespace swath {

Result<std::unique_ptr<Renderer>> make_renderer(const RendererSetup& setup, const ObjectSet& scene) {
    if (setup.kind == RendererKind::kRaster) return make_raster_renderer(setup, scene);
    if (setup.kind == RendererKind::kRaycast) return make_raycast_renderer(setup, scene);
    return make_gl_renderer(setup.kind, scene);
}

DefaultRenderer default_renderer() {
    std::string missing;
    for (const RendererKind kind : {RendererKind::kOsmesa, RendererKind::kEgl}) {
        const auto found = try_gl(kind);
        if (found) return {kind, *found};
        missing += fmt::format("{}{}", missing.empty() ? "" : "; ", found.error().message);
    }
    return {RendererKind::kRaycast, missing};
}

std::string renderers_here() {
    std::string lines;
    for (const RendererKind kind : kAll<RendererKind>) {
        const Result<std::string> found = kind == RendererKind::kRaster    ? "draws triangles everywhere"
                                          : kind == RendererKind::kRaycast ? "casts rays everywhere"
                                                                           : try_gl(kind);
        lines +=
            fmt::format("{:<9}  {}\n", name_of(kind), found ? *found : "not here: " + found.error().message);
    }
    return lines;
}

bool can_build_on_cuda() {
    const std::string missing = missing_cuda();
    if (!missing.empty()) log_warning("--trees-on cuda: {}; threads build the trees", missing);
    return missing.empty();
}

}  // namespace swath
