// 5.02 Object-space map: Lighting of Bumpy Surfaces; Rendering 6, section 4.2
// New: normals of the object itself in a map, drawn by unfolding the mesh, beside those of tangent space.
// Was: bumps on one sphere (5.01).
#include "common/screen_quad.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
};

struct MyVertexProgram : StoneMaterial {
    float4 uv_ST = vector("uv_ST", {1, 1, 0, 0}, {-16, 16}, "tiling in x and y, offset in z and w");

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = TRANSFORM_TEX(v.uv, uv_ST);
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        return i;
    }
};

// The mesh laid out as its uvs are, so that every texel of the target is drawn by the surface that will read it.
struct UnfoldVertexProgram : MyVertexProgram {
    float2 moved = float2(0.0f);  // in texels of the target
    Float side = 1.0f;

    Interpolators operator()(VertexData v) const {
        const float2 at = v.uv * 2.0f - 1.0f + moved * (2.0f / side);
        return {float4(at, 0.5f, 1.0f), v.uv, v.normal, v.tangent};
    }
};

template <bool BAKE>
struct TangentSpaceProgram : StoneMaterial {
    float3 NormalOf(const Interpolators& i) const {
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        return TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
    }
    float4 operator()(Interpolators i) const {
        const float3 normal = NormalOf(i);
        if constexpr (BAKE) return float4(normal * 0.5f + 0.5f, 1);
        return float4(tint.rgb() * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

struct ObjectSpaceProgram : StoneMaterial {
    sampler2D objectNormalMap = {};

    float4 operator()(Interpolators i) const {
        // Neither tangent, binormal nor the mesh's own normal.
        const float3 normal = UnityObjectToWorldNormal(object, tex2D(objectNormalMap, i.uv).xyz() * 2.0f - 1.0f);
        return float4(tint.rgb() * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

// A tangent-space map as most formats show it.
struct ShowBumps : StoneMaterial {
    float4 operator()(ScreenInterpolators i) const {
        return float4(pow(UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale) * 0.5f + 0.5f, float3(2.2f)), 1);
    }
};
struct ShowNormals {
    sampler2D map;
    float4 operator()(ScreenInterpolators i) const { return float4(pow(tex2D(map, i.uv).rgb(), float3(2.2f)), 1); }
};

struct Map : Uniforms {
    Float mapSize = number("mapSize", 512.0f, {16, 2048}, "side of the object-space map, texels");
};

// The tangent-space map and the mesh as one map of the object's own normals.
sampler2D ObjectSpaceMap(const Scene& s) {
    const Map map = s.uniforms();
    const int side = static_cast<int>(map.mapSize[0]);
    const Framebuffer& baked = s.pass(*Framebuffer::create(side, side, {{Format::rgba8}}), [&map](const Scene& p) {
        // Four times moved by six texels, so that filters find normals beyond the edges of what is laid out.
        for (const glm::vec2& moved :
             {glm::vec2(-6, 0), glm::vec2(6, 0), glm::vec2(0, -6), glm::vec2(0, 6), glm::vec2(0)}) {
            UnfoldVertexProgram vertex = p.uniforms();
            vertex.moved = moved;
            vertex.side = map.mapSize;
            p.draw(p.mesh, vertex, TangentSpaceProgram<true>(p.uniforms()),
                   {.depthTest = Compare::always, .cull = Cull::none});
        }
    });
    sampler2D normals = s.sampled(baked, baked.colorIndex());
    normals.u = normals.v = AddressMode::wrap;
    normals.filter = Filter::trilinear;
    normals.mipmaps = true;
    return normals;
}

void DrawColumn(const Scene& s, int column, const Object& o, const sampler2D& normals, float tiling = 1.0f) {
    MyVertexProgram vertex = s.uniforms(o.worldFromObject);
    vertex.uv_ST = vertex.uv_ST * float4(tiling, tiling, 1.0f, 1.0f);
    ObjectSpaceProgram fragment = s.uniforms(o.worldFromObject);
    fragment.objectNormalMap = normals;
    s.cutCell(column, 5, 0, 2);
    s.draw(*o.mesh, vertex, fragment);
    s.cutCell(column, 5, 1, 2);
    s.draw(*o.mesh, vertex, TangentSpaceProgram<false>(s.uniforms(o.worldFromObject)));
}

}  // namespace

Stage beyond_02_object_space_map() {
    return {.title = "Object-space map",
            .section = "Lighting of Bumpy Surfaces; Rendering 6, 4.2",
            .news = "One relief as two maps, on a sphere as it is, mirrored, with mirrored uv, and tiled.",
            .uniforms = declared<MyVertexProgram, Map>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.5f, -4.2f}},
            .draw = [](const Scene& s) {
                const sampler2D normals = ObjectSpaceMap(s);
                const glm::mat4 turned = rotationY(30.0f);
                const Mesh& mirroredUv = s.keep(withMirroredUv(s.withTangents(s.mesh)));
                s.cutCell(0, 5, 0, 2);
                s.draw(primitive("quad"), ScreenVertexProgram{0.18f, 0.32f}, ShowNormals{normals});
                s.cutCell(0, 5, 1, 2);
                s.draw(primitive("quad"), ScreenVertexProgram{0.18f, 0.32f}, ShowBumps(s.uniforms()));
                DrawColumn(s, 1, {&s.mesh, turned}, normals);
                DrawColumn(s, 2, {&s.mesh, scaling({-1, 1, 1}) * turned}, normals);
                DrawColumn(s, 3, {&mirroredUv, turned}, normals);
                DrawColumn(s, 4, {&s.mesh, turned}, normals, 3.0f);
                s.labelColumns({"object space", "as it is", "mirrored", "wrong: flipped u", "wrong: tiled"}, 0, 2);
                s.labelColumns({"tangent space", "as it is", "mirrored", "flipped u", "tiled"}, 1, 2);
            }};
}

}  // namespace relief::samples
