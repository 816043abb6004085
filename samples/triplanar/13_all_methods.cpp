// 4.13 All methods: Normal Mapping for a Triplanar Shader, "Chasing the truth"
// New: every method beside the others, and by how many degrees each is off two truths.
// Was: one method at a time (4.02 to 4.10).
#include "common/false_color.h"
#include "common/stage.h"
#include "common/triplanar_methods.h"
#include "shading/cotangent_frame.h"
#include "shading/triplanar.h"

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

// `compare`: 0 shows the surface in its light, 1 to 3 the angle to AlongProjection, AlongNormal and Rotated.
template <class Method, int compare>
struct MyFragmentProgram : TriplanarMaterial {
    static constexpr bool kTangents = std::is_same_v<Method, MeshTangents>;
    Float maximumAngle = number("maximumAngle", 20.0f, {1, 180}, "degrees that are red");

    template <class Any>
    static float3 WorldNormal(const Interpolators<kTangents>& i, const Triplanar<float2>& uv,
                              const Triplanar<float3>& bumps, const float3& blend) {
        if constexpr (std::is_same_v<Any, MeshTangents>) {
            const float3 tnormal = bumps.x * blend.x + bumps.y * blend.y + bumps.z * blend.z;
            const float3 tangent = i.worldTangent.xyz();
            const float3 binormal = cross(i.worldNormal, tangent) * i.worldTangent.w;
            return normalize(tangent * tnormal.x + binormal * tnormal.y + i.worldNormal * tnormal.z);
        } else if constexpr (std::is_same_v<Any, CotangentFrame>) {
            return normalize(mul(cotangent_frame(i.worldNormal, i.worldPos, uv.x), bumps.x) * blend.x +
                             mul(cotangent_frame(i.worldNormal, i.worldPos, uv.y), bumps.y) * blend.y +
                             mul(cotangent_frame(i.worldNormal, i.worldPos, uv.z), bumps.z) * blend.z);
        } else {
            return TriplanarNormal(bumps, i.worldNormal, blend, Any());
        }
    }

    float4 operator()(Interpolators<kTangents> i) const {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        const Triplanar<float3> bumps = {UnpackScaleNormal(texel.x, bumpScale), UnpackScaleNormal(texel.y, bumpScale),
                                         UnpackScaleNormal(texel.z, bumpScale)};
        const float3 normal = WorldNormal<Method>(i, uv, bumps, blend);
        if constexpr (compare > 0) {
            using Truth = std::tuple_element_t<compare - 1, std::tuple<AlongProjection, AlongNormal, Rotated>>;
            const float3 truth = WorldNormal<Truth>(i, uv, bumps, blend);
            return float4(falseColor(degreesBetween(normal, truth) / maximumAngle), 1);
        }
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

template <class Method, int compare>
void drawShape(const Scene& s) {
    using Program = MyFragmentProgram<Method, compare>;
    for (const Object& o : s.objects) s.draw<MyVertexProgram<Program::kTangents>, Program>(o);
}

template <class... Method>
void drawAll(const Scene& s) {
    int column = 0;
    const auto drawColumn = [&]<class One>() {
        constexpr int kColumns = sizeof...(Method);
        s.cutCell(column, kColumns, 0, 3);
        drawShape<One, 0>(s);
        s.cutCell(column, kColumns, 1, 3);
        drawShape<One, 1>(s);
        s.cutCell(column, kColumns, 2, 3);
        drawShape<One, 2>(s);
        ++column;
    };
    (drawColumn.template operator()<Method>(), ...);
}

}  // namespace

Stage triplanar_13_all_methods() {
    return {.title = "All methods",
            .section = "Chasing the truth",
            .news = "Eight methods (above), and the angles to two truths: along the projection, along the normal.",
            .uniforms = declared<MyFragmentProgram<Swizzle, 0>>(),
            .mesh = "sphere",
            .camera = {.position = {2.9f, 2.9f, -5.1f}},
            .draw = [](const Scene& s) {
                drawAll<MeshTangents, Swizzle, Udn, GpuGems3, Whiteout, Reoriented, CotangentFrame, CrossProducts>(s);
                s.cutStrip(0.0f, 1.0f);
                s.note("degrees at a tilt of 45 and a slope of 0.5: maximum and RMS to each truth");
                for (const MethodError& e : triplanarErrors(45.0f, 0.5f)) s.note(formatted(e));
            }};
}

}  // namespace relief::samples
