#include "mesa.h"

#include <cstdio>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

namespace relief::benchmarks {

namespace {

const char* const kVertexHead = R"glsl(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 tangent;
vec4 flipped(vec4 clip) { return vec4(clip.x, -clip.y, clip.zw); }
)glsl";

const char* const kFragmentHead = R"glsl(#version 450 core
layout(location = 0) out vec4 result;
)glsl";

const char* const kMesasLevel = R"glsl(
vec4 tex2D(sampler2D s, vec2 uv) { return texture(s, uv); }
)glsl";

// Without anisotropy (see texture/level_of_detail.h).
const char* const kExactLevel = R"glsl(
vec4 tex2D(sampler2D s, vec2 uv)
{
    vec2 size = vec2(textureSize(s, 0));
    vec2 dX = dFdxFine(uv) * size, dY = dFdyFine(uv) * size;
    return textureLod(s, uv, 0.5 * log2(max(dot(dX, dX), dot(dY, dY))));
}
)glsl";

std::string text(GLenum name)
{
    const GLubyte* const found = glGetString(name);
    return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

Expected<unsigned> compile(GLenum kind, const std::string& source)
{
    const GLuint shader = glCreateShader(kind);
    const char* const begin = source.c_str();
    glShaderSource(shader, 1, &begin, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled != 0) return shader;
    char log[512] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    std::string line = log;
    for (char& c : line) c = c == '\n' ? ' ' : c;
    return fail("bench --peer: Mesa refuses a program: " + line);
}

template <class Element>
GLuint makeBuffer(const std::vector<Element>& elements)
{
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(elements.size() * sizeof(Element)), elements.data(), 0);
    return buffer;
}

// One of a mesh's arrays, `components` floats a vertex.
template <class Element>
void addAttribute(GLuint vertexArray, GLuint location, GLint components, const std::vector<Element>& elements)
{
    if (elements.empty()) return;
    glVertexArrayVertexBuffer(vertexArray, location, makeBuffer(elements), 0, sizeof(Element));
    glVertexArrayAttribFormat(vertexArray, location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(vertexArray, location, location);
    glEnableVertexArrayAttrib(vertexArray, location);
}

}  // namespace

// --- the context and its target ---

struct Mesa::Context
{
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    int width = 0, height = 0;
    LevelOfDetail levelOfDetail = LevelOfDetail::mesas;

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context()
    {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }

    bool open()
    {
        display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display == EGL_NO_DISPLAY) return false;
        if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API)) return false;
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        return context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
    }
};

