// 4.13 All methods: Normal Mapping for a Triplanar Shader, "Chasing the truth"
// New: every method beside the others, and by how many degrees each is off two truths.
// Was: one method at a time (4.02 to 4.10).
#include "common/false_color.h"
#include "common/stage.h"
#include "common/triplanar_methods.h"
#include "relief/shading/cotangent_frame.h"
#include "relief/shading/triplanar.h"

namespace relief::samples {
namespace {

using namespace triplanar;

// A method of its own: the mesh's tangents. It alone needs them.
struct MeshTangents {};

template <bool TANGENTS>
struct VertexData {
    POSITION position;
    NORMAL normal;
};

template <>
struct VertexData<true> {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
};

template <bool TANGENTS>
struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
};

template <>
struct Interpolators<true> {
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
    TEXCOORD<2, float4> worldTangent;
};

template <bool TANGENTS>
struct MyVertexProgram : Uniforms {
    Interpolators<TANGENTS> operator()(VertexData<TANGENTS> v) const {
        Interpolators<TANGENTS> i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.worldNormal = UnityObjectToWorldNormal(object, v.normal);
        if constexpr (TANGENTS) {
            i.worldTangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        }
        return i;
    }
};

// What a draw shows: the surface in its light, or its angle to a truth.
enum class Show { light, angleAlongProjection, angleAlongNormal };

template <class Method>
struct MyFragmentProgram : TriplanarMaterial {
    static constexpr bool kTangents = std::is_same_v<Method, MeshTangents>;
    Show show = Show::light;
    Float maximumAngle = number("maximumAngle", 20.0f, {1, 180}, "degrees that are red");

    static float3 WorldNormal(const Interpolators<kTangents>& i, const Triplanar<float2>& uv,
                              const Triplanar<float3>& bumps, const float3& blend) {
        if constexpr (kTangents) {
            const float3 tnormal = bumps.x * blend.x + bumps.y * blend.y + bumps.z * blend.z;
            const float3 tangent = i.worldTangent.xyz();
            const float3 binormal = cross(i.worldNormal, tangent) * i.worldTangent.w;
            return normalize(tangent * tnormal.x + binormal * tnormal.y + i.worldNormal * tnormal.z);
        } else if constexpr (std::is_same_v<Method, CotangentFrame>) {
            return normalize(mul(cotangent_frame(i.worldNormal, i.worldPos, uv.x), bumps.x) * blend.x +
                             mul(cotangent_frame(i.worldNormal, i.worldPos, uv.y), bumps.y) * blend.y +
                             mul(cotangent_frame(i.worldNormal, i.worldPos, uv.z), bumps.z) * blend.z);
        } else {
            return TriplanarNormal(bumps, i.worldNormal, blend, Method());
        }
    }

    float4 operator()(Interpolators<kTangents> i) const {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        const Triplanar<float3> bumps = {UnpackScaleNormal(texel.x, bumpScale), UnpackScaleNormal(texel.y, bumpScale),
                                         UnpackScaleNormal(texel.z, bumpScale)};
        const float3 normal = WorldNormal(i, uv, bumps, blend);
        if (show != Show::light) {
            const float3 truth = show == Show::angleAlongProjection
                                     ? TriplanarNormal(bumps, i.worldNormal, blend, AlongProjection())
                                     : TriplanarNormal(bumps, i.worldNormal, blend, AlongNormal());
            return float4(falseColor(degreesBetween(normal, truth) / maximumAngle), 1);
        }
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

template <class Method>
void drawShape(const Scene& s, Show show) {
    for (const Object& o : s.objects) {
        const Uniforms uniforms = s.uniforms(o.worldFromObject);
        MyFragmentProgram<Method> fragment = uniforms;
        fragment.show = show;
        s.draw(*o.mesh, MyVertexProgram<fragment.kTangents>(uniforms), fragment);
    }
}

template <class... Method>
void drawAll(const Scene& s) {
    int column = 0;
    const auto drawColumn = [&]<class One>() {
        for (const Show show : {Show::light, Show::angleAlongProjection, Show::angleAlongNormal}) {
            s.cutCell(column, sizeof...(Method), static_cast<int>(show), 3);
            drawShape<One>(s, show);
        }
        ++column;
    };
    (drawColumn.template operator()<Method>(), ...);
}

}  // namespace

Stage triplanar_13_all_methods() {
    return {.title = "All methods",
            .section = "Chasing the truth",
            .news = "Eight methods (above), and the angles to two truths: along the projection, along the normal.",
            .uniforms = declared<MyFragmentProgram<Swizzle>>(),
            .mesh = "sphere",
            .camera = {.position = {2.9f, 2.9f, -5.1f}},
            .draw = [](const Scene& s) {
                drawAll<MeshTangents, Swizzle, Udn, GpuGems3, Whiteout, Reoriented, CotangentFrame, CrossProducts>(s);
                s.labelColumns({"mesh tangents", "swizzle", "UDN", "GPU Gems 3", "whiteout", "RNM", "cotangent frame",
                                "cross products"});
                const Float red = MyFragmentProgram<Udn>(s.uniforms()).maximumAngle;
                const std::string scale = ", red: " + shortNumber(red[0]) + " degrees";
                s.labelColumns({"angle to the truth along the projection" + scale}, 1, 3);
                s.labelColumns({"angle to the truth along the normal" + scale}, 2, 3);
                s.cutStrip(0.0f, 1.0f);
                s.note("degrees at a tilt of 45 and a slope of 0.5: maximum and RMS to each truth");
                for (const MethodError& e : triplanarErrors(45.0f, 0.5f)) s.note(formatted(e));
            }};
}

}  // namespace relief::samples
