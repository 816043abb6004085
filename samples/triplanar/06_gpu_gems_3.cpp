// 4.06 GPU Gems 3: Normal Mapping for a Triplanar Shader, "Whiteout Blend"; GPU Gems 3, chapter 1
// New: the slopes of all planes are mixed first, and added to the surface's normal once. The same as UDN (4.04).
// Was: whiteout (4.05).
#include "common/stage.h"
#include "common/triplanar_methods.h"
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

        const float3 normalX = float3(0.0f, tnormalX.yx());           // new
        const float3 normalY = float3(tnormalY.x, 0.0f, tnormalY.y);  // new
        const float3 normalZ = float3(tnormalZ.xy(), 0.0f);           // new

        return normalize(normalX * blend.x + normalY * blend.y + normalZ * blend.z + i.worldNormal);  // new
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

// By how much UDN's normal is another one.
struct ShowDifference {         // new
    MyFragmentProgram program;  // new
    Float exaggeration;         // new

    float4 operator()(Interpolators i) const {                                              // new
        i.worldNormal = normalize(i.worldNormal);                                           // new
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * program.tiling);              // new
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);                     // new
        const Triplanar<float4> texel = tex2DTriplanar(program.normalMap, uv, blend);       // new
        const Triplanar<float3> bumps = {UnpackScaleNormal(texel.x, program.bumpScale),     // new
                                         UnpackScaleNormal(texel.y, program.bumpScale),     // new
                                         UnpackScaleNormal(texel.z, program.bumpScale)};    // new
        const float3 udn = TriplanarNormal(bumps, i.worldNormal, blend, triplanar::Udn());  // new
        return float4(abs(program.WorldNormal(i, uv, blend) - udn) * exaggeration, 1);      // new
    }
};

struct Choice : Uniforms {                                                                              // new
    int show = choice("show", 0, {"both", "GPU Gems 3", "the difference to UDN"}, "which of the two");  // new
    Float exaggeration = number("exaggeration", 1e6f, {1, 1e7f}, "of the difference");                  // new
};

}  // namespace

Stage triplanar_06_gpu_gems_3() {
    return {.title = "GPU Gems 3",
            .section = "Whiteout Blend",
            .news = "UDN with fewer operations (left), and its difference to UDN, a million times enlarged (right).",
            .uniforms = declared<MyFragmentProgram, Choice>(),
            .mesh = "cube+sphere",
            .cubesTurnedBy = 0.0f,
            .camera = {.position = {1.1f, 1.1f, -2.1f}},
            .draw = [](const Scene& s) {
                const Choice choice = s.uniforms();
                for (const Object& o : s.objects) {
                    const Uniforms uniforms = s.uniforms(o.worldFromObject);
                    const MyVertexProgram vertex = uniforms;
                    if (choice.show == 0) s.cutStrip(0.0f, 0.5f);
                    if (choice.show != 2) s.draw(*o.mesh, vertex, MyFragmentProgram(uniforms));
                    if (choice.show == 0) s.cutStrip(0.5f, 1.0f);
                    if (choice.show != 1) s.draw(*o.mesh, vertex, ShowDifference{uniforms, choice.exaggeration});
                }
                if (choice.show == 0)
                    s.labelColumns({"GPU Gems 3", "difference to UDN x " + shortNumber(choice.exaggeration[0])});
            }};
}

}  // namespace relief::samples
