#include "scenes.h"

#include "common/camera.h"
#include "common/render.h"
#include "relief/relief.h"
#include "relief/shading/object_transform.h"

namespace relief::benchmarks {

namespace {

struct PositionOnly
{
    POSITION position;
};

struct PositionUv
{
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct PositionNormal
{
    POSITION position;
    NORMAL normal;
};

struct FlatInterpolators
{
    SV_POSITION position;
};

struct UvInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
};

struct NormalInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> normal;
};

// Covers the screen at one depth; the quad is the unit quad.
struct ScreenVertexProgram
{
    Float depth;

    FlatInterpolators operator()(PositionOnly v) const
    {
        return {float4(v.position.x * 2.0f, v.position.y * 2.0f, depth, 1)};
    }
};

struct ConstantFragmentProgram
{
    float4 color;

    float4 operator()(FlatInterpolators) const { return color; }
};

// uv (0, 0) lies below the camera: floats are finest where texels are largest on screen.
struct PlaneVertexProgram
{
    ObjectTransform object;
    Float tiling;

    UvInterpolators operator()(PositionUv v) const
    {
        return {UnityObjectToClipPos(object, v.position), float2((v.uv - 0.5f) * tiling)};
    }
};

struct TextureFragmentProgram
{
    sampler2D mainTex;

    float4 operator()(UvInterpolators i) const { return tex2D(mainTex, i.uv); }
};

struct FinestLevelFragmentProgram
{
    sampler2D mainTex;

    float4 operator()(UvInterpolators i) const
    {
        const float2 uv = i.uv;
        return tex2Dlod(mainTex, float4(uv.x, uv.y, 0, 0));
    }
};

struct TerrainVertexProgram
{
    ObjectTransform object;

    NormalInterpolators operator()(PositionNormal v) const
    {
        return {UnityObjectToClipPos(object, v.position), UnityObjectToWorldNormal(object, v.normal)};
    }
};

struct LambertFragmentProgram
{
    float3 lightDir, color;

    float4 operator()(NormalInterpolators i) const
    {
        return float4(color * saturate(dot(normalize(i.normal), lightDir)), 1);
    }
};

// The triangle's place and colour are the mesh's.
struct SmallVertexProgram
{
    UvInterpolators operator()(PositionUv v) const { return {v.position, v.uv}; }
};

struct UvFragmentProgram
{
    float4 operator()(UvInterpolators i) const
    {
        const float2 color = i.uv;
        return float4(color.x, color.y, 0.5f, 1);
    }
};

std::unique_ptr<SceneData> clearOnly(Frame&, int, int)
{
    return std::make_unique<SceneData>();
}

std::unique_ptr<SceneData> layers(Frame& frame, int count)
{
    auto data = std::make_unique<SceneData>();
    data->mesh = makeQuad();
    data->worldFromObject = samples::scaling({2, 2, 1});  // as ScreenVertexProgram does
    for (int i = 0; i < count; ++i) {
        const float part = static_cast<float>(i + 1) / static_cast<float>(count + 1);
        data->layers.push_back({1.0f - part, {part, 0.5f, 0.25f, 1.0f}});
    }
    for (const Layer& layer : data->layers) {
        frame.draw(data->mesh, ScreenVertexProgram{layer.depth}, ConstantFragmentProgram{broadcast(layer.color)},
                   RenderState{.cull = Cull::none});
    }
    return data;
}

glm::mat4 clipFromWorld(const samples::Camera& camera, int width, int height)
{
    return samples::clipFromView(camera, static_cast<float>(width) / static_cast<float>(height)) *
           samples::viewFromWorld(camera);
}

// makeQuad() in cells x cells pieces. Where uv spans many repetitions its last bits are worth a good part of a texel,
// and two rasterizers' derivatives differ by as much; within a piece it spans few.
Mesh makeGrid(std::uint32_t cells)
{
    Mesh mesh;
    for (std::uint32_t y = 0; y <= cells; ++y) {
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / static_cast<float>(cells);
            mesh.positions.emplace_back(uv - 0.5f, 0.0f);
            mesh.normals.emplace_back(0.0f, 0.0f, -1.0f);
            mesh.uvs.push_back(uv);
            if (x == cells || y == cells) continue;
            const std::uint32_t corner = y * (cells + 1) + x, above = corner + cells + 1;
            mesh.indices.insert(mesh.indices.end(), {corner, above, above + 1, corner, above + 1, corner + 1});
        }
    }
    return mesh;
}

