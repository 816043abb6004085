// 2.05 Phong: GLSL Programming/Unity "Lighting of Bumpy Surfaces", the complete shader, first pass
// New: ambient light and a highlight.
// Was: diffuse light only (2.01 to 2.04).
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
    TEXCOORD<4, float3> position;  // in world space  // new
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.tangentWorld = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.normalWorld = UnityObjectToWorldNormal(object, v.normal);  // new
        i.binormalWorld = normalize(cross(i.normalWorld, i.tangentWorld) * v.tangent.w);

        i.position = mul(object.worldFromObject, v.position).xyz();  // new
        i.textureCoordinates = v.uv;
        i.clipPosition = UnityObjectToClipPos(object, v.position);
        return i;
    }
};

struct MyFragmentProgram : PhongMaterial {      // new
    float4 operator()(Interpolators i) const {  // new
        const float4 encodedNormal = tex2D(bumpMap, TRANSFORM_TEX(i.textureCoordinates, bumpMap_ST));
        float3 localCoords = float3(encodedNormal.wy() * 2.0f - 1.0f, Float(0.0f));
        localCoords.z = sqrt(1.0f - saturate(dot(localCoords, localCoords)));

        float3x3 localSurface2World = {i.tangentWorld, i.binormalWorld, i.normalWorld};
        const float3 normalDirection = normalize(mul(localSurface2World, localCoords));  // new
        const float3 viewDirection = normalize(worldSpaceCameraPos - i.position);        // new
        const float3 lightDirection = normalize(worldSpaceLightPos0.xyz());
        const Float attenuation = 1.0f;  // new

        const float3 ambientLighting = ambient * color.xyz();                                                  // new
        const Float NdotL = dot(normalDirection, lightDirection);                                              // new
        const float3 diffuseReflection = lightColor0 * color.xyz() * (attenuation * max(Float(0.0f), NdotL));  // new

        const Float RdotV = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));           // new
        const Float cut = select(NdotL < 0.0f, Float(0.0f), select(tutorialForm > 0.0f, Float(1.0f), NdotL));  // new
        const float3 specularReflection = lightColor0 * specColor.xyz() * (attenuation * pow(RdotV, shininess) * cut);
        return float4(ambientLighting + diffuseReflection + specularReflection, 1);  // new
    }
};

}  // namespace

Stage bumpy_surfaces_05_phong() {
    return {.title = "Phong",
            .section = "ForwardBase",
            .news = "Ambient light, diffuse light and a highlight, by the tutorial's formulae.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.35f, -1.75f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples
