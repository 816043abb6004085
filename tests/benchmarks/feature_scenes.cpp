#include "feature_scenes.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/screen_quad.h"
#include "relief/relief.h"
#include "relief/shading/camera.h"
#include "relief/shading/normals.h"
#include "relief/shading/object_transform.h"
#include "relief/shading/tangent_space.h"

namespace relief::benchmarks {

namespace {

// --- programs ---

struct BumpyVertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct BumpyInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

struct BumpyVertexProgram
{
    ObjectTransform object;
    Float tiling;

    BumpyInterpolators operator()(BumpyVertexData v) const
    {
        BumpyInterpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv * tiling;
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        return i;
    }
};

// What all programs with bumps have. No object is mirrored.
struct Bumps
{
    sampler2D normalMap;

    float3 normalOf(const BumpyInterpolators& i) const
    {
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), kBumpScale);
        const float3 binormal = CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, 1.0f);
        return TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
    }
};

struct Sun
{
    float3 color, dir, cameraPos;

    // Lambert and Blinn-Phong of the sun, `share` of which arrives.
    float3 lit(const float3& worldPos, const float3& normal, Float share) const
    {
        const float3 halfway = normalize(dir + normalize(cameraPos - worldPos));
        const Float specular = pow(saturate(dot(normal, halfway)), kShininess) * kSpecular;
        return color * (saturate(dot(normal, dir)) * share + kAmbient) + float3(specular * share);
    }
};

struct SunFragmentProgram
{
    Bumps bumps;
    Sun sun;

    float4 operator()(BumpyInterpolators i) const
    {
        return float4(sun.lit(i.worldPos, bumps.normalOf(i), Float(1.0f)), 1);
    }
};

struct DepthVertexData
{
    POSITION position;
};
struct DepthInterpolators
{
    SV_POSITION position;
};
struct DepthVertexProgram
{
    ObjectTransform object;

    DepthInterpolators operator()(DepthVertexData v) const { return {UnityObjectToClipPos(object, v.position)}; }
};
struct NoColor
{
    float4 operator()(DepthInterpolators) const { return float4(0.0f); }
};

struct ShadowFragmentProgram
{
    Bumps bumps;
    Sun sun;
    float4x4 lightFromWorld;
    SamplerComparisonState shadowMap;

    float4 operator()(BumpyInterpolators i) const
    {
        const float3 offset = i.worldPos + normalize(i.normal) * kNormalOffset;
        const float4 p = mul(lightFromWorld, float4(offset, 1));
        const Float share = SampleCmp(shadowMap, p.xy() * 0.5f + 0.5f, p.z);
        return float4(sun.lit(i.worldPos, bumps.normalOf(i), share), 1);
    }
};

struct MirrorFragmentProgram
{
    Bumps bumps;
    samplerCUBE environment;
    float3 cameraPos;

    float4 operator()(BumpyInterpolators i) const
    {
        const float3 viewDir = normalize(cameraPos - i.worldPos);
        return float4(texCUBE(environment, reflect(-viewDir, bumps.normalOf(i))).rgb(), 1);
    }
};

struct GBuffer
{
    SV_Target<0> albedo;
    SV_Target<1> normal;  // 3 x 8 bits
};

struct WriteGBuffer
{
    Bumps bumps;
    sampler2D mainTex;

    GBuffer operator()(BumpyInterpolators i) const
    {
        return {tex2D(mainTex, i.uv), float4(bumps.normalOf(i) * 0.5f + 0.5f, 1)};
    }
};

// The sun and a lamp, for what the G-buffer holds.
struct LightPixels
{
    sampler2D depths, albedos, normals;
    Sun sun;
    float4x4 worldFromClip;

    float4 operator()(samples::ScreenInterpolators i, Discard& discard) const
    {
        const float2 uv = i.uv;
        const Float depth = tex2D(depths, uv).x;
        discard(depth == 1.0f);  // nothing was drawn there
        if (discard.all()) return 0.0f;
        const float4 p = mul(worldFromClip, float4(uv.x * 2.0f - 1.0f, uv.y * 2.0f - 1.0f, depth, 1));
        const float3 worldPos = p.xyz() / p.w;
        const float3 normal = normalize(tex2D(normals, uv).xyz() * 2.0f - 1.0f);
        const float3 toLamp = broadcast(kLampPosition) - worldPos;
        const Float square = dot(toLamp, toLamp);
        const Float lamp = saturate(dot(normal, toLamp * rsqrt(square))) / (1.0f + 4.0f * square);
        const float3 light = sun.lit(worldPos, normal, Float(1.0f)) + broadcast(kLampColor) * lamp;
        return float4(tex2D(albedos, uv).rgb() * light, 1);
    }
};

