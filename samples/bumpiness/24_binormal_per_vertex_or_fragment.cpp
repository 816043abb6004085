// 1.24 Binormal per vertex or fragment: Rendering 6 "Bumpiness", section 4.4
// New: one source for both: BINORMAL_PER_FRAGMENT decides where the binormal is computed.
// Was: the binormal in the fragment program only (1.23).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

template <bool BINORMAL_PER_FRAGMENT>
struct Interpolators;

template <>
struct Interpolators<true> {
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<4, float3> worldPos;
};

template <>
struct Interpolators<false> {
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> tangent;
    TEXCOORD<3, float3> binormal;
    TEXCOORD<4, float3> worldPos;
};

template <bool BINORMAL_PER_FRAGMENT>
struct MyVertexProgram : DetailedMarble {
    Interpolators<BINORMAL_PER_FRAGMENT> operator()(VertexData v) const {
        Interpolators<BINORMAL_PER_FRAGMENT> i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        const float3 tangent = UnityObjectToWorldDir(object, v.tangent.xyz());
        if constexpr (BINORMAL_PER_FRAGMENT) {
            i.tangent = float4(tangent, v.tangent.w);
        } else {
            i.tangent = tangent;
            i.binormal = CreateBinormal(i.normal, tangent, v.tangent.w, object.unity_WorldTransformParams.w);
        }
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

template <bool BINORMAL_PER_FRAGMENT>
struct MyFragmentProgram : DetailedMarble {
    void InitializeFragmentNormal(Interpolators<BINORMAL_PER_FRAGMENT>& i) const {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 tangentSpaceNormal = BlendNormals(mainNormal, detailNormal);

        const float3 tangent = i.tangent.xyz();
        float3 binormal;
        if constexpr (BINORMAL_PER_FRAGMENT) {
            binormal = CreateBinormal(i.normal, tangent, i.tangent.w, object.unity_WorldTransformParams.w);
        } else {
            binormal = i.binormal;
        }
        i.normal = normalize(tangent * tangentSpaceNormal.x + binormal * tangentSpaceNormal.y +
                             i.normal * tangentSpaceNormal.z);
    }

    float4 operator()(Interpolators<BINORMAL_PER_FRAGMENT> i) const {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv.xy()).xyz() * tint.xyz();
        albedo *= tex2D(detailTex, i.uv.zw()).xyz() * unity_ColorSpaceDouble;
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

// The difference of the two normals, enlarged. Where the binormal points tells the sign that made it.
struct ShowDifference {
    MyFragmentProgram<false> perVertex;
    MyFragmentProgram<true> perFragment;
    Float exaggeration;

    float4 operator()(Interpolators<false> i) const {
        const Float sign =
            dot(cross(i.normal, i.tangent), i.binormal) * perFragment.object.unity_WorldTransformParams.w;
        Interpolators<true> other = {i.position, i.uv, i.normal, float4(i.tangent, sign), i.worldPos};
        perVertex.InitializeFragmentNormal(i);
        perFragment.InitializeFragmentNormal(other);
        return float4(abs(i.normal - other.normal) * exaggeration, 1);
    }
};

struct Choice : Uniforms {
    int binormalPerFragment =
        choice("binormalPerFragment", 2, {"per vertex", "per fragment", "both"}, "where the binormal is computed");
    Float exaggeration = number("exaggeration", 5.0f, {1, 1000}, "of the difference");
};

}  // namespace

Stage bumpiness_24_binormal_per_vertex_or_fragment() {
    return {
        .title = "Binormal per vertex or fragment",
        .section = "4.4",
        .news = "The binormal per vertex (left), per fragment (middle), and the normals' difference (right).",
        .uniforms = declared<MyFragmentProgram<true>, Choice>(),
        .mesh = "low-sphere",
        .camera = {.position = {0.0f, 0.35f, -2.5f}},
        .draw = [](const Scene& s) {
            const Object& o = s.objects[0];
            const Uniforms uniforms = s.uniforms(o.worldFromObject);
            const Choice choice = uniforms;
            const bool both = choice.binormalPerFragment == 2;
            if (both) s.cutCell(0, 3);
            if (choice.binormalPerFragment != 1) s.draw<MyVertexProgram<false>, MyFragmentProgram<false>>(o);
            if (both) s.cutCell(1, 3);
            if (choice.binormalPerFragment != 0) s.draw<MyVertexProgram<true>, MyFragmentProgram<true>>(o);
            if (!both) return;
            s.cutCell(2, 3);
            s.draw(*o.mesh, MyVertexProgram<false>(uniforms), ShowDifference{uniforms, uniforms, choice.exaggeration});
        }};
}

}  // namespace relief::samples
