#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/render/gl_context.h"
#include "common/render/gl_functions.h"
#include "common/render/renderer.h"

namespace swath {

// The rasteriser behind OSMesa and EGL. It draws into one framebuffer object with RGBA8 colour, R32UI object
// id and D32F depth, with at most one draw call an object. Pixels are the same on all servers because it
// draws with the full viewport, limited by the scissor, with GL_LESS and ascending ids (docs/design.md,
// "Exactness").
class GlRenderer final : public Renderer {
  public:
    static Result<std::unique_ptr<Renderer>> make(std::unique_ptr<GlContext> context, const ObjectSet& scene);

    Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) override;
    Status read(const Rect& rect, PixelFrame& frame) override;
    std::string description() const override;

  private:
    GlRenderer(std::unique_ptr<GlContext> context, const ObjectSet& scene, const GlFunctions& gl);
    Status make_program();
    Status upload();
    Status resize(int width, int height);
    void draw_object(std::span<const TriangleRange> ranges);
    Status check(const char* what) const;

    std::unique_ptr<GlContext> context_;  // GL objects end with it
    const ObjectSet& scene_;
    GlFunctions gl_;
    int width_ = 0;
    int height_ = 0;
    Rect drawn_;  // of the framebuffer, by the last draw
    GLuint colour_buffer_ = 0;
    GLuint id_buffer_ = 0;
    GLuint depth_buffer_ = 0;
    GLint clip_from_model_ = -1;
    GLint to_light_ = -1;
    GLint pose_ = -1;  // only of a moving model
    GLint object_ = -1;
    std::vector<GLsizei> counts_;         // of the ranges of one object, in indices
    std::vector<const void*> positions_;  // of these in the index buffer, in bytes
};

// With OSMesa or EGL, on the calling thread. The scene must outlive it. Fails when the library or the driver
// is missing, and names its package, or when the scene does not fit.
Result<std::unique_ptr<Renderer>> make_gl_renderer(RendererKind kind, const ObjectSet& scene);

// Whether OSMesa or EGL works here: its renderer's description, or why there is none. Makes a context on the
// calling thread, which must have none, and ends it.
Result<std::string> try_gl(RendererKind kind);

}  // namespace swath
