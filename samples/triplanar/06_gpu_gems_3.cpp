// 4.06 GPU Gems 3: Normal Mapping for a Triplanar Shader, "Whiteout Blend"; GPU Gems 3, chapter 1
// New: the slopes of all planes are mixed first, and added to the surface's normal once. The same as UDN (4.04).
// Was: whiteout (4.05).
#include "common/stage.h"
#include "common/triplanar_methods.h"
#include "shading/triplanar.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
};

struct MyVertexProgram
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.worldNormal = UnityObjectToWorldNormal(object, v.normal);
        return i;
    }
};

struct MyFragmentProgram
{
    Float tiling, bumpScale;
    float3 ambient;
    UnityLight light;
    sampler2D mainTex, normalMap;

    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const
    {
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        const float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);
        const float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);
        const float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);

        const float3 normalX = float3(0.0f, tnormalX.yx());
        const float3 normalY = float3(tnormalY.x, 0.0f, tnormalY.y);
        const float3 normalZ = float3(tnormalZ.xy(), 0.0f);

        return normalize(normalX * blend.x + normalY * blend.y + normalZ * blend.z + i.worldNormal);
    }

    float4 operator()(Interpolators i) const
    {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();

        const float3 normal = WorldNormal(i, uv, blend);
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

// By how much UDN's normal is another one.
struct ShowDifference
{
    MyFragmentProgram program;
    Float exaggeration;

    float4 operator()(Interpolators i) const
    {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * program.tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> texel = tex2DTriplanar(program.normalMap, uv, blend);
        const Triplanar<float3> bumps = {UnpackScaleNormal(texel.x, program.bumpScale),
                                         UnpackScaleNormal(texel.y, program.bumpScale),
                                         UnpackScaleNormal(texel.z, program.bumpScale)};
        const float3 udn = TriplanarNormal(bumps, i.worldNormal, blend, triplanar::Udn());
        return float4(abs(program.WorldNormal(i, uv, blend) - udn) * exaggeration, 1);
    }
};

}  // namespace

Stage triplanar_06_gpu_gems_3()
{
    return {.title = "GPU Gems 3",
            .section = "Whiteout Blend",
            .news = "UDN with fewer operations (left), and its difference to UDN, a million times enlarged (right).",
            .properties = triplanarProperties(
                {{"show", glm::vec4(0.0f), 0.0f, 2.0f, 1, "0: both, 1: GPU Gems 3, 2: the difference to UDN"},
                 {"exaggeration", glm::vec4(1e6f), 1.0f, 1e7f, 1, "of the difference"}}),
            .inputs = bricks("cube+sphere"),
            .camera = {.position = {1.1f, 1.1f, -2.1f}},
            .draw = [](const Scene& s) {
                const float show = s.number("show")[0];
                for (const Object& o : s.objects) {
                    const MyVertexProgram vertex = {s.object(o.worldFromObject)};
                    const MyFragmentProgram gems = {
                        s.number("tiling"), s.number("bumpScale"), s.vector("ambient").xyz(), s.light, s.mainTex,
                        s.normalMap};
                    if (show == 0.0f) s.cutStrip(0.0f, 0.5f);
                    if (show != 2.0f) s.draw(*o.mesh, vertex, gems);
                    if (show == 0.0f) s.cutStrip(0.5f, 1.0f);
                    if (show != 1.0f) s.draw(*o.mesh, vertex, ShowDifference{gems, s.number("exaggeration")});
                }
            }};
}

}  // namespace relief::samples