// --- what they are given ---

// 512 x 512 texels with 8 x 8 round bumps, as DXT5nm has them: x in alpha, y in green.
Texture bumpTexture()
{
    constexpr int kSide = 512, kCell = 64;
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec2 place = glm::vec2(i % kSide % kCell, i / kSide % kCell) - (kCell - 1) * 0.5f;
        const float square = glm::dot(place, place) / (0.2f * kCell * kCell);
        const glm::vec2 slope = square < 1.0f ? place * ((1.0f - square) * 3.0f / kCell) : glm::vec2(0.0f);
        const auto code = [](float x) { return static_cast<std::uint8_t>(x * 127.5f + 127.5f + 0.5f); };
        pixels.insert(pixels.end(), {255, code(-slope.y), 255, code(slope.x)});  // row 0 is the upper one
    }
    return *Texture::fromRgba8(kSide, kSide, pixels, ColorSpace::linear);
}

// Each direction in a colour of its own, and lines.
CubeMap gridCube()
{
    constexpr int kSide = 256, kLine = 32;
    std::array<ImageFile, kCubeFaces> faces;
    for (int face = 0; face < kCubeFaces; ++face) {
        Image8 picture = {kSide, kSide, {}};
        const CubeFaceAxes& axes = kCubeFaceAxes[static_cast<std::size_t>(face)];
        for (int i = 0; i < kSide * kSide; ++i) {
            const int x = i % kSide, y = i / kSide;
            const glm::vec2 place = (glm::vec2(x, kSide - 1 - y) + 0.5f) * (2.0f / kSide) - 1.0f;
            const glm::vec3 direction =
                glm::normalize(glm::vec3(axes.middle) + glm::vec3(axes.right) * place.x + glm::vec3(axes.up) * place.y);
            const bool line = x % kLine < 2 || y % kLine < 2;
            for (int c = 0; c < 3; ++c) {
                const float bright = line ? 1.0f : direction[c] * 0.4f + 0.5f;
                picture.pixels.push_back(static_cast<std::uint8_t>(bright * 255.0f + 0.5f));
            }
            picture.pixels.push_back(255);
        }
        faces[static_cast<std::size_t>(face)] = std::move(picture);
    }
    return *CubeMap::fromFaces(faces, ColorSpace::linear);
}

std::unique_ptr<SceneData> sceneData(int width, int height, const glm::vec3& cameraPos, const glm::vec3& target)
{
    auto data = std::make_unique<SceneData>();
    data->cameraPos = cameraPos;
    data->clipFromWorld = perspective(40.0f, static_cast<float>(width) / static_cast<float>(height), 0.05f, 100.0f) *
                          lookAt(cameraPos, target);
    data->texture.emplace(bumpTexture());
    data->lightDir = glm::normalize(glm::vec3(-0.5f, 0.8f, -0.6f));
    data->color = {0.8f, 0.75f, 0.6f};
    return data;
}

Sun sunOf(const SceneData& data)
{
    return {broadcast(data.color), broadcast(data.lightDir), broadcast(data.cameraPos)};
}

Bumps bumpsOf(const SceneData& data)
{
    return {{.texture = &*data.texture}};
}

// A sphere and cubes on a floor.
void addStillLife(SceneData& data)
{
    data.pieces.push_back({makeGrid(8, 8), translation({0, -0.5f, 0}) * rotationX(90) * scaling(glm::vec3(6)), 6.0f});
    data.pieces.push_back({makeCubeSphere(48), translation({0, 0.1f, 0}) * scaling(glm::vec3(1.2f)), 1.0f});
    for (int i = 0; i < 6; ++i) {
        const float turn = 60.0f * static_cast<float>(i) + 15.0f;
        data.pieces.push_back(
            {makeCube(), rotationY(turn) * translation({0, -0.3f, 1.3f}) * rotationY(turn) * scaling(glm::vec3(0.4f)),
             0.5f});
    }
}

template <class FragmentProgram>
void drawPieces(Frame& frame, const SceneData& data, const FragmentProgram& fragmentProgram)
{
    for (const Piece& piece : data.pieces) {
        frame.draw(piece.mesh, BumpyVertexProgram{{data.clipFromWorld, piece.worldFromObject}, piece.tiling},
                   fragmentProgram);
    }
}

