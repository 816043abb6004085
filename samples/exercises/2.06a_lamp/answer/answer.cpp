// 2.06a A lamp nearby: the answer of an exercise. The lines between the marks are what the learner writes.
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
        // your turn: the way to the light, and how much of it arrives
        const float3 vertexToLightSource = worldSpaceLightPos0.xyz() - i.position * worldSpaceLightPos0.w;
        const float3 lightDirection = normalize(vertexToLightSource);
        const Float attenuation =
            select(worldSpaceLightPos0.w == 0.0f, Float(1.0f), 1.0f / length(vertexToLightSource));
        // end of your turn

        const float3 ambientLighting = ambient * color.xyz();
        const Float NdotL = dot(normalDirection, lightDirection);
        const float3 diffuseReflection = lightColor0 * color.xyz() * (attenuation * max(Float(0.0f), NdotL));

        const Float RdotV = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));
        const Float cut = select(NdotL < 0.0f, Float(0.0f), select(tutorialForm > 0.0f, Float(1.0f), NdotL));
        const float3 specularReflection = lightColor0 * specColor.xyz() * (attenuation * pow(RdotV, shininess) * cut);
        return float4(ambientLighting + diffuseReflection + specularReflection, 1);
    }
};

struct Lamp : Uniforms {
    Float strength = number("lamp", 0.4f, {0, 8}, "strength of the point light");
    float3 position = vector("lampPosition", glm::vec3(-0.8f, 0.1f, -0.6f), {-8, 8}, "in the world");
};

// For additional light sources: added where the depth of the first pass is seen.
constexpr RenderState kForwardAdd = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

}  // namespace

Stage exercise_2_06a() {
    return {.title = "A lamp nearby",
            .section = "",
            .news = "An exercise of stage 2.06.",
            .uniforms = declared<MyFragmentProgram, Lamp>(),
            .mesh = "sphere+quad",
            .camera = {.position = {0.0f, 0.9f, -2.3f}},
            .draw = [](const Scene& s) {
                const Lamp lamp = s.uniforms();
                for (const Object& o : s.objects) {
                    const MyVertexProgram vertex = s.uniforms(o.worldFromObject);
                    MyFragmentProgram fragment = s.uniforms(o.worldFromObject);
                    s.draw(*o.mesh, vertex, fragment);
                    fragment.ambient = float3(0.0f);
                    fragment.worldSpaceLightPos0 = float4(lamp.position, 1.0f);
                    fragment.lightColor0 = float3(0.25f, 0.5f, 1.0f) * lamp.strength;
                    s.draw(*o.mesh, vertex, fragment, kForwardAdd);
                }
            }};
}

}  // namespace relief::samples
