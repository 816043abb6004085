// 4.02 Mesh tangents: Normal Mapping for a Triplanar Shader, "The Naive Method (aka, just use the mesh tangents)"
// New: bumps from three sides. Wrong: turned to the world by the tangents of the mesh.
// Was: colours only, and the mesh's normals (4.01).
#include "common/stage.h"
#include "relief/shading/triplanar.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;  // new
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
    TEXCOORD<2, float4> worldTangent;  // new
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.worldNormal = UnityObjectToWorldNormal(object, v.normal);
        i.worldTangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);  // new
        return i;
    }
};

struct MyFragmentProgram : TriplanarMaterial {
    UnityLight light = sun(35.0f, 90.0f);  // new
    sampler2D mainTex = albedo(kNone);     // new
    bool asItShouldBe = false;             // by the method of 4.07  // new

    float3 WorldNormal(const Interpolators& i, const Triplanar<float2>& uv, const float3& blend) const {    // new
        const Triplanar<float4> texel = tex2DTriplanar(normalMap, uv, blend);                               // new
        const float3 tnormalX = UnpackScaleNormal(texel.x, bumpScale);                                      // new
        const float3 tnormalY = UnpackScaleNormal(texel.y, bumpScale);                                      // new
        const float3 tnormalZ = UnpackScaleNormal(texel.z, bumpScale);                                      // new
        if (asItShouldBe) {                                                                                 // new
            return TriplanarNormal({tnormalX, tnormalY, tnormalZ}, i.worldNormal, blend, BlendNormalsRNM);  // new
        }
        const float3 tnormal = tnormalX * blend.x + tnormalY * blend.y + tnormalZ * blend.z;  // new

        const float3 tangent = i.worldTangent.xyz();                                               // new
        const float3 binormal = cross(i.worldNormal, tangent) * i.worldTangent.w;                  // new
        return normalize(tangent * tnormal.x + binormal * tnormal.y + i.worldNormal * tnormal.z);  // new
    }

    float4 operator()(Interpolators i) const {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos * tiling);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> color = tex2DTriplanar(mainTex, uv, blend);
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();  // new

        const float3 normal = WorldNormal(i, uv, blend);                                        // new
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);  // new
    }
};

struct Choice : Uniforms {                                                                    // new
    int show = choice("show", 0, {"wrong and right", "wrong", "right"}, "which of the two");  // new
};

void drawObjects(const Scene& s, bool asItShouldBe) {  // new
    for (const Object& o : s.objects) {
        MyFragmentProgram fragment = s.uniforms(o.worldFromObject);                 // new
        fragment.asItShouldBe = asItShouldBe;                                       // new
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);  // new
    }
}

}  // namespace

Stage triplanar_02_mesh_tangents() {
    return {.title = "Mesh tangents",
            .section = "The Naive Method",
            .news = "Wrong on purpose (left): bumps from three sides, turned by the tangents of the mesh's uv.",
            .uniforms = declared<MyFragmentProgram, Choice>(),
            .mesh = "sphere",
            .camera = {.position = {-0.9f, 0.9f, 1.5f}},
            .draw = [](const Scene& s) {
                const int show = Choice(s.uniforms()).show;
                if (show == 0) s.cutCell(0, 2);
                if (show != 2) drawObjects(s, false);
                if (show == 0) s.cutCell(1, 2);
                if (show != 1) drawObjects(s, true);
                if (show == 0) s.labelColumns({"wrong: the mesh's tangents", "as it should be"});
            }};
}

}  // namespace relief::samples