Expected<Mesa> Mesa::create(int width, int height, LevelOfDetail levelOfDetail)
{
    const auto context = std::make_shared<Context>();
    if (!context->open()) {
        return fail("bench --peer: Mesa's llvmpipe gives no OpenGL 4.5 context; install libgl1-mesa-dri");
    }
    if (text(GL_RENDERER).find("llvmpipe") == std::string::npos) {
        return fail("bench --peer: OpenGL is drawn by " + text(GL_RENDERER) + " and not by llvmpipe; install " +
                    "libgl1-mesa-dri");
    }
    context->width = width;
    context->height = height;
    context->levelOfDetail = levelOfDetail;

    GLuint target = 0, buffers[2] = {0, 0};
    glCreateFramebuffers(1, &target);
    glCreateRenderbuffers(2, buffers);
    glNamedRenderbufferStorage(buffers[0], GL_RGBA8, width, height);
    glNamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT32F, width, height);
    glNamedFramebufferRenderbuffer(target, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    glNamedFramebufferRenderbuffer(target, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    if (glCheckNamedFramebufferStatus(target, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail("bench --peer: Mesa refuses a target of " + std::to_string(width) + "x" + std::to_string(height) +
                    "; choose a smaller --size");
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, width, height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glFrontFace(GL_CCW);  // in OpenGL's eyes, which see the picture upside down: clockwise
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_DITHER);
    return Mesa(context);
}

std::string Mesa::description() const
{
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

// --- what scenes are made of ---

void MesaProgram::set(const char* uniform, float value) const
{
    glProgramUniform1f(name, glGetUniformLocation(name, uniform), value);
}
void MesaProgram::set(const char* uniform, const glm::vec3& value) const
{
    glProgramUniform3fv(name, glGetUniformLocation(name, uniform), 1, &value[0]);
}
void MesaProgram::set(const char* uniform, const glm::vec4& value) const
{
    glProgramUniform4fv(name, glGetUniformLocation(name, uniform), 1, &value[0]);
}
void MesaProgram::set(const char* uniform, const float3& value) const
{
    set(uniform, glm::vec3(value.x[0], value.y[0], value.z[0]));
}
void MesaProgram::set(const char* uniform, const float4& value) const
{
    set(uniform, glm::vec4(value.x[0], value.y[0], value.z[0], value.w[0]));
}
void MesaProgram::set(const char* uniform, const glm::mat3& value) const
{
    glProgramUniformMatrix3fv(name, glGetUniformLocation(name, uniform), 1, GL_FALSE, &value[0][0]);
}
void MesaProgram::set(const char* uniform, const glm::mat4& value) const
{
    glProgramUniformMatrix4fv(name, glGetUniformLocation(name, uniform), 1, GL_FALSE, &value[0][0]);
}

Expected<MesaProgram> Mesa::makeProgram(const std::string& vertexProgram, const std::string& fragmentProgram)
{
    const Expected<unsigned> vertex = compile(GL_VERTEX_SHADER, kVertexHead + vertexProgram);
    if (!vertex) return tl::unexpected(vertex.error());
    const std::string tex2D = context->levelOfDetail == LevelOfDetail::exact ? kExactLevel : kMesasLevel;
    const Expected<unsigned> fragment = compile(GL_FRAGMENT_SHADER, kFragmentHead + tex2D + fragmentProgram);
    if (!fragment) return tl::unexpected(fragment.error());
    const GLuint program = glCreateProgram();
    glAttachShader(program, *vertex);
    glAttachShader(program, *fragment);
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) return fail("bench --peer: Mesa does not link a vertex program with its fragment program");
    return MesaProgram{program};
}

MesaMesh Mesa::makeMesh(const Mesh& mesh)
{
    GLuint vertexArray = 0;
    glCreateVertexArrays(1, &vertexArray);
    addAttribute(vertexArray, 0, 3, mesh.positions);
    addAttribute(vertexArray, 1, 3, mesh.normals);
    addAttribute(vertexArray, 2, 2, mesh.uvs);
    addAttribute(vertexArray, 3, 4, mesh.tangents);
    glVertexArrayElementBuffer(vertexArray, makeBuffer(mesh.indices));
    return {vertexArray, static_cast<int>(mesh.indices.size())};
}

MesaTexture Mesa::makeTexture(const sampler2D& sampler)
{
    struct Format
    {
        GLenum inMemory, channel;
    };
    const Format formats[] = {{GL_RGBA8, GL_UNSIGNED_BYTE}, {GL_RGBA16, GL_UNSIGNED_SHORT}, {GL_RGBA32F, GL_FLOAT}};
    const GLint smaller[] = {GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_LINEAR};
    const GLint addresses[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER};
    const Texture& texture = sampler.texture ? *sampler.texture : Texture::white();
    const Format format = formats[static_cast<int>(texture.format())];
    const int levels = sampler.mipmaps ? texture.levelCount() : 1;

    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, levels, format.inMemory, texture.width(), texture.height());
    for (int k = 0; k < levels; ++k) {
        const MipLevel& level = texture.level(k);
        const std::size_t first = (static_cast<std::size_t>(level.rowTexels()) + 1) *
                                  static_cast<std::size_t>(bytesPerTexel(texture.format()));  // after the frame
        glPixelStorei(GL_UNPACK_ROW_LENGTH, level.rowTexels());
        glTextureSubImage2D(name, k, 0, 0, level.width(), level.height(), GL_RGBA, format.channel,
                            level.texels() + first);
    }
    const bool nearest = sampler.filter == Filter::nearest;
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, smaller[static_cast<int>(sampler.filter)]);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, addresses[static_cast<int>(sampler.u)]);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, addresses[static_cast<int>(sampler.v)]);
    glTextureParameterfv(name, GL_TEXTURE_BORDER_COLOR, &sampler.borderColor[0]);
    return {name};
}

// --- drawing ---

void Mesa::clear(const glm::vec4& color)
{
    glDepthMask(GL_TRUE);
    glClearColor(color.r, color.g, color.b, color.a);
    glClearDepthf(1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Mesa::draw(const MesaProgram& program, const MesaMesh& mesh, const RenderState& state,
                const std::vector<MesaTexture>& textures)
{
    glDepthFunc(GL_NEVER + static_cast<GLenum>(state.depthTest));  // both count in Direct3D's order
    glDepthMask(state.depthWrite ? GL_TRUE : GL_FALSE);
    (state.cull == Cull::none ? glDisable : glEnable)(GL_CULL_FACE);
    glCullFace(state.cull == Cull::front ? GL_FRONT : GL_BACK);
    (state.blend == Blend::off ? glDisable : glEnable)(GL_BLEND);
    if (state.blend == Blend::additive) glBlendFunc(GL_ONE, GL_ONE);
    if (state.blend == Blend::alpha) glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (std::size_t i = 0; i < textures.size(); ++i) {
        glBindTextureUnit(static_cast<GLuint>(i), textures[i].name);
    }
    glUseProgram(program.name);
    glBindVertexArray(mesh.vertexArray);
    glDrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
}

void Mesa::finish()
{
    glFinish();
}

Expected<std::vector<std::uint32_t>> Mesa::pixels()
{
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(context->width) *
                                      static_cast<std::size_t>(context->height));
    glReadPixels(0, 0, context->width, context->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return pixels;
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", error);
    return fail("bench --peer: OpenGL reports error " + std::string(code));
}

}  // namespace relief::benchmarks
