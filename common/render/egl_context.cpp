#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "common/render/gl_context.h"

namespace swath {
namespace {

class EglContext final : public GlContext {
  public:
    EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    ~EglContext() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        eglReleaseThread();
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    bool make_current() {
        return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
    }
    void* function(const char* name) const override {
        return reinterpret_cast<void*>(eglGetProcAddress(name));
    }

  private:
    EGLDisplay display_;
    EGLContext context_;
};

}  // namespace

Result<std::unique_ptr<GlContext>> make_egl_context() {
    const EGLDisplay display =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY) return fail("EGL: no surfaceless platform (Mesa's libEGL is needed)");
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        return fail("EGL: cannot initialise the display (error {:#x})", eglGetError());
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return fail("EGL: this driver has no desktop OpenGL");
    // The default asks for configurations that can draw to a window, which this platform has none of.
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                       EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
        return fail("EGL: no configuration for OpenGL");
    const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    const EGLContext raw = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    if (raw == EGL_NO_CONTEXT) return fail("EGL: cannot create an OpenGL 3.3 core context");
    auto context = std::make_unique<EglContext>(display, raw);
    if (!context->make_current()) return fail("EGL: cannot make the context current");
    return context;
}

}  // namespace swath
