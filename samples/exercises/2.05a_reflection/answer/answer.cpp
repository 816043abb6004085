// 2.05a The mirrored ray: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION clipPosition;
    TEXCOORD<0, float2> textureCoordinates;
    TEXCOORD<1, float3> tangentWorld;
    TEXCOORD<2, float3> binormalWorld;
    TEXCOORD<3, float3> normalWorld;
    TEXCOORD<4, float3> position;  // in world space
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.normalWorld = UnityObjectToWorldNormal(object, v.normal);
        i.binormalWorld = normalize(cross(i.normalWorld, i.tangentWorld) * v.tangent.w);

        i.position = mul(object.worldFromObject, v.position).xyz();
        i.textureCoordinates = v.uv;
        i.clipPosition = UnityObjectToClipPos(object, v.position);
        return i;
    }
};

struct MyFragmentProgram : PhongMaterial {
    float4 operator()(Interpolators i) const {
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));
        localCoords.z = sqrt(1.0f - saturate(dot(localCoords, localCoords)));

        float3x3 localSurface2World = {i.tangentWorld, i.binormalWorld, i.normalWorld};
        const float3 normalDirection = normalize(mul(localSurface2World, localCoords));
        const float3 viewDirection = normalize(worldSpaceCameraPos - i.position);
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const Float attenuation = 1.0f;

        const float3 ambientLighting = ambient * color.xyz();
        const Float NdotL = dot(normalDirection, lightDirection);
        const float3 diffuseReflection = lightColor0 * color.xyz() * (attenuation * max(Float(0.0f), NdotL));

        // your turn: the direction in which a mirror sends the light
        const float3 mirrored = 2.0f * NdotL * normalDirection - lightDirection;
        // end of your turn
        const Float RdotV = saturate(dot(mirrored, viewDirection));
        const Float cut = select(NdotL < 0.0f, Float(0.0f), select(tutorialForm > 0.0f, Float(1.0f), NdotL));
        const float3 specularReflection = lightColor0 * specColor.xyz() * (attenuation * pow(RdotV, shininess) * cut);
        return float4(ambientLighting + diffuseReflection + specularReflection, 1);
    }
};

}  // namespace

Stage exercise_2_05a() {
    return {.title = "The mirrored ray",
            .section = "",
            .news = "An exercise of stage 2.05.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.35f, -1.75f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples
