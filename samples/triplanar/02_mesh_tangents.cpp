// 4.02 Mesh tangents: Normal Mapping for a Triplanar Shader, "The Naive Method (aka, just use the mesh tangents)"
// New: bumps from three sides. Wrong: turned to the world by the tangents of the mesh.
// Was: colours only, and the mesh's normals (4.01).
#include "common/stage.h"
#include "shading/triplanar.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
    TEXCOORD<2, float4> worldTangent;
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
        i.worldTangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        return i;
    }
};

struct MyFragmentProgram
{
    Float tiling, bumpScale;
    float3 ambient;
    UnityLight light;
    sampler2D mainTex, normalMap;
    bool asItShouldBe;  // by the method of 4.07

    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const
    {
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);
        const float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);
        const float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);
        const float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);
        if (asItShouldBe) {
            return TriplanarNormal({tnormalX, tnormalY, tnormalZ}, i.worldNormal, blend, BlendNormalsRNM);
        }
        const float3 tnormal = tnormalX * blend.x + tnormalY * blend.y + tnormalZ * blend.z;

        const float3 tangent = i.worldTangent.xyz();
        const float3 binormal = cross(i.worldNormal, tangent) * i.worldTangent.w;
        return normalize(tangent * tnormal.x + binormal * tnormal.y + i.worldNormal * tnormal.z);
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

void drawObjects(const Scene& s, bool asItShouldBe)
{
    for (const Object& o : s.objects) {
        s.draw(*o.mesh, MyVertexProgram{s.object(o.worldFromObject)},
               MyFragmentProgram{s.number("tiling"), s.number("bumpScale"), s.vector("ambient").xyz(), s.light,
                                 s.mainTex, s.normalMap, asItShouldBe});
    }
}

}  // namespace

Stage triplanar_02_mesh_tangents()
{
    Inputs inputs = bricks("sphere");
    inputs.albedo = kNone;
    return {.title = "Mesh tangents",
            .section = "The Naive Method",
            .news = "Wrong on purpose (left): bumps from three sides, turned by the tangents of the mesh's uv.",
            .properties = triplanarProperties(
                {{"show", glm::vec4(0.0f), 0.0f, 2.0f, 1, "0: wrong and right, 1: wrong, 2: right"}}, 90.0f),
            .inputs = inputs,
            .camera = {.position = {-0.9f, 0.9f, 1.5f}},
            .draw = [](const Scene& s) {
                const float show = s.number("show")[0];
                if (show == 0.0f) s.cutCell(0, 2);
                if (show != 2.0f) drawObjects(s, false);
                if (show == 0.0f) s.cutCell(1, 2);
                if (show != 1.0f) drawObjects(s, true);
            }};
}

}  // namespace relief::samples