// Of what is drawn before the picture; null, and a problem, where the memory for it cannot be had.
EarlierPass* addPass(SceneData& data, Expected<Framebuffer> target, const Frame& picture)
{
    if (!target) {
        data.problem = target.error().message;
        return nullptr;
    }
    data.pass = std::make_unique<EarlierPass>(std::move(*target), picture.options().threads);
    return data.pass.get();
}

// --- the scenes ---

// A bumpy sphere and thin bars in all directions.
std::unique_ptr<SceneData> multisampled(Frame& frame, int width, int height)
{
    auto data = sceneData(width, height, {0, 0.4f, -2.6f}, glm::vec3(0));
    data->pieces.push_back({makeCubeSphere(48), scaling(glm::vec3(1.1f)), 1.0f});
    for (int i = 0; i < 60; ++i) {
        const float turn = static_cast<float>(i) * 47.0f, tilt = static_cast<float>(i) * 6.0f;
        data->pieces.push_back(
            {makeCube(), rotationY(turn) * rotationX(tilt) * translation({0, 0, 0.7f}) * scaling({0.02f, 0.02f, 0.6f}),
             0.25f});
    }
    drawPieces(frame, *data, SunFragmentProgram{bumpsOf(*data), sunOf(*data)});
    return data;
}

std::unique_ptr<SceneData> shadowed(Frame& frame, int width, int height)
{
    auto data = sceneData(width, height, {0, 1.6f, -3.4f}, {0, -0.1f, 0});
    addStillLife(*data);
    data->lightFromWorld = orthographic(4.8f, 4.8f, 0.5f, 8.0f) * lookAt(data->lightDir * 4.0f, glm::vec3(0));
    EarlierPass* const pass = addPass(
        *data, Framebuffer::create(kShadowMapSide, kShadowMapSide, {{Format::depth32f, Store::texture}}), frame);
    if (pass == nullptr) return data;
    pass->frame.clearDepth();
    for (const Piece& piece : data->pieces) {
        pass->frame.draw(piece.mesh, DepthVertexProgram{{data->lightFromWorld, piece.worldFromObject}}, NoColor{});
    }
    drawPieces(
        frame, *data,
        ShadowFragmentProgram{
            bumpsOf(*data), sunOf(*data), broadcast(data->lightFromWorld), {.texture = pass->target.texture(0)}});
    return data;
}

std::unique_ptr<SceneData> reflecting(Frame& frame, int width, int height)
{
    auto data = sceneData(width, height, {-0.5f, 0.5f, -1.4f}, glm::vec3(0));
    data->cubeMap.emplace(gridCube());
    data->pieces.push_back({makeCubeSphere(48), glm::mat4(1.0f), 1.0f});
    drawPieces(frame, *data,
               MirrorFragmentProgram{bumpsOf(*data), {.texture = &*data->cubeMap}, broadcast(data->cameraPos)});
    return data;
}

std::unique_ptr<SceneData> deferred(Frame& frame, int width, int height)
{
    auto data = sceneData(width, height, {0, 1.6f, -3.4f}, {0, -0.1f, 0});
    addStillLife(*data);
    data->albedo.emplace(testTexture());
    data->mesh = makeQuad();
    const Attachment bytes = {Format::rgba8, Store::texture};
    EarlierPass* const pass =
        addPass(*data, Framebuffer::create(width, height, {bytes, bytes, {Format::depth32f, Store::texture}}), frame);
    if (pass == nullptr) return data;
    pass->frame.clear(glm::vec4(0.0f));
    drawPieces(pass->frame, *data, WriteGBuffer{bumpsOf(*data), {.texture = &*data->albedo}});
    const auto texels = [&](int attachment) {
        return sampler2D{.texture = pass->target.texture(attachment),
                         .filter = Filter::nearest,
                         .u = AddressMode::clamp,
                         .v = AddressMode::clamp,
                         .mipmaps = false};
    };
    frame.draw(
        data->mesh, samples::ScreenVertexProgram{},
        LightPixels{texels(2), texels(0), texels(1), sunOf(*data), broadcast(glm::inverse(data->clipFromWorld))});
    return data;
}

}  // namespace

const std::vector<BenchScene>& featureScenes()
{
    static const std::vector<BenchScene> scenes = {
        {"multisampled", "a bumpy sphere and thin bars, four samples a pixel", multisampled, 4},
        {"shadowed", "a still life in the sun, with a shadow map of 2x2 comparisons", shadowed},
        {"reflecting", "a cube map in a bumpy sphere", reflecting},
        {"deferred", "colours, normals and depths in one draw, lit in the next", deferred},
    };
    return scenes;
}

}  // namespace relief::benchmarks
