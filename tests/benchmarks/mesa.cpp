#include "mesa.h"

#include <cstdio>

#include "opengl.h"

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
vec4 texCUBE(samplerCube s, vec3 direction) { return texture(s, direction); }
)glsl";

// Without anisotropy (see texture/level_of_detail.h); of a cube map on the face of each direction (cube_sampler.cpp).
const char* const kExactLevel = R"glsl(
vec4 tex2D(sampler2D s, vec2 uv)
{
    vec2 size = vec2(textureSize(s, 0));
    vec2 dX = dFdxFine(uv) * size, dY = dFdyFine(uv) * size;
    return textureLod(s, uv, 0.5 * log2(max(dot(dX, dX), dot(dY, dY))));
}
vec3 onFace(vec3 direction, vec3 v)
{
    vec3 a = abs(direction);
    return a.z >= a.x && a.z >= a.y ? v : a.y >= a.x ? v.xzy : v.zyx;
}
vec4 texCUBE(samplerCube s, vec3 direction)
{
    vec3 along = onFace(direction, direction);
    vec3 alongX = onFace(direction, dFdxFine(direction)), alongY = onFace(direction, dFdyFine(direction));
    vec2 place = along.xy / along.z;
    float perUnit = 0.5 * float(textureSize(s, 0).x) / along.z;
    vec2 dX = (alongX.xy - place * alongX.z) * perUnit, dY = (alongY.xy - place * alongY.z) * perUnit;
    return textureLod(s, direction, 0.5 * log2(max(dot(dX, dX), dot(dY, dY))));
}
)glsl";

std::string text(GLenum name)
{
    const GLubyte* const found = gl.GetString(name);
    return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

Expected<unsigned> compile(GLenum kind, const std::string& source)
{
    const GLuint shader = gl.CreateShader(kind);
    const char* const begin = source.c_str();
    gl.ShaderSource(shader, 1, &begin, nullptr);
    gl.CompileShader(shader);
    GLint compiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled != 0) return shader;
    char log[512] = "";
    gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
    std::string line = log;
    for (char& c : line) c = c == '\n' ? ' ' : c;
    return fail("bench --peer: Mesa refuses a program: " + line);
}

template <class Element>
GLuint makeBuffer(const std::vector<Element>& elements)
{
    GLuint buffer = 0;
    gl.CreateBuffers(1, &buffer);
    gl.NamedBufferStorage(buffer, static_cast<GLsizeiptr>(elements.size() * sizeof(Element)), elements.data(), 0);
    return buffer;
}

