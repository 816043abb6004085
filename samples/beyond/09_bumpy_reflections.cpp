// 5.09 Bumpy reflections: Blinn and Newell 1976; Karis 2013; Rendering 8
// New: normal maps decide where a mirror looks; roughness decides how much of the surroundings it mixes.
// Was: a smooth sphere (5.08).
#include "common/stage.h"
#include "relief/shading/environment.h"

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

template <bool MIRROR>
struct MyFragmentProgram : DetailedMarble {
    samplerCUBE environment = reflections();
    SphericalHarmonics light = irradiance();
    Float bumpScale = number("bumpScale", 0.2f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    Float detailBumpScale = number("detailBumpScale", 0.0f, {-32, 32}, "of the detail's bumps");
    float bumpLevel = number("bumpLevel", 1.0f, {0, 8}, "finest level of the normal maps: the higher, the smoother");
    Float exposure = number("exposure", 0.8f, {0, 8}, "what all light is multiplied by");
    bool isAveraged = false;  // as in 1.16

    float3 NormalOf(const Interpolators& i) const {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 bump =
            isAveraged ? BlendNormalsAverage(mainNormal, detailNormal) : BlendNormals(mainNormal, detailNormal);
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        return TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
    }

    // As matte as can be, or as a mirror that is rough from some level of the environment on.
    float4 operator()(Interpolators i) const {
        const float3 normal = NormalOf(i), viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        if constexpr (!MIRROR) return float4(ShadeSH9(light, normal) * exposure, 1);
        return float4(texCUBE(environment, reflect(-viewDir, normal)).rgb() * exposure, 1);
    }
};

struct Exaggerated : Uniforms {
    Float exaggeration = number("exaggeration", 2.0f, {1, 100}, "of the differences");
};

// What 1.16's wrong normals change.
template <bool MIRROR>
struct ShowDifference {
    MyFragmentProgram<MIRROR> right, wrong;
    Float exaggeration;

    float4 operator()(Interpolators i) const { return float4(abs(right(i).rgb() - wrong(i).rgb()) * exaggeration, 1); }
};

template <bool MIRROR>
MyFragmentProgram<MIRROR> Program(const Uniforms& uniforms, float roughness) {
    MyFragmentProgram<MIRROR> program = uniforms;
    program.normalMap.minLod = program.detailNormalMap.minLod = program.bumpLevel;
    // The finest level that counts: a pixel that sees more of the surroundings takes a coarser one.
    const int levels = program.environment.texture != nullptr ? program.environment.texture->levelCount() : 1;
    program.environment.minLod = levelOfRoughness(roughness, levels)[0];
    return program;
}

template <bool MIRROR>
void DrawBesideDifference(const Scene& s, int column) {
    const Uniforms uniforms = s.uniforms();
    const MyFragmentProgram<MIRROR> right = Program<MIRROR>(uniforms, 0.0f);
    ShowDifference<MIRROR> difference = {right, right, Exaggerated(uniforms).exaggeration};
    difference.wrong.isAveraged = true;
    s.cutCell(column, 4, 1, 2);
    s.draw(s.mesh, MyVertexProgram(uniforms), right);
    s.cutCell(column + 1, 4, 1, 2);
    s.draw(s.mesh, MyVertexProgram(uniforms), difference);
}

}  // namespace

Stage beyond_09_bumpy_reflections() {
    return {.title = "Bumpy reflections",
            .section = "Blinn and Newell 1976; Karis 2013; Rendering 8",
            .news = "Normal maps in a mirror, by roughness; and normals that only a mirror shows to be wrong.",
            .uniforms = declared<MyFragmentProgram<true>, Exaggerated>(),
            .mesh = "sphere",
            .camera = {.position = {-0.9f, 0.8f, -2.95f}},
            .draw = [](const Scene& s) {
                for (int column = 0; column < 4; ++column) {
                    s.cutCell(column, 4, 0, 2);
                    const float roughness = static_cast<float>(column) * 0.25f;
                    s.draw(s.mesh, MyVertexProgram(s.uniforms()), Program<true>(s.uniforms(), roughness));
                }
                s.labelColumns({"roughness 0", "0.25", "0.5", "0.75"}, 0, 2);
                DrawBesideDifference<false>(s, 0);
                DrawBesideDifference<true>(s, 2);
                const Exaggerated shown = s.uniforms();
                const std::string error = "1.16's error x " + shortNumber(shown.exaggeration[0]);
                s.labelColumns({"matte", error, "mirror", error}, 1, 2);
            }};
}

}  // namespace relief::samples
