#pragma once
#include <GL/glcorearb.h>

#include "common/base/result.h"
#include "common/render/gl_context.h"

namespace swath {

// The GL functions that the renderer calls, loaded from one context.
// X(member, TYPE): member is `gl` + the name in the specification.
#define SWATH_GL_FUNCTIONS(X)                           \
    X(AttachShader, ATTACHSHADER)                       \
    X(BindBuffer, BINDBUFFER)                           \
    X(BindFramebuffer, BINDFRAMEBUFFER)                 \
    X(BindRenderbuffer, BINDRENDERBUFFER)               \
    X(BindVertexArray, BINDVERTEXARRAY)                 \
    X(BufferData, BUFFERDATA)                           \
    X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)   \
    X(ClearBufferfv, CLEARBUFFERFV)                     \
    X(ClearBufferuiv, CLEARBUFFERUIV)                   \
    X(CompileShader, COMPILESHADER)                     \
    X(CreateProgram, CREATEPROGRAM)                     \
    X(CreateShader, CREATESHADER)                       \
    X(DeleteShader, DELETESHADER)                       \
    X(DepthFunc, DEPTHFUNC)                             \
    X(DrawBuffers, DRAWBUFFERS)                         \
    X(DrawElements, DRAWELEMENTS)                       \
    X(Enable, ENABLE)                                   \
    X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY) \
    X(Finish, FINISH)                                   \
    X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER) \
    X(GenBuffers, GENBUFFERS)                           \
    X(GenFramebuffers, GENFRAMEBUFFERS)                 \
    X(GenRenderbuffers, GENRENDERBUFFERS)               \
    X(GenVertexArrays, GENVERTEXARRAYS)                 \
    X(GetError, GETERROR)                               \
    X(GetIntegerv, GETINTEGERV)                         \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)             \
    X(GetProgramiv, GETPROGRAMIV)                       \
    X(GetShaderInfoLog, GETSHADERINFOLOG)               \
    X(GetShaderiv, GETSHADERIV)                         \
    X(GetString, GETSTRING)                             \
    X(GetUniformLocation, GETUNIFORMLOCATION)           \
    X(LinkProgram, LINKPROGRAM)                         \
    X(MultiDrawElements, MULTIDRAWELEMENTS)             \
    X(PixelStorei, PIXELSTOREI)                         \
    X(ReadBuffer, READBUFFER)                           \
    X(ReadPixels, READPIXELS)                           \
    X(RenderbufferStorage, RENDERBUFFERSTORAGE)         \
    X(Scissor, SCISSOR)                                 \
    X(ShaderSource, SHADERSOURCE)                       \
    X(Uniform1f, UNIFORM1F)                             \
    X(Uniform1ui, UNIFORM1UI)                           \
    X(Uniform3f, UNIFORM3F)                             \
    X(UniformMatrix4fv, UNIFORMMATRIX4FV)               \
    X(UseProgram, USEPROGRAM)                           \
    X(VertexAttribPointer, VERTEXATTRIBPOINTER)         \
    X(Viewport, VIEWPORT)

struct GlFunctions {
#define SWATH_GL_MEMBER(name, type) PFNGL##type##PROC name = nullptr;
    SWATH_GL_FUNCTIONS(SWATH_GL_MEMBER)
#undef SWATH_GL_MEMBER
};

Result<GlFunctions> load_gl_functions(const GlContext& context);

}  // namespace swath
