#include "random_scene.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "numbers.h"
#include "relief/pipeline/frame.h"
#include "relief/shading/cotangent_frame.h"
#include "relief/shading/lights.h"
#include "relief/shading/normals.h"
#include "relief/shading/object_transform.h"
#include "relief/shading/tangent_space.h"
#include "relief/shading/triplanar.h"

namespace random_scene {

using namespace relief;

std::uint64_t Source::next()
{
    if (!bytes.empty()) {
        const std::size_t count = std::min<std::size_t>(bytes.size(), 4);
        std::uint64_t given = 0;
        std::memcpy(&given, bytes.data(), count);
        bytes = bytes.subspan(count);
        return given * 0x9e3779b97f4a7c15u ^ given;
    }
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

int Source::between(int low, int high)
{
    const auto span = static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
    return static_cast<int>(low + static_cast<std::int64_t>(next() % span));
}

namespace {

// --- numbers ---

constexpr float kExtremes[] = {0.0f,   -0.0f,           1.0f,        -1.0f,     1e-45f,         -1e-45f,
                               1e-40f, 1.17549435e-38f, 1e-30f,      -1e-30f,   1e-20f,         1e-7f,
                               1e3f,   -1e6f,           16777217.0f, 1e10f,     1e19f,          -1e20f,
                               1e30f,  -1e30f,          3.4e34f,     -3.4e34f,  3.40282347e38f, -3.40282347e38f,
                               kNan,   -kNan,           kInfinity,   -kInfinity};

class Numbers
{
public:
    Numbers(Source& from, int extreme) : source(from), extremeIn(extreme) {}

    // Of [-reach, reach], or something extreme.
    float operator()(float reach = 1.0f)
    {
        if (extremeIn > 0 && source.chance(extremeIn)) return extreme();
        return static_cast<float>(source.between(-1 << 20, 1 << 20)) * 0x1p-20f * reach;
    }
    float extreme()
    {
        if (source.chance(4)) return std::bit_cast<float>(static_cast<std::uint32_t>(source.next()));
        return kExtremes[source.between(0, std::size(kExtremes) - 1)];
    }

    Source& source;

private:
    int extremeIn;  // one number in so many is extreme; 0: none
};

// --- programs ---

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> worldPos;
    TEXCOORD<2, float3> normal;
    TEXCOORD<3, float4> tangent;
    noperspective<COLOR<0, float3>> light;
};

// `clip`: positions are in clip space already, w in the tangent.
struct VertexProgram
{
    ObjectTransform object;
    VertexLights lamps;
    Float clip;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        const float4 given = float4(v.position.xyz(), v.tangent.w);
        i.position = select(clip > 0.0f, given, UnityObjectToClipPos(object, v.position));
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.uv = v.uv;
        i.light = Shade4PointLights(lamps, i.worldPos, i.normal);
        return i;
    }
};

// Cut at eight planes, of which four may all but coincide with the others.
struct CutInterpolators
{
    SV_POSITION position;
    SV_ClipDistance<0, float4> near;
    SV_ClipDistance<1, float4> far;
    TEXCOORD<0, float2> uv;
    noperspective<COLOR<0, float3>> light;
};
struct CutVertexProgram : VertexProgram
{
    Float apart;

    CutInterpolators operator()(VertexData v) const
    {
        const Interpolators whole = VertexProgram::operator()(v);
        CutInterpolators i;
        i.position = whole.position;
        i.near = float4(v.normal, v.uv.x);
        i.far = i.near * apart;
        i.uv = whole.uv;
        i.light = whole.light;
        return i;
    }
};

// What materials are made of.
struct Material
{
    sampler2D mainTex, normalMap;
    float3 color;
    Float bumpScale, smoothness, metallic, exponent, sign;
    PointLight lamp;
    DirectionalLight sun;
    float3 camera;
};

struct Lit : Material
{
    float4 operator()(Interpolators i) const
    {
        const float3 tangent = SafeTangent(i.normal, i.tangent.xyz());
        const float3 binormal = CreateBinormal(i.normal, tangent, i.tangent.w, sign);
        const float3 bump = BlendNormals(UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale),
                                         UnpackScaleNormalRGB(tex2D(mainTex, i.uv * bumpScale), bumpScale));
        const float3 normal = TangentSpaceToWorld(bump, tangent, binormal, i.normal);
        float3 specular;
        Float oneMinusReflectivity;
        const float3 albedo = DiffuseAndSpecularFromMetallic(tex2D(mainTex, i.uv).xyz() * color, metallic, specular,
                                                             oneMinusReflectivity);
        const float3 view = normalize(camera - i.worldPos);
        const float3 one =
            UNITY_BRDF_PBS(albedo, specular, smoothness, normal, view, CreateLight(lamp, i.worldPos)).xyz();
        const float3 two =
            UNITY_BRDF_PBS_Exact(albedo, specular, smoothness, normal, view, CreateLight(sun, i.worldPos)).xyz();
        const Float highlight = pow(saturate(dot(reflect(-view, normal), view)), exponent);
        return float4(one + two + i.light + highlight, oneMinusReflectivity);
    }
};

