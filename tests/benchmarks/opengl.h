// EGL and OpenGL, loaded when a comparison is asked for: a program that links them waits for them at every start.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include "relief/error.h"

namespace relief::benchmarks {

// The functions in use, without egl and gl.
// clang-format off
#define RELIEF_EGL_FUNCTIONS(X) \
    X(BindAPI) X(CreateContext) X(DestroyContext) X(GetPlatformDisplay) X(Initialize) X(MakeCurrent) X(Terminate)
#define RELIEF_GL_FUNCTIONS(X) \
    X(AttachShader) X(BindFramebuffer) X(BindTextureUnit) X(BindVertexArray) X(BlendFunc) X(BlitNamedFramebuffer) \
    X(CheckNamedFramebufferStatus) X(Clear) X(ClearColor) X(ClearDepthf) X(ClipControl) X(CompileShader) \
    X(CreateBuffers) X(CreateFramebuffers) X(CreateProgram) X(CreateRenderbuffers) X(CreateShader) X(CreateTextures) \
    X(CreateVertexArrays) X(CullFace) X(DepthFunc) X(DepthMask) X(Disable) X(DrawElements) X(Enable) \
    X(EnableVertexArrayAttrib) X(Finish) X(FrontFace) X(GetError) X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv) \
    X(GetString) X(GetUniformLocation) X(LinkProgram) X(NamedBufferStorage) X(NamedFramebufferDrawBuffers) \
    X(NamedFramebufferRenderbuffer) X(NamedFramebufferTexture) X(NamedRenderbufferStorageMultisample) \
    X(NamedRenderbufferStorage) X(PixelStorei) X(ProgramUniform1f) X(ProgramUniform3fv) X(ProgramUniform4fv) \
    X(ProgramUniformMatrix3fv) X(ProgramUniformMatrix4fv) X(ReadPixels) X(ShaderSource) X(TextureParameterfv) \
    X(TextureParameteri) X(TextureStorage2D) X(TextureSubImage2D) X(TextureSubImage3D) X(UseProgram) X(VertexArrayAttribBinding) \
    X(VertexArrayAttribFormat) X(VertexArrayElementBuffer) X(VertexArrayVertexBuffer) X(Viewport)
// clang-format on

// egl.Initialize is eglInitialize, and so on.
#define RELIEF_DECLARE_EGL(name) decltype(&::egl##name) name;
#define RELIEF_DECLARE_GL(name) decltype(&::gl##name) name;
struct EglFunctions
{
    RELIEF_EGL_FUNCTIONS(RELIEF_DECLARE_EGL)
};
struct GlFunctions
{
    RELIEF_GL_FUNCTIONS(RELIEF_DECLARE_GL)
};
#undef RELIEF_DECLARE_EGL
#undef RELIEF_DECLARE_GL

extern EglFunctions egl;
extern GlFunctions gl;

// To be called before any of the functions; a second time it does nothing. An error where a library or a function is
// missing.
Expected<void> loadOpenGl();

}  // namespace relief::benchmarks
