#include <array>
#include <cstdint>

#include "common/render/gl_context.h"
#include "common/render/gl_packages.h"
#include "common/render/shared_library.h"

namespace swath {
namespace {

// What we use of Khronos' EGL 1.5, with Mesa's platform without a surface.
using EGLBoolean = unsigned int;
using EGLenum = unsigned int;
using EGLint = std::int32_t;
using EGLAttrib = std::intptr_t;
using EGLDisplay = void*;
using EGLConfig = void*;
using EGLContext = void*;
using EGLSurface = void*;
constexpr EGLBoolean EGL_TRUE = 1;
constexpr EGLint EGL_PBUFFER_BIT = 0x0001;
constexpr EGLint EGL_OPENGL_BIT = 0x0008;
constexpr EGLint EGL_SURFACE_TYPE = 0x3033;
constexpr EGLint EGL_NONE = 0x3038;
constexpr EGLint EGL_RENDERABLE_TYPE = 0x3040;
constexpr EGLint EGL_CONTEXT_MAJOR_VERSION = 0x3098;
constexpr EGLint EGL_CONTEXT_MINOR_VERSION = 0x30FB;
constexpr EGLint EGL_CONTEXT_OPENGL_PROFILE_MASK = 0x30FD;
constexpr EGLint EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT = 0x0001;
constexpr EGLenum EGL_OPENGL_API = 0x30A2;
constexpr EGLenum EGL_PLATFORM_SURFACELESS_MESA = 0x31DD;

struct EglFunctions {
    EGLDisplay (*GetPlatformDisplay)(EGLenum platform, void* native, const EGLAttrib* attributes) = nullptr;
    EGLBoolean (*Initialize)(EGLDisplay display, EGLint* major, EGLint* minor) = nullptr;
    EGLint (*GetError)() = nullptr;
    EGLBoolean (*BindAPI)(EGLenum api) = nullptr;
    EGLBoolean (*ChooseConfig)(EGLDisplay display, const EGLint* wanted, EGLConfig* configs, EGLint size,
                               EGLint* count) = nullptr;
    EGLContext (*CreateContext)(EGLDisplay display, EGLConfig config, EGLContext shared,
                                const EGLint* attributes) = nullptr;
    EGLBoolean (*DestroyContext)(EGLDisplay display, EGLContext context) = nullptr;
    EGLBoolean (*MakeCurrent)(EGLDisplay display, EGLSurface draw, EGLSurface read,
                              EGLContext context) = nullptr;
    EGLBoolean (*ReleaseThread)() = nullptr;
    void* (*GetProcAddress)(const char* name) = nullptr;
};

Result<EglFunctions> load_egl() {
    const auto library = SharedLibrary::load("libEGL.so.1");
    if (!library) return fail("EGL: {}; {}", library.error().message, how_to_get_here(RendererKind::kEgl));
    EglFunctions egl;
    if (!library->bind("eglGetPlatformDisplay", egl.GetPlatformDisplay) ||
        !library->bind("eglInitialize", egl.Initialize) || !library->bind("eglGetError", egl.GetError) ||
        !library->bind("eglBindAPI", egl.BindAPI) || !library->bind("eglChooseConfig", egl.ChooseConfig) ||
        !library->bind("eglCreateContext", egl.CreateContext) ||
        !library->bind("eglDestroyContext", egl.DestroyContext) ||
        !library->bind("eglMakeCurrent", egl.MakeCurrent) ||
        !library->bind("eglReleaseThread", egl.ReleaseThread) ||
        !library->bind("eglGetProcAddress", egl.GetProcAddress))
        return fail("EGL: this library is older than EGL 1.5");
    return egl;
}

class EglContext final : public GlContext {
  public:
    EglContext(const EglFunctions& egl, EGLDisplay display, EGLContext context)
        : egl_(egl), display_(display), context_(context) {}
    ~EglContext() override {
        egl_.MakeCurrent(display_, nullptr, nullptr, nullptr);
        egl_.DestroyContext(display_, context_);
        egl_.ReleaseThread();
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    bool make_current() { return egl_.MakeCurrent(display_, nullptr, nullptr, context_) == EGL_TRUE; }
    void* function(const char* name) const override { return egl_.GetProcAddress(name); }

  private:
    EglFunctions egl_;
    EGLDisplay display_;
    EGLContext context_;
};

}  // namespace

Result<std::unique_ptr<GlContext>> make_egl_context() {
    SWATH_TRY(const EglFunctions egl, load_egl());
    // libEGL only passes calls on: without Mesa's part there is no such display, or it cannot be initialised.
    const EGLDisplay display = egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display == nullptr)
        return fail("EGL: no surfaceless platform; {}", how_to_get_here(RendererKind::kEgl));
    if (egl.Initialize(display, nullptr, nullptr) != EGL_TRUE)
        return fail("EGL: cannot initialise the display (error {:#x}); {}", egl.GetError(),
                    how_to_get_here(RendererKind::kEgl));
    if (egl.BindAPI(EGL_OPENGL_API) != EGL_TRUE) return fail("EGL: this driver has no desktop OpenGL");
    // The default asks for configurations that can draw to a window, which this platform has none of.
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                       EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    if (egl.ChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
        return fail("EGL: no configuration for OpenGL");
    const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    const EGLContext raw = egl.CreateContext(display, config, nullptr, attributes.data());
    if (raw == nullptr) return fail("EGL: cannot create an OpenGL 3.3 core context");
    auto context = std::make_unique<EglContext>(egl, display, raw);
    if (!context->make_current()) return fail("EGL: cannot make the context current");
    return context;
}

}  // namespace swath
