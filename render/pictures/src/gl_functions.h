#pragma once

#include <GL/glcorearb.h>

#include "offscreen_context.h"

namespace bumper::drawing {

/// The OpenGL functions that pictures are drawn with, as the context provides them: a direct call
/// would go to whichever GL library happens to be linked.
// clang-format off
#define BUMPER_GL_FUNCTIONS(X)                                                                    \
  X(ACTIVETEXTURE, ActiveTexture) X(ATTACHSHADER, AttachShader) X(BINDBUFFER, BindBuffer)         \
  X(BINDFRAMEBUFFER, BindFramebuffer) X(BINDRENDERBUFFER, BindRenderbuffer)                       \
  X(BINDTEXTURE, BindTexture) X(BINDVERTEXARRAY, BindVertexArray) X(BLENDFUNC, BlendFunc)         \
  X(BLITFRAMEBUFFER, BlitFramebuffer) X(BUFFERDATA, BufferData)                                   \
  X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) X(CLEAR, Clear) X(CLEARCOLOR, ClearColor)     \
  X(COLORMASK, ColorMask) X(COMPILESHADER, CompileShader) X(CREATEPROGRAM, CreateProgram)         \
  X(CREATESHADER, CreateShader) X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                         \
  X(DELETERENDERBUFFERS, DeleteRenderbuffers) X(DEPTHFUNC, DepthFunc) X(DEPTHMASK, DepthMask)     \
  X(DISABLE, Disable) X(DRAWARRAYS, DrawArrays) X(DRAWBUFFER, DrawBuffer) X(ENABLE, Enable)       \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                             \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                             \
  X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) X(GENBUFFERS, GenBuffers)                         \
  X(GENFRAMEBUFFERS, GenFramebuffers) X(GENRENDERBUFFERS, GenRenderbuffers)                       \
  X(GENTEXTURES, GenTextures) X(GENVERTEXARRAYS, GenVertexArrays) X(GETERROR, GetError)           \
  X(GETINTEGERV, GetIntegerv) X(GETPROGRAMINFOLOG, GetProgramInfoLog)                             \
  X(GETPROGRAMIV, GetProgramiv) X(GETSHADERINFOLOG, GetShaderInfoLog)                             \
  X(GETSHADERIV, GetShaderiv) X(GETUNIFORMLOCATION, GetUniformLocation)                           \
  X(LINKPROGRAM, LinkProgram) X(MULTIDRAWARRAYS, MultiDrawArrays) X(PIXELSTOREI, PixelStorei)     \
  X(POLYGONOFFSET, PolygonOffset) X(READBUFFER, ReadBuffer) X(READPIXELS, ReadPixels)             \
  X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                     \
  X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample)                               \
  X(SHADERSOURCE, ShaderSource) X(TEXIMAGE2D, TexImage2D) X(TEXPARAMETERFV, TexParameterfv)       \
  X(TEXPARAMETERI, TexParameteri) X(UNIFORM1F, Uniform1f) X(UNIFORM1I, Uniform1i)                 \
  X(UNIFORM2F, Uniform2f) X(UNIFORM3F, Uniform3f) X(UNIFORM4F, Uniform4f)                         \
  X(UNIFORMMATRIX4FV, UniformMatrix4fv) X(USEPROGRAM, UseProgram)                                 \
  X(VERTEXATTRIBPOINTER, VertexAttribPointer) X(VIEWPORT, Viewport)
// clang-format on

struct GlFunctions {
  /// Throws Error if the context lacks one.
  explicit GlFunctions(const OffscreenContext& context)
#define BUMPER_GL_LOAD(type, name) \
  name = reinterpret_cast<PFNGL##type##PROC>(context.function("gl" #name));
      {BUMPER_GL_FUNCTIONS(BUMPER_GL_LOAD)}
#undef BUMPER_GL_LOAD

#define BUMPER_GL_MEMBER(type, name) PFNGL##type##PROC name = nullptr;
  BUMPER_GL_FUNCTIONS(BUMPER_GL_MEMBER)
#undef BUMPER_GL_MEMBER
};

#undef BUMPER_GL_FUNCTIONS

}  // namespace bumper::drawing
