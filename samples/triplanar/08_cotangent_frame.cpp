// 4.08 Cotangent frame: Normal Mapping for a Triplanar Shader, "Screen Space Partial Derivatives"
// New: a tangent space for each plane, from how position and uv change from pixel to pixel.
// Was: no tangent space at all (4.07).
#include "common/stage.h"
#include "relief/shading/cotangent_frame.h"
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

        tnormalX = mul(cotangent_frame(i.worldNormal, i.worldPos, uv.x), tnormalX);  // new
        tnormalY = mul(cotangent_frame(i.worldNormal, i.worldPos, uv.y), tnormalY);  // new
        tnormalZ = mul(cotangent_frame(i.worldNormal, i.worldPos, uv.z), tnormalZ);  // new

        return normalize(tnormalX * blend.x + tnormalY * blend.y + tnormalZ * blend.z);  // new
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

Stage triplanar_08_cotangent_frame() {
    return {.title = "Cotangent frame",
            .section = "Screen Space Partial Derivatives",
            .news = "A tangent space for each plane, from differences between neighbouring pixels.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "cube+sphere",
            .cubesTurnedBy = 0.0f,
            .camera = {.position = {1.1f, 1.1f, -2.1f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples
