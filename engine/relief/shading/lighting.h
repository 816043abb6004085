// Unity's metallic workflow and its physically based lighting model, as the tutorials call them: GGX specular, Disney
// diffuse, Schlick's Fresnel. Formulae of Unity's built-in shaders (UnityStandardBRDF.cginc, MIT) in two forms: the
// tutorials' own, and an exact one. All colours are linear; directions are unit vectors.
#pragma once

#include "relief/hlsl/intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

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
// Returns the diffuse colour. metallic is clamped to 0 ... 1.
inline float3 DiffuseAndSpecularFromMetallic(const float3& albedo, Float metallic, float3& specColor,
                                             Float& oneMinusReflectivity)
{
    const Float metal = saturate(metallic);
    specColor = lerp(float3(kDielectricSpecular), albedo, metal);
    oneMinusReflectivity = (1.0f - kDielectricSpecular) * (1.0f - metal);
    return albedo * oneMinusReflectivity;
}

inline Float Pow5(Float x)
{
    const Float square = x * x;
    return square * square * x;
}

namespace detail {

// The angles of one light that both forms of the model need.
struct LightingAngles
{
    Float NdotL, NdotV, NdotH, LdotH;
};

// Disney's diffuse model, without its 1 / pi.
inline Float disneyDiffuse(const LightingAngles& angles, Float perceptualRoughness)
{
    const Float fd90 = 0.5f + 2.0f * angles.LdotH * angles.LdotH * perceptualRoughness;
    const Float lightScatter = 1.0f + (fd90 - 1.0f) * Pow5(1.0f - angles.NdotL);
    const Float viewScatter = 1.0f + (fd90 - 1.0f) * Pow5(1.0f - angles.NdotV);
    return lightScatter * viewScatter * angles.NdotL;
}

// Schlick's approximation of Fresnel's reflectance.
inline float3 fresnel(const float3& specColor, Float LdotH)
{
    return specColor + (1.0f - specColor) * Pow5(1.0f - LdotH);
}

}  // namespace detail

// Unity's BRDF1 for one light: what the surface sends to the viewer. smoothness is 0 ... 1; viewDir points to the
// viewer. This is the tutorial-faithful form, epsilons included. The 1e-7 in D is not harmless: above smoothness 0.8 it
// cuts the highlight's peak, to a factor of 0.091 at 0.9 and 0.00016 at 1. UNITY_BRDF_PBS_Exact has none.
inline float4 UNITY_BRDF_PBS(const float3& diffColor, const float3& specColor, Float smoothness, const float3& normal,
                             const float3& viewDir, const UnityLight& light)
{
    const Float perceptualRoughness = 1.0f - saturate(smoothness);
    const float3 sum = light.dir + viewDir;
    const float3 halfDir = sum * (1.0f / sqrt(max(Float(0.001f), dot(sum, sum))));
    const detail::LightingAngles angles = {saturate(dot(normal, light.dir)), abs(dot(normal, viewDir)),
                                           saturate(dot(normal, halfDir)), saturate(dot(light.dir, halfDir))};
    const auto& [NdotL, NdotV, NdotH, LdotH] = angles;

    // Specular: V D F, with the approximate Smith visibility that needs no square root.
    const Float roughness = max(perceptualRoughness * perceptualRoughness, Float(0.002f));
    const Float lambdaV = NdotL * (NdotV * (1.0f - roughness) + roughness);
    const Float lambdaL = NdotV * (NdotL * (1.0f - roughness) + roughness);
    const Float V = 0.5f / (lambdaV + lambdaL + 1e-5f);
    const Float a2 = roughness * roughness;
    const Float d = (NdotH * a2 - NdotH) * NdotH + 1.0f;
    const Float D = a2 / (3.14159265f * (d * d + 1e-7f));
    const Float specularTerm = max(Float(0.0f), V * D * 3.14159265f * NdotL);

    const float3 diffuse = diffColor * detail::disneyDiffuse(angles, perceptualRoughness);
    return float4((diffuse + detail::fresnel(specColor, LdotH) * specularTerm) * light.color, 1.0f);
}

// The same model without epsilons: the half vector is normalised, Smith's joint visibility has its square roots, and
// D = a^2 / (pi d^2) with d = a^2 + (1 - a^2) |N x H|^2. That sum cannot cancel, where 1 - (N.H)^2 loses all its digits
// at the peak. No epsilon is needed: a >= 0.002 keeps d >= 4e-6.
inline float4 UNITY_BRDF_PBS_Exact(const float3& diffColor, const float3& specColor, Float smoothness,
                                   const float3& normal, const float3& viewDir, const UnityLight& light)
{
    const Float perceptualRoughness = 1.0f - saturate(smoothness);
    const float3 halfDir = normalize(light.dir + viewDir);
    const detail::LightingAngles angles = {saturate(dot(normal, light.dir)), saturate(abs(dot(normal, viewDir))),
                                           saturate(dot(normal, halfDir)), saturate(dot(light.dir, halfDir))};
    const auto& [NdotL, NdotV, NdotH, LdotH] = angles;

    const Float roughness = max(perceptualRoughness * perceptualRoughness, Float(0.002f));
    const Float a2 = roughness * roughness;
    const Float lambdaV = NdotL * sqrt(NdotV * NdotV * (1.0f - a2) + a2);
    const Float lambdaL = NdotV * sqrt(NdotL * NdotL * (1.0f - a2) + a2);
    const Float V = 0.5f / (lambdaV + lambdaL);
    const float3 sine = cross(normal, halfDir);
    const Float d = a2 + (1.0f - a2) * min(dot(sine, sine), Float(1.0f));
    const Float D = select(NdotH > 0.0f, a2 / (3.14159265f * d * d), Float(0.0f));
    // Unlit is 0, also where V is 0.5 / 0.
    const Float specularTerm = select(NdotL > 0.0f, V * D * 3.14159265f * NdotL, Float(0.0f));

    const float3 diffuse = diffColor * detail::disneyDiffuse(angles, perceptualRoughness);
    return float4((diffuse + detail::fresnel(specColor, LdotH) * specularTerm) * light.color, 1.0f);
}

}  // namespace relief::inline RELIEF_WIDTH