struct WithHoles : Material
{
    float4 operator()(Interpolators i, Discard& discard) const
    {
        const float4 texel = tex2D(mainTex, i.uv);
        discard(texel.w < frac(i.uv.x * exponent));
        const float3 normal =
            perturb_normal(UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale), i.normal, i.worldPos, i.uv);
        return float4(normal * color + ddx(i.worldPos), texel.w);
    }
};

struct FromThreeSides : Material
{
    float4 operator()(Interpolators i) const
    {
        const float3 normal = normalize(i.normal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * bumpScale);
        const float3 weights = TriplanarBlendPower(normal, exponent) + TriplanarBlendOffset(normal, smoothness) +
                               TriplanarBlendHeight(normal, float3(i.light), metallic) +
                               TriplanarBlendAsymmetric(normal);
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, weights);
        const Triplanar<float3> bumps = {UnpackScaleNormal(texel.x, bumpScale), UnpackScaleNormal(texel.y, 1.0f),
                                         UnpackScaleNormal(texel.z, 1.0f)};
        const float3 bent = normalize(BlendNormalsRNM(bumps.x, normal) + BlendNormalsDerivative(bumps.y, normal) +
                                      mul(cotangent_frame(normal, i.worldPos, i.uv), bumps.z));
        return float4(bent * weights + texel.x.xyz(), texel.y.w);
    }
};

struct Plain : Material
{
    float4 operator()(const Interpolators& i) const { return float4(float3(i.light) + color, i.uv.x); }
};

struct CutPlain
{
    float3 color;

    float4 operator()(const CutInterpolators& i) const { return float4(float3(i.light) + color, i.uv.x); }
};

// --- a scene ---

struct DrawCall
{
    Mesh mesh;
    VertexProgram vertex;
    Material material;
    int kind = 0;
    float apart = 1.0f;
    Viewport viewport;
    Rectangle scissor;
    bool setsViewport = false, setsScissor = false, counterClockwise = false;
};

struct Scene
{
    int width = 1, height = 1, samples = 1;
    Format format = Format::rgba8;
    Store depth = Store::keep;
    FrameOptions options, otherOptions;
    bool clears = true;
    glm::vec4 clearColor{0.0f};
    float clearDepth = 1.0f;
    std::vector<std::unique_ptr<Texture>> textures;
    std::vector<DrawCall> draws;
};

Texture randomTexture(Numbers& number)
{
    Source& source = number.source;
    const int width = source.between(1, 9), height = source.between(1, 9);
    const auto count = static_cast<std::size_t>(width * height * 4);
    if (source.chance(2)) {
        std::vector<float> texels(count);
        for (float& t : texels) t = number();
        return *Texture::fromRgbaFloat(width, height, texels);
    }
    std::vector<std::uint8_t> texels(count);
    for (std::uint8_t& t : texels) t = static_cast<std::uint8_t>(source.next());
    return *Texture::fromRgba8(width, height, texels, source.chance(2) ? ColorSpace::srgb : ColorSpace::linear);
}

sampler2D randomSampler(Numbers& number, const Scene& scene)
{
    Source& source = number.source;
    sampler2D s;
    const int which = source.between(-1, static_cast<int>(scene.textures.size()) - 1);
    s.texture = which < 0 ? nullptr : scene.textures[static_cast<std::size_t>(which)].get();
    s.filter = static_cast<Filter>(source.between(0, 2));
    s.u = static_cast<AddressMode>(source.between(0, 3));
    s.v = static_cast<AddressMode>(source.between(0, 3));
    s.mipmaps = source.chance(2);
    s.maxAnisotropy = source.between(1, 16);
    s.lodBias = source.chance(3) ? number(20.0f) : 0.0f;
    if (source.chance(4)) s.minLod = number(5.0f);
    if (source.chance(4)) s.maxLod = number(5.0f);
    s.borderColor = {number(), number(), number(), number()};
    return s;
}