// One of a mesh's arrays, `components` floats a vertex.
template <class Element>
void addAttribute(GLuint vertexArray, GLuint location, GLint components, const std::vector<Element>& elements)
{
    if (elements.empty()) return;
    gl.VertexArrayVertexBuffer(vertexArray, location, makeBuffer(elements), 0, sizeof(Element));
    gl.VertexArrayAttribFormat(vertexArray, location, components, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(vertexArray, location, location);
    gl.EnableVertexArrayAttrib(vertexArray, location);
}

void clearBound(const glm::vec4& color)
{
    gl.DepthMask(GL_TRUE);
    gl.ClearColor(color.r, color.g, color.b, color.a);
    gl.ClearDepthf(1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Expected<unsigned> checkedTarget(GLuint framebuffer, int width, int height)
{
    if (gl.CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return framebuffer;
    return fail("bench --peer: Mesa refuses a target of " + std::to_string(width) + "x" + std::to_string(height) +
                "; choose a smaller --size");
}

// A framebuffer that is no texture. Without multisampling the number of samples is 0.
Expected<unsigned> makePicture(int width, int height, int samples)
{
    GLuint framebuffer = 0, buffers[2] = {0, 0};
    gl.CreateFramebuffers(1, &framebuffer);
    gl.CreateRenderbuffers(2, buffers);
    gl.NamedRenderbufferStorageMultisample(buffers[0], samples, GL_RGBA8, width, height);
    gl.NamedRenderbufferStorageMultisample(buffers[1], samples, GL_DEPTH_COMPONENT32F, width, height);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    return checkedTarget(framebuffer, width, height);
}

}  // namespace

// --- the context and its target ---

struct Mesa::Context
{
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    int width = 0, height = 0;
    GLuint picture = 0, multisampled = 0;  // framebuffers; the second is 0 where a pixel has one sample
    LevelOfDetail levelOfDetail = LevelOfDetail::mesas;

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context()
    {
        if (display == EGL_NO_DISPLAY) return;
        egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) egl.DestroyContext(display, context);
        egl.Terminate(display);
    }

    bool open()
    {
        display = egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display == EGL_NO_DISPLAY) return false;
        if (!egl.Initialize(display, nullptr, nullptr) || !egl.BindAPI(EGL_OPENGL_API)) return false;
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context = egl.CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        return context != EGL_NO_CONTEXT && egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
    }
};

Expected<Mesa> Mesa::create(int width, int height, LevelOfDetail levelOfDetail)
{
    const Expected<void> loaded = loadOpenGl();
    if (!loaded) return tl::unexpected(loaded.error());
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

    const Expected<unsigned> picture = makePicture(width, height, 0);
    if (!picture) return tl::unexpected(picture.error());
    context->picture = *picture;
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.FrontFace(GL_CCW);  // in OpenGL's eyes, which see the picture upside down: clockwise
    gl.Enable(GL_DEPTH_TEST);
    gl.Disable(GL_DITHER);
    gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    return Mesa(context);
}

std::string Mesa::description() const
{
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

// --- what scenes are made of ---

void MesaProgram::set(const char* uniform, float value) const
{
    gl.ProgramUniform1f(name, gl.GetUniformLocation(name, uniform), value);
}
void MesaProgram::set(const char* uniform, const glm::vec3& value) const
{
    gl.ProgramUniform3fv(name, gl.GetUniformLocation(name, uniform), 1, &value[0]);
}
void MesaProgram::set(const char* uniform, const glm::vec4& value) const
{
    gl.ProgramUniform4fv(name, gl.GetUniformLocation(name, uniform), 1, &value[0]);
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
    gl.ProgramUniformMatrix3fv(name, gl.GetUniformLocation(name, uniform), 1, GL_FALSE, &value[0][0]);
}
void MesaProgram::set(const char* uniform, const glm::mat4& value) const
{
    gl.ProgramUniformMatrix4fv(name, gl.GetUniformLocation(name, uniform), 1, GL_FALSE, &value[0][0]);
}

Expected<MesaProgram> Mesa::makeProgram(const std::string& vertexProgram, const std::string& fragmentProgram)
{
    const Expected<unsigned> vertex = compile(GL_VERTEX_SHADER, kVertexHead + vertexProgram);
    if (!vertex) return tl::unexpected(vertex.error());
    const std::string tex2D = context->levelOfDetail == LevelOfDetail::exact ? kExactLevel : kMesasLevel;
    const Expected<unsigned> fragment = compile(GL_FRAGMENT_SHADER, kFragmentHead + tex2D + fragmentProgram);
    if (!fragment) return tl::unexpected(fragment.error());
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program, *vertex);
    gl.AttachShader(program, *fragment);
    gl.LinkProgram(program);
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) return fail("bench --peer: Mesa does not link a vertex program with its fragment program");
    return MesaProgram{program};
}

MesaMesh Mesa::makeMesh(const Mesh& mesh)
{
    GLuint vertexArray = 0;
    gl.CreateVertexArrays(1, &vertexArray);
    addAttribute(vertexArray, 0, 3, mesh.positions);
    addAttribute(vertexArray, 1, 3, mesh.normals);
    addAttribute(vertexArray, 2, 2, mesh.uvs);
    addAttribute(vertexArray, 3, 4, mesh.tangents);
    gl.VertexArrayElementBuffer(vertexArray, makeBuffer(mesh.indices));
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
    gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    gl.TextureStorage2D(name, levels, format.inMemory, texture.width(), texture.height());
    for (int k = 0; k < levels; ++k) {
        const MipLevel& level = texture.level(k);
        const std::size_t first = (static_cast<std::size_t>(level.rowTexels()) + 1) *
                                  static_cast<std::size_t>(bytesPerTexel(texture.format()));  // after the frame
        gl.PixelStorei(GL_UNPACK_ROW_LENGTH, level.rowTexels());
        gl.TextureSubImage2D(name, k, 0, 0, level.width(), level.height(), GL_RGBA, format.channel,
                             level.texels() + first);
    }
    const bool nearest = sampler.filter == Filter::nearest;
    gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, smaller[static_cast<int>(sampler.filter)]);
    gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    gl.TextureParameteri(name, GL_TEXTURE_WRAP_S, addresses[static_cast<int>(sampler.u)]);
    gl.TextureParameteri(name, GL_TEXTURE_WRAP_T, addresses[static_cast<int>(sampler.v)]);
    gl.TextureParameterfv(name, GL_TEXTURE_BORDER_COLOR, &sampler.borderColor[0]);
    return {name};
}

