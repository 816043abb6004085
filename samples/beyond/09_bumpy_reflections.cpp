// 5.09 Bumpy reflections: Blinn and Newell 1976; Karis 2013; Rendering 8
// New: normal maps decide where a mirror looks; roughness decides how much of the surroundings it mixes.
// Was: a smooth sphere (5.08).
#include "common/stage.h"
#include "shading/environment.h"

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
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

struct MyVertexProgram : DetailedMarble {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        return i;
    }
};

enum class Normals { whiteout, averaged, approximateRoot };

template <Normals NORMALS, bool MIRROR>
struct MyFragmentProgram : DetailedMarble {
    samplerCUBE environment = reflections();
    SphericalHarmonics light = irradiance();
    Float bumpScale = number("bumpScale", 0.7f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    Float detailBumpScale = number("detailBumpScale", 0.0f, {-32, 32}, "of the detail's bumps");
    Float exposure = number("exposure", 0.8f, {0, 8}, "what all light is multiplied by");
    Float roughness = 0.0f;
    int levels = environment.texture != nullptr ? environment.texture->levelCount() : 1;

    float3 Unpack(const float4& packednormal, Float scale) const {
        float3 normal = UnpackScaleNormal(packednormal, scale);
        if constexpr (NORMALS == Normals::approximateRoot) normal.z = 1.0f - 0.5f * dot(normal.xy(), normal.xy());
        return normal;
    }

    void InitializeFragmentNormal(Interpolators& i) const {
        const float3 mainNormal = Unpack(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = Unpack(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 bump = NORMALS == Normals::averaged ? BlendNormalsAverage(mainNormal, detailNormal)
                                                         : BlendNormals(mainNormal, detailNormal);
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        i.normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
    }

    float4 operator()(Interpolators i) const {
        InitializeFragmentNormal(i);
        if constexpr (!MIRROR) return float4(ShadeSH9(light, i.normal) * exposure, 1);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        const Float level = levelOfRoughness(roughness, levels);
        return float4(texCUBElod(environment, float4(reflect(-viewDir, i.normal), level)).rgb() * exposure, 1);
    }
};

template <Normals NORMALS, bool MIRROR>
void DrawCell(const Scene& s, int column, int row, Float roughness) {
    s.cutCell(column, 4, row, 2);
    for (const Object& o : s.objects) {
        MyFragmentProgram<NORMALS, MIRROR> fragment = s.uniforms(o.worldFromObject);
        fragment.roughness = roughness;
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
}

}  // namespace

Stage beyond_09_bumpy_reflections() {
    return {.title = "Bumpy reflections",
            .section = "Blinn and Newell 1976; Karis 2013; Rendering 8",
            .news = "Normal maps in a mirror, by roughness; and normals that only a mirror shows to be wrong.",
            .uniforms = declared<MyFragmentProgram<Normals::whiteout, true>>(),
            .mesh = "sphere",
            .camera = {.position = {-0.9f, 0.8f, -2.7f}},
            .draw = [](const Scene& s) {
                for (int column = 0; column < 4; ++column) {
                    const float roughness = static_cast<float>(column) * 0.25f;
                    DrawCell<Normals::whiteout, true>(s, column, 0, roughness);
                }
                s.labelColumns({"roughness 0", "0.25", "0.5", "0.75"}, 0, 2);
                DrawCell<Normals::whiteout, false>(s, 0, 1, 0.0f);
                DrawCell<Normals::approximateRoot, false>(s, 1, 1, 0.0f);
                DrawCell<Normals::whiteout, true>(s, 2, 1, 0.0f);
                DrawCell<Normals::approximateRoot, true>(s, 3, 1, 0.0f);
                s.labelColumns({"matte", "z = 1 - dot / 2", "mirror", "z = 1 - dot / 2"}, 1, 2);
            }};
}

}  // namespace relief::samples
