#include "common/render/gl_functions.h"

namespace swath {

Result<GlFunctions> load_gl_functions(const GlContext& context) {
    GlFunctions gl;
#define SWATH_GL_LOAD(result, name, parameters)                                     \
    gl.name = reinterpret_cast<result(*) parameters>(context.function("gl" #name)); \
    if (gl.name == nullptr) return fail("OpenGL: the library has no gl" #name);
    SWATH_GL_FUNCTIONS(SWATH_GL_LOAD)
#undef SWATH_GL_LOAD
    return gl;
}

}  // namespace swath