glm::mat4 randomMatrix(Numbers& number)
{
    glm::mat4 m(1.0f);
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) m[c][r] += number(0.5f);
    }
    return m;
}

float3 randomVector(Numbers& number, float reach = 1.0f)
{
    return {Float(number(reach)), Float(number(reach)), Float(number(reach))};
}

Mesh randomMesh(Numbers& number)
{
    Source& source = number.source;
    Mesh mesh;
    const int vertices = source.chance(20) ? 0 : source.between(1, 24);
    const auto length = [&] {  // streams may be missing or too short: then their draw is left out
        return static_cast<std::size_t>(source.chance(200) ? source.between(0, vertices) : vertices);
    };
    const float reach = source.chance(3) ? 30.0f : 2.0f;
    for (int i = 0; i < vertices; ++i) mesh.positions.push_back({number(reach), number(reach), number() * 0.6f + 0.5f});
    if (source.chance(6)) mesh.positions.assign(mesh.positions.size(), glm::vec3(number(), number(), number()));
    mesh.normals.resize(length());
    for (glm::vec3& n : mesh.normals) n = {number(), number(), number()};
    mesh.tangents.resize(length());
    for (glm::vec4& t : mesh.tangents) t = {number(), number(), number(), number() + 1.0f};
    mesh.uvs.resize(length());
    const float uvReach = source.chance(4) ? 1e7f : 3.0f;
    for (glm::vec2& uv : mesh.uvs) uv = {number(uvReach), number(uvReach)};
    const int corners = source.between(0, 20) * 6;
    for (int i = 0; i < corners; ++i) {
        mesh.indices.push_back(static_cast<std::uint32_t>(
            source.chance(200) ? source.between(-2, 1000) : source.between(0, std::max(0, vertices - 1))));
    }
    return mesh;
}

// Mostly around the target, sometimes anywhere.
int randomEdge(Source& source, int side)
{
    if (source.chance(30)) return static_cast<int>(static_cast<std::uint32_t>(source.next()));
    return source.chance(5) ? source.between(-70000, 70000) : source.between(-8, side + 8);
}

DrawCall randomDraw(Numbers& number, const Scene& scene)
{
    Source& source = number.source;
    DrawCall d;
    d.mesh = randomMesh(number);
    const glm::mat4 clipFromWorld = {
        {1.5f, 0, 0, 0}, {0, 1.5f, 0, 0}, {0, 0, 1.1f, 1}, {number(), number(), 0.5f, 2.0f}};
    d.vertex.object = ObjectTransform(source.chance(3) ? randomMatrix(number) : clipFromWorld, randomMatrix(number));
    d.vertex.clip = source.chance(2) ? 1.0f : 0.0f;
    d.vertex.lamps.attenSq = float4(Float(number(10.0f)));
    d.vertex.lamps.positionX = d.vertex.lamps.positionY = d.vertex.lamps.positionZ = float4(Float(number(3.0f)));
    for (float3& color : d.vertex.lamps.color) color = randomVector(number, 5.0f);
    const float3 axis = randomVector(number);
    d.material = {randomSampler(number, scene),
                  randomSampler(number, scene),
                  randomVector(number, 2.0f),
                  Float(number(4.0f)),
                  Float(number(2.0f)),
                  Float(number(2.0f)),
                  Float(source.chance(4) ? 1e30f : number(1000.0f)),
                  Float(number()),
                  {randomVector(number, 1e3f), randomVector(number, 2.0f), Float(number(5.0f))},
                  {randomVector(number, 10.0f), source.chance(2) ? normalize(axis) : axis},
                  randomVector(number, 4.0f)};
    d.kind = source.between(0, 9);
    d.apart = source.chance(4) ? number() : 1.0f + number(1e-6f);
    d.setsViewport = source.chance(3);
    d.viewport = {randomEdge(source, 0), randomEdge(source, 0), randomEdge(source, scene.width),
                  randomEdge(source, scene.height)};
    d.setsScissor = source.chance(3);
    d.scissor = {randomEdge(source, 0), randomEdge(source, 0), randomEdge(source, scene.width),
                 randomEdge(source, scene.height)};
    d.counterClockwise = source.chance(2);
    return d;
}

