// 3.04b Moonlight: the answer of an exercise. The lines between the marks are what the learner writes.
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
    float4 rimColor = rgba("rimColor", glm::vec4(1.0f), "Rim Color");
    Float rimPower = number("rimPower", 3.0f, {0.1f, 10}, "Rim Power: larger is narrower");
    Float bumpDepth = number("bumpDepth", 1.0f, {0, 8}, "z of all normals; 0 is the bumpiest");

    float4 operator()(vertexOutput i) const {
        const float3 viewDirection = normalize(worldSpaceCameraPos - i.posWorld.xyz());
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const Float atten = 1.0f;

        const float4 texN = tex2D(bumpMap, bumpMap_ST.xy() * i.tex.xy() + bumpMap_ST.zw());
        float3 localCoords = float3(2.0f * texN.ag() - 1.0f, 0.0f);
        localCoords.z = bumpDepth;
        const float3x3 local2WorldTranspose = transpose(float3x3(i.tangentWorld, i.binormalWorld, i.normalWorld));
        const float3 normalDirection = normalize(mul(localCoords, local2WorldTranspose));

        const float3 diffuseReflection = atten * lightColor0 * saturate(dot(normalDirection, lightDirection));
        const Float highlight = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));
        const float3 specularReflection = diffuseReflection * specColor.rgb() * pow(highlight, shininess);
        const Float rim = 1.0f - saturate(dot(viewDirection, normalDirection));
        const float3 rimLighting = saturate(dot(normalDirection, lightDirection)) * rimColor.rgb() * pow(rim, rimPower);
        const float3 lightFinal = ambient + diffuseReflection + specularReflection + rimLighting;
        float3 shown = lightFinal * color.rgb();
        // your turn: the colour of moonlight
        shown = shown * float3(0.15f, 0.22f, 0.4f) + rimLighting * float3(0.2f, 0.4f, 0.9f);
        // end of your turn
        return float4(shown, 1.0f);
    }
};

}  // namespace

Stage exercise_3_04b() {
    return {.title = "Moonlight",
            .section = "",
            .news = "An exercise of stage 3.04.",
            .uniforms = declared<frag>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.3f, -1.8f}},
            .draw = [](const Scene& s) { s.draw<vert, frag>(s.objects[0]); }};
}

}  // namespace relief::samples
