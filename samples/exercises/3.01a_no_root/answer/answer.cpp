// 3.01a z without a root: the answer of an exercise. The lines between the marks are what the learner writes.
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
        // your turn: z of the normal, without a root
        localCoords.z = 1.0f - 0.5f * dot(localCoords, localCoords);
        // end of your turn
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

Stage exercise_3_01a() {
    return {.title = "z without a root",
            .section = "",
            .news = "An exercise of stage 3.01.",
            .uniforms = declared<frag>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.3f, -1.8f}},
            .draw = [](const Scene& s) { s.draw<vert, frag>(s.objects[0]); }};
}

}  // namespace relief::samples
