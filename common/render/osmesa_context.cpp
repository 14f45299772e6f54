#include <GL/osmesa.h>

#include <array>

#include "common/render/gl_context.h"

namespace swath {
namespace {

class OsmesaContext final : public GlContext {
  public:
    explicit OsmesaContext(OSMesaContext context) : context_(context) {}
    ~OsmesaContext() override { OSMesaDestroyContext(context_); }
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    bool make_current() {
        return OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kWindow, kWindow) == GL_TRUE;
    }
    void* function(const char* name) const override {
        return reinterpret_cast<void*>(OSMesaGetProcAddress(name));
    }

  private:
    // OSMesa insists on a window buffer; we draw to a framebuffer object and never look at it.
    static constexpr int kWindow = 16;
    std::array<unsigned char, std::size_t{4} * kWindow * kWindow> window_{};
    OSMesaContext context_;
};

}  // namespace

Result<std::unique_ptr<GlContext>> make_osmesa_context() {
    const std::array<int, 9> attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        3,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        3,
                                        0};
    const OSMesaContext raw = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (raw == nullptr) return fail("OSMesa: cannot create an OpenGL 3.3 core context");
    auto context = std::make_unique<OsmesaContext>(raw);
    if (!context->make_current()) return fail("OSMesa: cannot make the context current");
    return context;
}

}  // namespace swath
