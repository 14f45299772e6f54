#pragma once
#include <vector>

#include "common/base/ids.h"
#include "common/cull/cull_algorithm.h"
#include "common/render/renderer_kind.h"
#include "common/scene/objects.h"

namespace swath {

// What a ray caster does beside casting rays to what it draws. OpenGL does none of it.
struct RenderFlags {
    bool shadows = false;  // hard ones, cast by the whole model
    bool dynamic = false;  // the tree is built anew for every frame, over what is drawn
    bool operator==(const RenderFlags&) const = default;
};

// How the servers of a run draw. A value.
struct DrawSettings {
    // Dealt out to the servers in turn, by their numbers; not empty. A server gets the smallest number that is
    // free, in the order in which they join.
    std::vector<RendererKind> renderers{RendererKind::kOsmesa};
    CullAlgorithm cull = CullAlgorithm::kWide;
    RenderFlags flags{};

    RendererKind renderer_of(ServerId server) const { return renderers[index(server) % renderers.size()]; }
    bool operator==(const DrawSettings&) const = default;
};

// How the servers of a run draw the model that it has: as above, in the objects of one cut. A value.
struct Drawing : DrawSettings {
    Cut cut{};
    bool operator==(const Drawing&) const = default;
};

}  // namespace swath
