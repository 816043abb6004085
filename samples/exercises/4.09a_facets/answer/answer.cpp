// 4.09a The normal of a triangle: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"
#include "relief/hlsl/derivatives.h"
#include "relief/shading/triplanar.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.worldNormal = UnityObjectToWorldNormal(object, v.normal);
        return i;
    }
};

template <bool FACETED>
struct MyFragmentProgram : TriplanarMaterial {
    UnityLight light = sun(35.0f, 60.0f);
    sampler2D mainTex = albedo(kNone);

    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const {
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);
        float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);
        float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);

        tnormalX = float3(tnormalX.xy() + i.worldNormal.zy(), abs(tnormalX.z) * i.worldNormal.x);
        tnormalY = float3(tnormalY.xy() + i.worldNormal.xz(), abs(tnormalY.z) * i.worldNormal.y);
        tnormalZ = float3(tnormalZ.xy() + i.worldNormal.xy(), abs(tnormalZ.z) * i.worldNormal.z);

        return normalize(tnormalX.zyx() * blend.x + tnormalY.xzy() * blend.y + tnormalZ.xyz() * blend.z);
    }

    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        // your turn: the normal of the triangle that this pixel lies on
        if constexpr (FACETED) i.worldNormal = normalize(cross(ddx(i.worldPos), ddy(i.worldPos)));
        // end of your turn

        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();

        const float3 normal = WorldNormal(i, uv, blend);
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

template <bool FACETED>
void drawObjects(const Scene& s) {
    for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram<FACETED>>(o);
}

}  // namespace

Stage exercise_4_09a() {
    return {.title = "The normal of a triangle",
            .section = "",
            .news = "An exercise of stage 4.09.",
            .uniforms = declared<MyFragmentProgram<true>>(),
            .mesh = "low-sphere",
            .camera = {.position = {0.9f, 0.9f, -1.7f}},
            .draw = [](const Scene& s) {
                s.cutCell(0, 2);
                drawObjects<false>(s);
                s.cutCell(1, 2);
                drawObjects<true>(s);
                s.labelColumns({"interpolated normal", "the triangle's normal"});
            }};
}

}  // namespace relief::samples