// Each triangle has corners in a square of 20 pixels, so that its sides are some 10 pixels long; it has one depth, and
// one colour as its uv. The mesh is in clip space.
std::unique_ptr<SceneData> smallTriangles(Frame& frame, int width, int height)
{
    auto data = std::make_unique<SceneData>();
    std::uint32_t noise = 1;
    const auto random = [&noise] {  // 0 ... 1
        noise = noise * 1664525u + 1013904223u;
        return static_cast<float>(noise >> 8) * 0x1p-24f;
    };
    const glm::vec2 side(40.0f / static_cast<float>(width), 40.0f / static_cast<float>(height));
    Mesh& mesh = data->mesh;
    for (std::uint32_t i = 0; i < 3 * 20000; i += 3) {
        const float x = random() * 2.0f - 1.0f, y = random() * 2.0f - 1.0f, depth = random();
        const float red = random(), green = random();
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const float right = random() - 0.5f, up = random() - 0.5f;
            mesh.positions.emplace_back(x + side.x * right, y + side.y * up, depth);
            mesh.normals.emplace_back(0.0f, 0.0f, -1.0f);
            mesh.uvs.emplace_back(red, green);
            mesh.indices.push_back(i + corner);
        }
    }
    frame.draw(mesh, SmallVertexProgram{}, UvFragmentProgram{}, RenderState{.cull = Cull::none});
    return data;
}

}  // namespace

Texture testTexture()
{
    std::vector<std::uint8_t> pixels;
    std::uint32_t noise = 1;
    for (int i = 0; i < 512 * 512; ++i) {
        noise = noise * 1664525u + 1013904223u;
        const bool line = i % 32 == 0 || i / 512 % 32 == 0;
        for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<std::uint8_t>(line ? 255 : 64 + (noise >> 25)));
        pixels.push_back(255);
    }
    return *Texture::fromRgba8(512, 512, pixels, ColorSpace::linear);
}

std::unique_ptr<SceneData> recordPlane(Frame& frame, int width, int height, Texture texture, PlaneFetch fetch)
{
    auto data = std::make_unique<SceneData>();
    data->mesh = makeGrid(16);
    data->texture.emplace(std::move(texture));
    data->maxAnisotropy = fetch.maxAnisotropy;
    data->tiling = 400.0f;
    const samples::Camera camera = {.position = {0, 1, 0}, .target = {0, 1, 1}, .fieldOfView = 60, .farPlane = 1000};
    data->clipFromWorld = clipFromWorld(camera, width, height);
    data->worldFromObject = samples::rotationX(90) * samples::scaling(glm::vec3(800));
    const PlaneVertexProgram vertexProgram = {{data->clipFromWorld, data->worldFromObject}, data->tiling};
    const sampler2D mainTex = {.texture = &*data->texture, .maxAnisotropy = fetch.maxAnisotropy};
    if (fetch.finestLevel) {
        frame.draw(data->mesh, vertexProgram, FinestLevelFragmentProgram{mainTex});
    } else {
        frame.draw(data->mesh, vertexProgram, TextureFragmentProgram{mainTex});
    }
    return data;
}

