// 3.01 One minus half dot: UnityCookie, part 7, "Fragment program"
// New: a normal's z without a root: 1 - 0.5 * (x^2 + y^2); and light as Phong has it.
// Was: z = sqrt(1 - x^2 - y^2), and metallic and smoothness (1.21).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct vertexInput {
    POSITION vertex;
    NORMAL normal;
    TEXCOORD<0, float4> texcoord;
    TANGENT tangent;
};

struct vertexOutput {
    SV_POSITION pos;
    TEXCOORD<0, float4> tex;
    TEXCOORD<1, float4> posWorld;
    TEXCOORD<2, float3> tangentWorld;
    TEXCOORD<3, float3> normalWorld;
    TEXCOORD<4, float3> binormalWorld;
};

struct vert : Uniforms {
    vertexOutput operator()(vertexInput v) const {
        vertexOutput o;
        o.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        o.normalWorld = UnityObjectToWorldNormal(object, v.normal);
        o.binormalWorld = normalize(cross(o.normalWorld, o.tangentWorld) * v.tangent.w);
        o.posWorld = mul(object.worldFromObject, v.vertex);
        o.pos = UnityObjectToClipPos(object, v.vertex);
        o.tex = v.texcoord;
        return o;
    }
};

struct frag : CgMaterial {
    float4 operator()(vertexOutput i) const {
        const float3 viewDirection = normalize(worldSpaceCameraPos - i.posWorld.xyz());
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const Float atten = 1.0f;

        const float4 texN = tex2D(bumpMap, bumpMap_ST.xy() * i.tex.xy() + bumpMap_ST.zw());
        float3 localCoords = float3(2.0f * texN.ag() - 1.0f, 0.0f);
        localCoords.z = 1.0f - 0.5f * dot(localCoords, localCoords);
        const float3 normalDirection =
            normalize(localCoords.x * i.tangentWorld + localCoords.y * i.binormalWorld + localCoords.z * i.normalWorld);

        const float3 diffuseReflection = atten * lightColor0 * saturate(dot(normalDirection, lightDirection));
        const Float highlight = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));
        const float3 specularReflection = diffuseReflection * specColor.rgb() * pow(highlight, shininess);

        const float3 lightFinal = ambient + diffuseReflection + specularReflection;
        return float4(lightFinal * color.rgb(), 1.0f);
    }
};

}  // namespace

Stage normal_maps_01_one_minus_half_dot() {
    return {.title = "One minus half dot",
            .section = "7, fragment program",
            .news = "A normal map's z without a root, and a sphere in Phong's light.",
            .uniforms = declared<frag>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.3f, -1.8f}},
            .draw = [](const Scene& s) { s.draw<vert, frag>(s.objects[0]); }};
}

}  // namespace relief::samples
