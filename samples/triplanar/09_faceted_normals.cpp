// 4.09 Faceted normals: Normal Mapping for a Triplanar Shader, "Screen Space Partial Derivatives"
// New: the normal of the triangle itself, from how the position changes from pixel to pixel.
// Was: the interpolated normal, and frames about it (4.08).
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

template <bool FACETED>  // new
struct MyFragmentProgram : TriplanarMaterial {
    UnityLight light = sun(35.0f, 60.0f);  // new
    sampler2D mainTex = albedo(kNone);     // new

    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const {
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);
        float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);
        float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);

        tnormalX = float3(tnormalX.xy() + i.worldNormal.zy(), abs(tnormalX.z) * i.worldNormal.x);  // new
        tnormalY = float3(tnormalY.xy() + i.worldNormal.xz(), abs(tnormalY.z) * i.worldNormal.y);  // new
        tnormalZ = float3(tnormalZ.xy() + i.worldNormal.xy(), abs(tnormalZ.z) * i.worldNormal.z);  // new

        return normalize(tnormalX.zyx() * blend.x + tnormalY.xzy() * blend.y + tnormalZ.xyz() * blend.z);  // new
    }

    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        if constexpr (FACETED) i.worldNormal = normalize(cross(ddx(i.worldPos), ddy(i.worldPos)));  // new

        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();

        const float3 normal = WorldNormal(i, uv, blend);
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

template <bool FACETED>                                                                        // new
void drawObjects(const Scene& s) {                                                             // new
    for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram<FACETED>>(o);  // new
}

}  // namespace

Stage triplanar_09_faceted_normals() {
    return {.title = "Faceted normals",
            .section = "Screen Space Partial Derivatives",
            .news = "The triangle's own normal from two differences (right), instead of the interpolated one (left).",
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
