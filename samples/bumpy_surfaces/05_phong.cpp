// 2.05 Phong: GLSL Programming/Unity "Lighting of Bumpy Surfaces", the complete shader, first pass
// New: ambient light and a highlight.
// Was: diffuse light only (2.01 to 2.04).
#include "common/stage.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION clipPosition;
    TEXCOORD<0, float2> textureCoordinates;
    TEXCOORD<1, float3> tangentWorld;
    TEXCOORD<2, float3> binormalWorld;
    TEXCOORD<3, float3> normalWorld;
    TEXCOORD<4, float3> position;  // in world space
};

struct MyVertexProgram
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
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

struct MyFragmentProgram
{
    sampler2D bumpMap;
    float4 bumpMap_ST, color, specColor;
    Float shininess, tutorialForm;
    float3 worldSpaceCameraPos, ambient;
    float4 worldSpaceLightPos0;  // w: 0 for a direction
    float3 lightColor0;

    float4 operator()(Interpolators i) const
    {
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

        const Float RdotV = saturate(dot(reflect(-lightDirection, normalDirection), viewDirection));
        const Float cut = select(NdotL < 0.0f, Float(0.0f), select(tutorialForm > 0.0f, Float(1.0f), NdotL));
        const float3 specularReflection = lightColor0 * specColor.xyz() * (attenuation * pow(RdotV, shininess) * cut);
        return float4(ambientLighting + diffuseReflection + specularReflection, 1);
    }
};

}  // namespace

Stage bumpy_surfaces_05_phong()
{
    return {.title = "Phong",
            .section = "ForwardBase",
            .news = "Ambient light, diffuse light and a highlight, by the tutorial's formulae.",
            .properties = phongProperties(),
            .inputs = {.mesh = "sphere", .normal = "marble-heights.png", .normalImport = normalMapSettings(0.02f)},
            .camera = {.position = {0.0f, 0.35f, -1.75f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) {
                    s.draw(*o.mesh, MyVertexProgram{s.object(o.worldFromObject)},
                           MyFragmentProgram{s.normalMap, s.vector("bumpMap_ST"), s.vector("color"),
                                             s.vector("specColor"), s.number("shininess"), s.number("tutorialForm"),
                                             s.worldSpaceCameraPos, s.vector("ambient").xyz(),
                                             float4(s.light.dir, Float(0.0f)), s.light.color * s.number("sun")});
                }
            }};
}

}  // namespace relief::samples
