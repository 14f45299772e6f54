#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "common/base/result.h"
#include "common/geometry/camera.h"
#include "common/image/pixel_frame.h"
#include "common/render/renderer_kind.h"
#include "common/scene/draw_run.h"
#include "common/scene/objects.h"

namespace swath {

// What to draw with, and how.
struct RendererSetup {
    RendererKind kind = RendererKind::kOsmesa;
    // Of the ray caster; OpenGL has neither, and its library knows its threads by itself.
    bool shadows = false;     // hard ones, cast by the whole model
    bool dynamic = false;     // its tree is built anew for every frame, over what is drawn
    std::size_t threads = 1;  // that may cast rays, the drawing one among them; at least 1
    bool cuda = false;        // its trees are built on a CUDA device, where there is one, not on the threads
    bool operator==(const RendererSetup&) const = default;
};

// Draws objects of one ObjectSet and hands out the pixels. What it draws for a pixel depends on the objects
// and the view only, never on the other pixels asked for: that is what makes a cluster's picture exact. A
// resource bound to the thread that made it: every call comes from there, and no second renderer lives there.
class Renderer {
  public:
    virtual ~Renderer() = default;

    // Draws `runs` (of ascending triangles, each inside of its object) with the view's full viewport, limited
    // to `rect`. Blocks until it is drawn. A nearer fragment wins; of equal depths the one drawn first, so
    // the smaller id.
    virtual Status draw(std::span<const DrawRun> runs, const View& view, const Rect& rect) = 0;

    // Colour, depth and id of `rect` of the last draw, into `frame`, which must contain it.
    virtual Status read(const Rect& rect, PixelFrame& frame) = 0;

    // For people: library, version, limits.
    virtual std::string description() const = 0;
};

}  // namespace swath
