// The materials that tutorials begin with: uniforms that all of a chapter's stages have. What a chapter adds to them
// stands in its stages.
#pragma once

#include "common/uniforms.h"

namespace relief::samples {

// Rendering 5's, on which all of Rendering 6, "Bumpiness", builds.
struct LitMaterial : Uniforms
{
    float4 tint = rgba("tint", glm::vec4(1.0f), "colour that the albedo is multiplied by");
    sampler2D mainTex = albedo(kNone);
    float4 mainTex_ST = vector("mainTex_ST", {1, 1, 0, 0}, {-16, 16}, "tiling in x and y, offset in z and w");
    Float metallic = number("metallic", 0.0f, {0, 1}, "0 dielectric, 1 metal");
    Float smoothness = number("smoothness", 0.1f, {0, 1}, "0 matte, 1 polished");
    UnityLight light = sun(35.0f, -20.0f);
};

// The same with what its chapter has added by section 4: a normal map, detail and detail normals.
struct DetailedMaterial : LitMaterial
{
    sampler2D normalMap = normals(kNone);
    Float bumpScale = number("bumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    sampler2D detailTex = detail(kNone, kFadedOut);
    float4 detailTex_ST = vector("detailTex_ST", {3, 3, 0, 0}, {-64, 64}, "tiling and offset of both detail textures");
    sampler2D detailNormalMap = detailNormals(kNone, normalMapSettings(0.1f, true));
    Float detailBumpScale = number("detailBumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");
};

// DetailedMaterial in marble.
struct DetailedMarble : DetailedMaterial
{
    sampler2D mainTex = albedo("marble-albedo.png");
    sampler2D normalMap = normals("marble-heights.png");
    sampler2D detailTex = detail("marble-detail.png", kFadedOut);
    sampler2D detailNormalMap = detailNormals("marble-detail.png", normalMapSettings(0.1f, true));
};

// "Lighting of Bumpy Surfaces", without and with a highlight.
struct DiffuseMaterial : Uniforms
{
    float4 color = rgba("color", glm::vec4(1.0f), "diffuse material colour");
    sampler2D bumpMap = normals("marble-heights.png", normalMapSettings(0.02f));
    float4 bumpMap_ST = vector("bumpMap_ST", {1, 1, 0, 0}, {-16, 16}, "tiling in x and y, offset in z and w");
    UnityLight light = sun(35.0f, -20.0f);
    float4 worldSpaceLightPos0 = float4(light.dir, 0.0f);  // of a directional light: w is 0
    float3 lightColor0 = light.color;
};

struct PhongMaterial : DiffuseMaterial
{
    float4 specColor = rgba("specColor", glm::vec4(1.0f), "specular material colour");
    Float shininess = number("shininess", 10.0f, {0, 1000}, "exponent of the highlight; the higher, the smaller");
    float3 lightColor0 = light.color * number("sun", 0.5f, {0, 8}, "strength of the directional light");
    float3 ambient = rgb("ambient", glm::vec3(0.033f), "light from everywhere");
    Float tutorialForm = toggle("tutorialForm", false, "1: the highlight without N.L, and cut") ? 1.0f : 0.0f;
};

// "Normal Maps".
struct CgMaterial : Uniforms
{
    float4 color = rgba("color", glm::vec4(1.0f), "Color Tint: what all light is multiplied by");
    float4 specColor = rgba("specColor", glm::vec4(1.0f), "Specular Color");
    Float shininess = number("shininess", 10.0f, {0, 1000}, "exponent of the highlight; larger is smaller");
    sampler2D bumpMap = normals("marble-heights.png");
    float4 bumpMap_ST = vector("bumpMap_ST", {1, 1, 0, 0}, {-16, 16}, "tiling in x and y, offset in z and w");
    float3 ambient = rgb("ambient", glm::vec3(0.05f), "the scene's ambient light");
    Float lightStrength = number("lightStrength", 0.5f, {0, 16}, "of the directional light");
    UnityLight light = sun(35.0f, -75.0f);
    float4 worldSpaceLightPos0 = float4(light.dir, 0.0f);  // of a directional light: w is 0
    float3 lightColor0 = light.color * lightStrength;
};

// "Normal Mapping for a Triplanar Shader": bricks, each with a letter cut into it, so that every turn and every
// mirroring of the picture shows.
struct TriplanarMaterial : Uniforms
{
    sampler2D mainTex = albedo("bricks-albedo.png");
    sampler2D normalMap = normals("bricks-heights.png", normalMapSettings(0.04f));
    Float tiling = number("tiling", 1.0f, {0, 64}, "how often the texture repeats per unit of the world");
    Float bumpScale = number("bumpScale", 1.0f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    float3 ambient = rgb("ambient", glm::vec3(0.05f), "light from everywhere");
    UnityLight light = sun(35.0f, -40.0f);
};

// Chapter 5's bricks, whose heights move what is seen.
struct ParallaxMaterial : Uniforms
{
    sampler2D mainTex = albedo("bricks-albedo.png");
    sampler2D normalMap = normals("bricks-heights.png", normalMapSettings(0.04f));
    sampler2D heightMap = heights("bricks-heights.png");
    Float parallaxStrength = number("parallaxStrength", 0.06f, {0, 0.25f}, "from the lowest to the highest, in uv");
    Float bumpScale = number("bumpScale", 1.0f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    float3 ambient = rgb("ambient", glm::vec3(0.08f), "light from everywhere");
    UnityLight light = sun(40.0f, -60.0f);
};

// Plain stone with bumps, and what its shadows fall on.
struct StoneMaterial : Uniforms
{
    float4 tint = rgba("tint", {0.8f, 0.78f, 0.74f, 1.0f}, "the surfaces' colour");
    sampler2D normalMap = normals("marble-heights.png");
    Float bumpScale = number("bumpScale", 1.0f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    float3 ambient = rgb("ambient", glm::vec3(0.08f), "light from everywhere");
    UnityLight light = sun(38.0f, -50.0f);
};

}  // namespace relief::samples