std::unique_ptr<SceneData> recordTerrain(Frame& frame, int width, int height, int cellsX, int cellsZ)
{
    auto data = std::make_unique<SceneData>();
    data->mesh = makeTerrain(cellsX, cellsZ);
    const samples::Camera camera = {.position = {0, 0.75f, -0.6f}, .target = {0, 0, -0.02f}, .fieldOfView = 50};
    data->clipFromWorld = clipFromWorld(camera, width, height);
    data->worldFromObject = samples::scaling({1.6f, 1, 1});
    data->lightDir = {0.40824829f, 0.81649658f, -0.40824829f};
    data->color = {0.8f, 0.7f, 0.5f};
    frame.draw(data->mesh, TerrainVertexProgram{{data->clipFromWorld, data->worldFromObject}},
               LambertFragmentProgram{broadcast(data->lightDir), broadcast(data->color)});
    return data;
}

std::unique_ptr<SceneData> recordStage(Frame& frame, int width, int height, const std::string& name,
                                       const std::vector<std::string>& settings)
{
    auto data = std::make_unique<SceneData>();
    auto prepared = samples::findStage(name).and_then(
        [&](const samples::Stage* found) { return samples::PreparedStage::prepare(*found, settings); });
    if (!prepared) {
        data->problem = prepared.error().message;
        return data;
    }
    data->stage.emplace(std::move(*prepared));
    const samples::Camera& camera = data->stage->camera();
    data->stage->record(frame, width, height);
    data->clipFromWorld = clipFromWorld(camera, width, height);
    data->stageScene.emplace(data->stage->scene(frame, width, height, camera));
    return data;
}

std::vector<samples::Object> SceneData::objects() const
{
    if (stage) return stage->inputs->objects;
    if (pieces.empty()) return {{&mesh, worldFromObject}};
    std::vector<samples::Object> all;
    for (const Piece& piece : pieces) all.push_back({&piece.mesh, piece.worldFromObject});
    return all;
}

void SceneData::runPasses()
{
    if (pass != nullptr) pass->frame.run();
}

Expected<Framebuffer> targetFor(const BenchScene& scene, int width, int height)
{
    return Framebuffer::create(width, height, Format::rgba8, Store::discard, scene.samples);
}

const std::vector<BenchScene>& benchScenes()
{
    static const std::vector<BenchScene> scenes = {
        {"clear", "nothing is drawn", clearOnly},
        {"flat_quad", "one colour on every pixel", [](Frame& f, int, int) { return layers(f, 1); }},
        {"trilinear_plane", "a ground plane to the horizon, one trilinear RGBA8 fetch",
         [](Frame& f, int w, int h) { return recordPlane(f, w, h, testTexture(), {}); }},
        {"anisotropic_plane", "the same plane, the fetch up to 16 times anisotropic",
         [](Frame& f, int w, int h) { return recordPlane(f, w, h, testTexture(), {.maxAnisotropy = 16}); }},
        {"layers_32", "32 full-screen layers, back to front", [](Frame& f, int, int) { return layers(f, 32); }},
        {"million_triangles", "a height field of 1,000,000 triangles, Lambert",
         [](Frame& f, int w, int h) { return recordTerrain(f, w, h, 1000, 500); }},
        {"small_triangles", "20,000 triangles of some 10 pixels, in any order", smallTriangles},
        {"stage_1.09", "five fetches and GGX on a quad",
         [](Frame& f, int w, int h) { return recordStage(f, w, h, "1.09"); }},
        {"stage_1.25", "four fetches and GGX on three objects, a pass for each of three lights",
         [](Frame& f, int w, int h) {  // however this build's stages compute binormals
             return recordStage(f, w, h, "1.25", {"binormalPerFragment=0"});
         }},
        {"stage_2.06", "a normal map under two lights, in two passes",
         [](Frame& f, int w, int h) { return recordStage(f, w, h, "2.06"); }},
        {"stage_4.07", "colours and normals from three sides, mixed",
         [](Frame& f, int w, int h) { return recordStage(f, w, h, "4.07"); }},
    };
    return scenes;
}

}  // namespace relief::benchmarks
