// 4.10 Cross product tangents: Normal Mapping for a Triplanar Shader, "Cross Product Tangent Reconstruction"
// New: for each plane tangent and binormal from cross products of the normal and an axis.
// Was: from differences between pixels (4.08).
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
        const float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);  // new
        const float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);  // new
        const float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);  // new

        const float3 side = axisSign(i.worldNormal);                         // new
        const float3 N = i.worldNormal;                                      // new
        const float3 tangentX = normalize(cross(N, float3(0, side.x, 0)));   // new
        const float3 tangentY = normalize(cross(N, float3(0, 0, side.y)));   // new
        const float3 tangentZ = normalize(cross(N, float3(0, -side.z, 0)));  // new
        const float3 bitangentX = normalize(cross(tangentX, N)) * side.x;    // new
        const float3 bitangentY = normalize(cross(tangentY, N)) * side.y;    // new
        const float3 bitangentZ = normalize(cross(tangentZ, N)) * -side.z;   // new

        return normalize(mul(float3x3(tangentX, bitangentX, N), tnormalX) * blend.x +  // new
                         mul(float3x3(tangentY, bitangentY, N), tnormalY) * blend.y +  // new
                         mul(float3x3(tangentZ, bitangentZ, N), tnormalZ) * blend.z);  // new
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

Stage triplanar_10_cross_product_tangents() {
    return {.title = "Cross product tangents",
            .section = "Cross Product Tangent Reconstruction",
            .news = "Tangent and binormal of each plane from cross products, as if the mesh had been mapped that way.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "cube+sphere",
            .cubesTurnedBy = 0.0f,
            .camera = {.position = {1.1f, 1.1f, -2.1f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples
