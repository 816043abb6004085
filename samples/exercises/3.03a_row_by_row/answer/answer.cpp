// 3.03a Row by row: the answer of an exercise. The lines between the marks are what the learner writes.
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
    Float bumpDepth = number("bumpDepth", 1.0f, {0, 8}, "z of all normals; 0 is the bumpiest");

    float4 operator()(vertexOutput i) const {
        const float3 viewDirection = normalize(worldSpaceCameraPos - i.posWorld.xyz());
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const Float atten = 1.0f;

        const float4 texN = tex2D(bumpMap, bumpMap_ST.xy() * i.tex.xy() + bumpMap_ST.zw());
        float3 localCoords = float3(2.0f * texN.ag() - 1.0f, 0.0f);
        localCoords.z = bumpDepth;
        // your turn: the normal in the world
        const float3x3 local2WorldTranspose = transpose(float3x3(i.tangentWorld, i.binormalWorld, i.normalWorld));
        const float3 normalDirection = normalize(mul(localCoords, local2WorldTranspose));
        // end of your turn

        const float3 diffuseReflection = atten * lightColor0 * saturate(dot(normalDirection, lightDirection));
        const Float highlight = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));
        const float3 specularReflection = diffuseReflection * specColor.rgb() * pow(highlight, shininess);

        const float3 lightFinal = ambient + diffuseReflection + specularReflection;
        return float4(lightFinal * color.rgb(), 1.0f);
    }
};

}  // namespace

Stage exercise_3_03a() {
    return {.title = "Row by row",
            .section = "",
            .news = "An exercise of stage 3.03.",
            .uniforms = declared<frag>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.3f, -1.8f}},
            .draw = [](const Scene& s) { s.draw<vert, frag>(s.objects[0]); }};
}

}  // namespace relief::samples
