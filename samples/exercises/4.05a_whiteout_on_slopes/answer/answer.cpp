// 4.05a Bumps that stay steep: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"
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

struct MyFragmentProgram : TriplanarMaterial {
    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const {
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);
        float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);
        float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);

        // your turn: x and y added, z multiplied
        tnormalX = float3(tnormalX.xy() + i.worldNormal.zy(), abs(tnormalX.z) * i.worldNormal.x);
        tnormalY = float3(tnormalY.xy() + i.worldNormal.xz(), abs(tnormalY.z) * i.worldNormal.y);
        tnormalZ = float3(tnormalZ.xy() + i.worldNormal.xy(), abs(tnormalZ.z) * i.worldNormal.z);
        // end of your turn

        return normalize(tnormalX.zyx() * blend.x + tnormalY.xzy() * blend.y + tnormalZ.xyz() * blend.z);
    }

    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();

        const float3 normal = WorldNormal(i, uv, blend);
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

}  // namespace

Stage exercise_4_05a() {
    return {.title = "Bumps that stay steep",
            .section = "",
            .news = "An exercise of stage 4.05.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "cube+sphere",
            .cubesTurnedBy = 0.0f,
            .camera = {.position = {1.1f, 1.1f, -2.1f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples
