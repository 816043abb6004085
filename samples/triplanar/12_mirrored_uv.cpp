// 4.12 Mirrored uv: Normal Mapping for a Triplanar Shader, "Mirrored UVs"
// New: the planes' pictures shifted against each other, and flipped on the sides that would show them mirrored.
// Was: the same picture on both sides of a plane (4.03 to 4.11).
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

template <bool OFFSET, bool FLIP>
struct MyFragmentProgram : TriplanarMaterial {
    UnityLight light = sun(35.0f, 150.0f);

    // +1, or -1 on the sides that look at a plane from its back: -x, -y and +z in a left-handed world.
    static float3 FlipOf(const float3& normal) { return FLIP ? axisSign(normal) * float3(1, 1, -1) : float3(1.0f); }

    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const {
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);
        float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);
        float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);

        const float3 flip = FlipOf(i.worldNormal);
        tnormalX.x *= flip.x;
        tnormalY.x *= flip.y;
        tnormalZ.x *= flip.z;

        tnormalX = float3(tnormalX.xy() + i.worldNormal.zy(), abs(tnormalX.z) * i.worldNormal.x);
        tnormalY = float3(tnormalY.xy() + i.worldNormal.xz(), abs(tnormalY.z) * i.worldNormal.y);
        tnormalZ = float3(tnormalZ.xy() + i.worldNormal.xy(), abs(tnormalZ.z) * i.worldNormal.z);

        return normalize(tnormalX.zyx() * blend.x + tnormalY.xzy() * blend.y + tnormalZ.xyz() * blend.z);
    }

    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 flip = FlipOf(i.worldNormal);
        uv.x.x *= flip.x;
        uv.y.x *= flip.y;
        uv.z.x *= flip.z;
        if constexpr (OFFSET) {
            uv.y += 0.33f;
            uv.z += 0.67f;
        }

        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();

        const float3 normal = WorldNormal(i, uv, blend);
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

template <bool OFFSET, bool FLIP>
void drawShape(const Scene& s) {
    for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram<OFFSET, FLIP>>(o);
}

}  // namespace

Stage triplanar_12_mirrored_uv() {
    return {.title = "Mirrored uv",
            .section = "Mirrored UVs",
            .news = "Pictures mirrored on three sides of six; planes shifted, sides flipped, and both.",
            .uniforms = declared<MyFragmentProgram<true, true>>(),
            .mesh = "cube",
            .cubesTurnedBy = 0.0f,
            .camera = {.position = {-3.1f, 2.2f, 3.1f}},
            .draw = [](const Scene& s) {
                s.cutCell(0, 4);
                drawShape<false, false>(s);
                s.cutCell(1, 4);
                drawShape<true, false>(s);
                s.cutCell(2, 4);
                drawShape<false, true>(s);
                s.cutCell(3, 4);
                drawShape<true, true>(s);
                s.labelColumns({"wrong: mirrored", "planes shifted", "sides flipped", "both"});
            }};
}

}  // namespace relief::samples
