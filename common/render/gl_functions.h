#pragma once
#include "common/base/result.h"
#include "common/render/gl_context.h"
#include "common/render/gl_types.h"

namespace swath {

// The GL functions that the renderer calls, loaded from one context.
// X(result, member, parameters): member is the name in the specification without `gl`.
#define SWATH_GL_FUNCTIONS(X)                                                                 \
    X(void, AttachShader, (GLuint, GLuint))                                                   \
    X(void, BindBuffer, (GLenum, GLuint))                                                     \
    X(void, BindFramebuffer, (GLenum, GLuint))                                                \
    X(void, BindRenderbuffer, (GLenum, GLuint))                                               \
    X(void, BindVertexArray, (GLuint))                                                        \
    X(void, BufferData, (GLenum, GLsizeiptr, const void*, GLenum))                            \
    X(GLenum, CheckFramebufferStatus, (GLenum))                                               \
    X(void, ClearBufferfv, (GLenum, GLint, const GLfloat*))                                   \
    X(void, CompileShader, (GLuint))                                                          \
    X(GLuint, CreateProgram, ())                                                              \
    X(GLuint, CreateShader, (GLenum))                                                         \
    X(void, DeleteShader, (GLuint))                                                           \
    X(void, DepthFunc, (GLenum))                                                              \
    X(void, DrawBuffers, (GLsizei, const GLenum*))                                            \
    X(void, DrawElements, (GLenum, GLsizei, GLenum, const void*))                             \
    X(void, Enable, (GLenum))                                                                 \
    X(void, EnableVertexAttribArray, (GLuint))                                                \
    X(void, Finish, ())                                                                       \
    X(void, FramebufferRenderbuffer, (GLenum, GLenum, GLenum, GLuint))                        \
    X(void, GenBuffers, (GLsizei, GLuint*))                                                   \
    X(void, GenFramebuffers, (GLsizei, GLuint*))                                              \
    X(void, GenRenderbuffers, (GLsizei, GLuint*))                                             \
    X(void, GenVertexArrays, (GLsizei, GLuint*))                                              \
    X(GLenum, GetError, ())                                                                   \
    X(void, GetIntegerv, (GLenum, GLint*))                                                    \
    X(void, GetProgramInfoLog, (GLuint, GLsizei, GLsizei*, GLchar*))                          \
    X(void, GetProgramiv, (GLuint, GLenum, GLint*))                                           \
    X(void, GetShaderInfoLog, (GLuint, GLsizei, GLsizei*, GLchar*))                           \
    X(void, GetShaderiv, (GLuint, GLenum, GLint*))                                            \
    X(const GLubyte*, GetString, (GLenum))                                                    \
    X(GLint, GetUniformLocation, (GLuint, const GLchar*))                                     \
    X(void, LinkProgram, (GLuint))                                                            \
    X(void, MultiDrawElements, (GLenum, const GLsizei*, GLenum, const void* const*, GLsizei)) \
    X(void, PixelStorei, (GLenum, GLint))                                                     \
    X(void, ReadBuffer, (GLenum))                                                             \
    X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*))              \
    X(void, RenderbufferStorage, (GLenum, GLenum, GLsizei, GLsizei))                          \
    X(void, Scissor, (GLint, GLint, GLsizei, GLsizei))                                        \
    X(void, ShaderSource, (GLuint, GLsizei, const GLchar* const*, const GLint*))              \
    X(void, Uniform1f, (GLint, GLfloat))                                                      \
    X(void, Uniform1ui, (GLint, GLuint))                                                      \
    X(void, Uniform3f, (GLint, GLfloat, GLfloat, GLfloat))                                    \
    X(void, UniformMatrix4fv, (GLint, GLsizei, GLboolean, const GLfloat*))                    \
    X(void, UseProgram, (GLuint))                                                             \
    X(void, VertexAttribPointer, (GLuint, GLint, GLenum, GLboolean, GLsizei, const void*))    \
    X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))

struct GlFunctions {
#define SWATH_GL_MEMBER(result, name, parameters) result(*name) parameters = nullptr;
    SWATH_GL_FUNCTIONS(SWATH_GL_MEMBER)
#undef SWATH_GL_MEMBER
};

Result<GlFunctions> load_gl_functions(const GlContext& context);

}  // namespace swath
