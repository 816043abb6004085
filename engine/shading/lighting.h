// Unity's metallic workflow and its physically based lighting model, as the tutorials call them: GGX specular, Disney
// diffuse, Schlick's Fresnel. Formulae of Unity's built-in shaders (UnityStandardBRDF.cginc, MIT), with the epsilons
// that they have: the tutorial-faithful form. All colours are linear; directions are unit vectors.
#pragma once

#include "hlsl/intrinsics.h"

namespace relief {

// A light as it arrives at a point.
struct UnityLight
{
    float3 color;  // linear, attenuation included
    float3 dir;    // from the surface to the light
};

// The share of light that a dielectric reflects head on.
inline constexpr float kDielectricSpecular = 0.04f;

// Unity's unity_ColorSpaceDouble: what brings a detail texture's middle grey, sRGB 0.5, to a factor near 1 in linear
// colour.
inline constexpr float unity_ColorSpaceDouble = 4.59479380f;

// Splits a material's colour between diffuse and specular, so that the two together never reflect more than arrives.
// Returns the diffuse colour. metallic is 0 ... 1.
inline float3 DiffuseAndSpecularFromMetallic(const float3& albedo, Float metallic, float3& specColor,
                                             Float& oneMinusReflectivity)
{
    specColor = lerp(float3(kDielectricSpecular), albedo, metallic);
    oneMinusReflectivity = (1.0f - kDielectricSpecular) * (1.0f - metallic);
    return albedo * oneMinusReflectivity;
}

inline Float Pow5(Float x)
{
    const Float square = x * x;
    return square * square * x;
}

// Unity's BRDF1 for one light: what the surface sends to the viewer. smoothness is 0 ... 1; viewDir points to the
// viewer.
inline float4 UNITY_BRDF_PBS(const float3& diffColor, const float3& specColor, Float smoothness, const float3& normal,
                             const float3& viewDir, const UnityLight& light)
{
    const Float perceptualRoughness = 1.0f - saturate(smoothness);
    const float3 sum = light.dir + viewDir;
    const float3 halfDir = sum * (1.0f / sqrt(max(Float(0.001f), dot(sum, sum))));

    const Float NdotV = abs(dot(normal, viewDir));
    const Float NdotL = saturate(dot(normal, light.dir));
    const Float NdotH = saturate(dot(normal, halfDir));
    const Float LdotH = saturate(dot(light.dir, halfDir));

    // Diffuse: Disney's model without its 1 / pi.
    const Float fd90 = 0.5f + 2.0f * LdotH * LdotH * perceptualRoughness;
    const Float lightScatter = 1.0f + (fd90 - 1.0f) * Pow5(1.0f - NdotL);
    const Float viewScatter = 1.0f + (fd90 - 1.0f) * Pow5(1.0f - NdotV);
    const Float diffuseTerm = lightScatter * viewScatter * NdotL;

    // Specular: V D F, with the approximate Smith visibility that needs no square root.
    const Float roughness = max(perceptualRoughness * perceptualRoughness, Float(0.002f));
    const Float lambdaV = NdotL * (NdotV * (1.0f - roughness) + roughness);
    const Float lambdaL = NdotV * (NdotL * (1.0f - roughness) + roughness);
    const Float V = 0.5f / (lambdaV + lambdaL + 1e-5f);
    const Float a2 = roughness * roughness;
    const Float d = (NdotH * a2 - NdotH) * NdotH + 1.0f;
    const Float D = a2 / (3.14159265f * (d * d + 1e-7f));
    const Float specularTerm = max(Float(0.0f), V * D * 3.14159265f * NdotL);
    const float3 F = specColor + (1.0f - specColor) * Pow5(1.0f - LdotH);

    const float3 color = (diffColor * diffuseTerm + F * specularTerm) * light.color;
    return float4(color, 1.0f);
}

}  // namespace relief