Scene randomScene(Source source)
{
    Scene scene;
    const int extremes[] = {0, 100, 10, 2};  // one number in so many
    Numbers number(source, extremes[source.between(0, 3)]);
    scene.width = source.between(1, 40);
    scene.height = source.between(1, 40);
    scene.samples = source.chance(2) ? 1 << source.between(1, 3) : 1;
    scene.format = static_cast<Format>(source.between(0, 4));
    scene.depth = source.chance(3) ? Store::discard : Store::keep;
    scene.options = {source.between(1, 3), 16 << source.between(0, 3)};
    scene.otherOptions = {source.between(1, 4), 16 << source.between(0, 3)};
    scene.clears = source.chance(2);
    scene.clearColor = {number(), number(), number(), number()};
    scene.clearDepth = source.chance(4) ? number() : 1.0f;
    const int textures = source.between(0, 2), draws = source.between(1, 4);
    for (int i = 0; i < textures; ++i) scene.textures.push_back(std::make_unique<Texture>(randomTexture(number)));
    for (int i = 0; i < draws; ++i) scene.draws.push_back(randomDraw(number, scene));
    return scene;
}

void record(Frame& frame, const Scene& scene)
{
    constexpr RenderState kAdditive = {
        .depthTest = Compare::lessEqual, .depthWrite = false, .cull = Cull::none, .blend = Blend::additive};
    constexpr RenderState kOver = {
        .depthTest = Compare::always, .depthClip = false, .cull = Cull::front, .blend = Blend::alpha};
    constexpr RenderState kReversed = {.depthTest = Compare::greater, .cull = Cull::none};
    constexpr RenderState kLines = {.cull = Cull::none, .primitive = Primitive::lines, .lineWidth = 2};
    constexpr RenderState kPaint = {
        .depthTest = Compare::always, .depthWrite = true, .depthClip = false, .cull = Cull::none};
    constexpr RenderState kThinned = {.cull = Cull::none, .alphaToCoverage = true};
    if (scene.clears) frame.clear(scene.clearColor, scene.clearDepth);
    for (const DrawCall& d : scene.draws) {
        if (d.setsViewport) frame.setViewport(d.viewport);
        if (d.setsScissor) frame.setScissor(d.scissor);
        frame.setFrontCounterClockwise(d.counterClockwise);
        switch (d.kind) {
            case 0:
                frame.draw(d.mesh, d.vertex, Lit{d.material});
                break;
            case 1:
                frame.draw(d.mesh, d.vertex, Lit{d.material}, kAdditive);
                break;
            case 2:
                frame.draw(d.mesh, d.vertex, WithHoles{d.material}, kOver);
                break;
            case 3:
                frame.draw(d.mesh, d.vertex, FromThreeSides{d.material}, kReversed);
                break;
            case 4:
                frame.draw(d.mesh, d.vertex, Plain{d.material}, kLines);
                break;
            case 5:
                frame.draw(d.mesh, d.vertex, Plain{d.material}, kPaint);
                break;
            case 6:
                frame.draw(d.mesh, d.vertex, WithHoles{d.material}, kAdditive);
                break;
            case 7:
                frame.draw(d.mesh, CutVertexProgram{d.vertex, Float(d.apart)}, CutPlain{d.material.color}, kPaint);
                break;
            case 8:
                frame.draw(d.mesh, d.vertex, WithHoles{d.material}, kThinned);
                break;
            default:
                frame.draw(d.mesh, d.vertex, Plain{d.material}, kOver);
                break;
        }
    }
}

// --- what must hold ---

// A pattern in every pixel, so that what changes is seen.
void fill(Framebuffer& target)
{
    std::uint32_t n = 1;
    const auto next = [&n] { return n = n * 1664525u + 1013904223u; };
    const auto number = [&next] { return static_cast<float>(next() >> 8) * 0x1p-24f; };
    for (std::uint32_t& c : target.color8()) c = next();
    for (auto& c : target.color16f()) c.fill(static_cast<std::uint16_t>(next() >> 16 & 0x3bffu));
    for (float& c : target.colorR32f()) c = number();
    for (glm::vec4& c : target.color32f()) c = glm::vec4(number());
    for (float& z : target.depth()) z = 1.0f;
}

bool allFinite(const Framebuffer& target)
{
    const auto isFinite = [](float x) { return std::isfinite(x); };
    const auto areFinite = [&](const glm::vec4& c) { return std::all_of(&c.x, &c.x + 4, isFinite); };
    const auto halvesAreFinite = [](const auto& c) {
        return std::all_of(c.begin(), c.end(), [](std::uint16_t half) { return (half & 0x7c00u) != 0x7c00u; });
    };
    return std::ranges::all_of(target.color32f(), areFinite) &&
           std::ranges::all_of(target.color16f(), halvesAreFinite) &&
           std::ranges::all_of(target.colorR32f(), isFinite) && std::ranges::all_of(target.depth(), isFinite);
}

