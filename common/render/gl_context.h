#pragma once
#include <memory>

#include "common/base/result.h"

namespace swath {

// An OpenGL 3.3 core context without a window, current on the thread that made it until it is destroyed
// there. What it draws to is a framebuffer object of the caller's.
class GlContext {
  public:
    virtual ~GlContext() = default;
    // The address of a GL function, or null. (The library's own loader: a process may hold several GLs.)
    virtual void* function(const char* name) const = 0;
};

Result<std::unique_ptr<GlContext>> make_osmesa_context();
Result<std::unique_ptr<GlContext>> make_egl_context();  // surfaceless

}  // namespace swath
