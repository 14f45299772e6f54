#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "common/base/result.h"
#include "common/geometry/camera.h"
#include "common/image/pixel_frame.h"
#include "common/render/draw_settings.h"
#include "common/scene/objects.h"
#include "common/scene/triangle_range.h"

namespace swath {

// What one machine draws with.
struct RendererSetup {
    RendererKind kind = RendererKind::kOsmesa;
    RenderFlags flags{};
    // Of the ray caster; OpenGL's library knows its threads by itself.
    std::size_t threads = 1;  // that may cast rays, the drawing one among them; at least 1
    bool cuda = false;        // its trees are built on a CUDA device, where there is one, not on the threads
    bool operator==(const RendererSetup&) const = default;
};

// Draws objects of one ObjectSet and hands out the pixels. A pixel depends on the objects and the view only,
// never on which pixels are asked for: that makes a cluster's picture exact. It is bound to the thread that
// made it: all calls come from there, and no second renderer lives there.
class Renderer {
  public:
    virtual ~Renderer() = default;

    // Draws `ranges` (ascending triangles, each range in its object) with the view's full viewport, limited to
    // `rect`, which must lie in it. Blocks until all is drawn. The nearer fragment wins, of equal depths the
    // smaller id. Errors name the limit or what the device lacks.
    virtual Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) = 0;

    // Writes colour, depth and id of `rect` into `frame`. CHECKs that both the last draw's rectangle and the
    // frame contain it.
    virtual Status read(const Rect& rect, PixelFrame& frame) = 0;

    // Says for people what draws: library, version, limits.
    virtual std::string description() const = 0;
};

}  // namespace swath