MesaTexture Mesa::makeCubeMap(const CubeMap& cubeMap)
{
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_CUBE_MAP, 1, &name);
    gl.TextureStorage2D(name, cubeMap.levelCount(), GL_RGBA8, cubeMap.side(), cubeMap.side());
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    for (int k = 0; k < cubeMap.levelCount(); ++k) {
        const int side = cubeMap.level(k).width();
        for (int face = 0; face < kCubeFaces; ++face) {
            std::vector<glm::u8vec4> texels;  // of a cube map's faces OpenGL has the upper row first
            for (int y = side - 1; y >= 0; --y) {
                for (int x = 0; x < side; ++x) {
                    texels.emplace_back(cubeMap.texel(k, face, x, y) * 255.0f + 0.5f);
                }
            }
            gl.TextureSubImage3D(name, k, 0, 0, face, side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
        }
    }
    gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return {name};
}

Expected<MesaTarget> Mesa::makeTarget(int width, int height, int colors)
{
    GLuint framebuffer = 0;
    gl.CreateFramebuffers(1, &framebuffer);
    const auto attach = [&](GLenum attachment, GLenum format) {
        GLuint name = 0;
        gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
        gl.TextureStorage2D(name, 1, format, width, height);
        gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.TextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.NamedFramebufferTexture(framebuffer, attachment, name, 0);
        return MesaTexture{name};
    };
    MesaTarget target = {framebuffer, width, height, {}, attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F)};
    std::vector<GLenum> written;
    for (int i = 0; i < colors; ++i) {
        written.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        target.colors.push_back(attach(written.back(), GL_RGBA8));
    }
    gl.NamedFramebufferDrawBuffers(framebuffer, colors, written.data());
    const Expected<unsigned> checked = checkedTarget(framebuffer, width, height);
    if (!checked) return tl::unexpected(checked.error());
    return target;
}

void Mesa::compareDepths(const MesaTexture& depth)
{
    const float lit[] = {1.0f, 1.0f, 1.0f, 1.0f};
    gl.TextureParameteri(depth.name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TextureParameteri(depth.name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    gl.TextureParameteri(depth.name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(depth.name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(depth.name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.TextureParameteri(depth.name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.TextureParameterfv(depth.name, GL_TEXTURE_BORDER_COLOR, lit);
}

Expected<void> Mesa::setSamples(int samples)
{
    context->multisampled = 0;
    if (samples == 1) return {};
    return makePicture(context->width, context->height, samples).map([&](unsigned made) {
        context->multisampled = made;
    });
}

// --- drawing ---

void Mesa::drawInto(const MesaTarget& target)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    gl.Viewport(0, 0, target.width, target.height);
    clearBound(glm::vec4(0.0f));
}

void Mesa::clear(const glm::vec4& color)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, context->multisampled != 0 ? context->multisampled : context->picture);
    gl.Viewport(0, 0, context->width, context->height);
    clearBound(color);
}

void Mesa::draw(const MesaProgram& program, const MesaMesh& mesh, const RenderState& state,
                const std::vector<MesaTexture>& textures)
{
    gl.DepthFunc(GL_NEVER + static_cast<GLenum>(state.depthTest));  // both count in Direct3D's order
    gl.DepthMask(state.depthWrite ? GL_TRUE : GL_FALSE);
    (state.cull == Cull::none ? gl.Disable : gl.Enable)(GL_CULL_FACE);
    gl.CullFace(state.cull == Cull::front ? GL_FRONT : GL_BACK);
    (state.blend == Blend::off ? gl.Disable : gl.Enable)(GL_BLEND);
    if (state.blend == Blend::additive) gl.BlendFunc(GL_ONE, GL_ONE);
    if (state.blend == Blend::alpha) gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (std::size_t i = 0; i < textures.size(); ++i) {
        gl.BindTextureUnit(static_cast<GLuint>(i), textures[i].name);
    }
    gl.UseProgram(program.name);
    gl.BindVertexArray(mesh.vertexArray);
    gl.DrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
}

void Mesa::finish()
{
    if (context->multisampled != 0) {
        gl.BlitNamedFramebuffer(context->multisampled, context->picture, 0, 0, context->width, context->height, 0, 0,
                                context->width, context->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl.Finish();
}

Expected<std::vector<std::uint32_t>> Mesa::pixels()
{
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(context->width) *
                                      static_cast<std::size_t>(context->height));
    gl.BindFramebuffer(GL_FRAMEBUFFER, context->picture);
    gl.ReadPixels(0, 0, context->width, context->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return pixels;
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", error);
    return fail("bench --peer: OpenGL reports error " + std::string(code));
}

}  // namespace relief::benchmarks