bool samePixel(const Framebuffer& a, const Framebuffer& b, std::size_t i)
{
    const std::size_t pixels = static_cast<std::size_t>(a.width()) * static_cast<std::size_t>(a.height());
    for (int attachment = 0; attachment < static_cast<int>(a.attachments().size()); ++attachment) {
        const std::span<const std::uint32_t> its = a.words(attachment), others = b.words(attachment);
        const std::size_t words = its.size() / pixels;
        if (!std::ranges::equal(its.subspan(i * words, words), others.subspan(i * words, words))) return false;
    }
    return true;
}

// Where no scissor lets anything through, every pixel is what it was.
bool guardChanged(const Scene& scene, const Framebuffer& before, const Framebuffer& after)
{
    std::vector<bool> drawable(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
    Rectangle scissor = {0, 0, scene.width, scene.height};
    for (const DrawCall& d : scene.draws) {
        if (d.setsScissor) scissor = d.scissor;
        const Rectangle r = intersect(scissor, {0, 0, scene.width, scene.height});
        for (int y = r.y0; y < r.y1; ++y) {
            for (int x = r.x0; x < r.x1; ++x) drawable[static_cast<std::size_t>(y * scene.width + x)] = true;
        }
    }
    for (std::size_t i = 0; i < drawable.size(); ++i) {
        if (!drawable[i] && !samePixel(before, after, i)) return true;
    }
    return false;
}

bool addsUp(const Statistics& s)
{
    return s.trianglesSubmitted == s.culledFacing + s.culledNoSample + s.outside + s.droppedNan + s.droppedInfinite +
                                       s.droppedIndex + s.rasterised;
}

// What does not depend on threads, tiles and lanes.
bool sameCounts(const Statistics& a, const Statistics& b)
{
    return a.draws == b.draws && a.verticesShaded == b.verticesShaded && a.trianglesSubmitted == b.trianglesSubmitted &&
           a.culledFacing == b.culledFacing && a.culledNoSample == b.culledNoSample && a.outside == b.outside &&
           a.droppedNan == b.droppedNan && a.droppedInfinite == b.droppedInfinite && a.droppedIndex == b.droppedIndex &&
           a.rasterised == b.rasterised && a.trianglesClipped == b.trianglesClipped && a.quadsShaded == b.quadsShaded &&
           a.pixelsShaded == b.pixelsShaded && a.pixelsColorless == b.pixelsColorless &&
           a.pixelsHidden == b.pixelsHidden && a.stencilPassed == b.stencilPassed &&
           a.stencilFailed == b.stencilFailed && a.invalidColors == b.invalidColors;
}

}  // namespace

Result draw(Source source)
{
    const Scene scene = randomScene(source);
    Framebuffer target = *Framebuffer::create(scene.width, scene.height, scene.format, scene.depth, scene.samples);
    fill(target);
    const Framebuffer before = target;

    Result result;
    const auto begin = std::chrono::steady_clock::now();
    Frame frame(target, scene.options);
    record(frame, scene);
    const Statistics statistics = frame.run();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.trianglesSubmitted = statistics.trianglesSubmitted;
    result.dropped = statistics.droppedNan + statistics.droppedInfinite + statistics.droppedIndex;
    result.pixelsShaded = statistics.pixelsShaded;
    result.invalidColors = statistics.invalidColors;

    const Framebuffer first = target;
    const auto broken = [&](bool is, const char* what) {
        if (is && result.broken.empty()) result.broken = what;
    };
    broken(!allFinite(target), "a NaN or an infinity in the target");
    broken(!scene.clears && guardChanged(scene, before, target), "a pixel outside of the scissor changed");
    broken(!addsUp(statistics), "the counts of triangles do not add up");

    target = before;
    const Statistics again = frame.run();
    broken(!target.samePixels(first), "a second run gives other bits");
    broken(!sameCounts(statistics, again), "a second run counts otherwise");

    target = before;
    Frame other(target, scene.otherOptions);
    record(other, scene);
    const Statistics others = other.run();
    broken(!target.samePixels(first), "other threads and tiles give other bits");
    broken(!sameCounts(statistics, others), "other threads and tiles count otherwise");
    return result;
}

}  // namespace random_scene
