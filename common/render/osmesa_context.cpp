#include <array>

#include "common/render/gl_context.h"
#include "common/render/gl_packages.h"
#include "common/render/gl_types.h"
#include "common/render/shared_library.h"

namespace swath {
namespace {

// What we use of Mesa's GL/osmesa.h.
constexpr int OSMESA_FORMAT = 0x22;
constexpr int OSMESA_RGBA = GL_RGBA;
constexpr int OSMESA_PROFILE = 0x33;
constexpr int OSMESA_CORE_PROFILE = 0x34;
constexpr int OSMESA_CONTEXT_MAJOR_VERSION = 0x36;
constexpr int OSMESA_CONTEXT_MINOR_VERSION = 0x37;

struct OsmesaFunctions {
    void* (*CreateContextAttribs)(const int* attributes, void* shared) = nullptr;
    void (*DestroyContext)(void* context) = nullptr;
    GLboolean (*MakeCurrent)(void* context, void* window, GLenum type, GLsizei width,
                             GLsizei height) = nullptr;
    void* (*GetProcAddress)(const char* name) = nullptr;
};

Result<OsmesaFunctions> load_osmesa() {
    const auto library = SharedLibrary::load("libOSMesa.so.8");
    if (!library)
        return fail("OSMesa: {}; {}", library.error().message, how_to_get_here(RendererKind::kOsmesa));
    OsmesaFunctions osmesa;
    if (!library->bind("OSMesaCreateContextAttribs", osmesa.CreateContextAttribs) ||
        !library->bind("OSMesaDestroyContext", osmesa.DestroyContext) ||
        !library->bind("OSMesaMakeCurrent", osmesa.MakeCurrent) ||
        !library->bind("OSMesaGetProcAddress", osmesa.GetProcAddress))
        return fail("OSMesa: this library is too old for core contexts");
    return osmesa;
}

class OsmesaContext final : public GlContext {
  public:
    OsmesaContext(const OsmesaFunctions& osmesa, void* context) : osmesa_(osmesa), context_(context) {}
    ~OsmesaContext() override { osmesa_.DestroyContext(context_); }
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    bool make_current() {
        return osmesa_.MakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kWindow, kWindow) == GL_TRUE;
    }
    void* function(const char* name) const override { return osmesa_.GetProcAddress(name); }

  private:
    // OSMesa insists on a window buffer; we draw to a framebuffer object and never look at it.
    static constexpr int kWindow = 16;
    std::array<unsigned char, std::size_t{4} * kWindow * kWindow> window_{};
    OsmesaFunctions osmesa_;
    void* context_;
};

}  // namespace

Result<std::unique_ptr<GlContext>> make_osmesa_context() {
    SWATH_TRY(const OsmesaFunctions osmesa, load_osmesa());
    const std::array<int, 9> attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        3,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        3,
                                        0};
    void* const raw = osmesa.CreateContextAttribs(attributes.data(), nullptr);
    if (raw == nullptr) return fail("OSMesa: cannot create an OpenGL 3.3 core context");
    auto context = std::make_unique<OsmesaContext>(osmesa, raw);
    if (!context->make_current()) return fail("OSMesa: cannot make the context current");
    return context;
}

}  // namespace swath
