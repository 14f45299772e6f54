#pragma once
#include <vector>

#include "common/wire/messages.h"

namespace swath {

// How the servers of a run draw: all alike, but that the renderers are dealt out to them in turn, by their
// numbers. A server gets the smallest number that is free, in the order in which they join. A value.
struct RunDrawing {
    Cut cut;
    std::vector<RendererKind> renderers{RendererKind::kOsmesa};  // not empty
    CullAlgorithm cull = CullAlgorithm::kWide;
    bool shadows = false;
    bool dynamic = false;
    bool operator==(const RunDrawing&) const = default;

    Drawing of(ServerId server) const {
        return {cut, renderers[index(server) % renderers.size()], cull, shadows, dynamic};
    }
};

}  // namespace swath
