// Where light comes from: directional lights, points and spots, up to four cheap points per vertex, and the
// surroundings as spherical harmonics. Positions and directions are in world space, colours linear with the intensity
// in them. A light becomes a UnityLight, which is what arrives at one point; lighting.h says what the surface does.
//
// Unity's attenuation of points is a texture whose content is not published; ours is the fit that is commonly quoted:
// 1 / (1 + 25 d^2 / r^2), faded to 0 over the last fifth of the range r.
#pragma once

#include <cmath>

#include "relief/mesh/bounds.h"
#include "relief/shading/lighting.h"

namespace relief::inline RELIEF_WIDTH {

struct DirectionalLight
{
    float3 color;
    float3 dir;  // towards the light, unit length
};

struct PointLight
{
    float3 color;
    float3 position;
    Float range;  // beyond it, nothing arrives
};

struct SpotLight
{
    float3 color;
    float3 position;
    Float range;
    float3 axis;     // from the light, unit length
    Float cosOuter;  // of half the cone's angle: 0 at the cone, and 1 ...
    Float cosInner;  // ... within this one
};

namespace detail {

// Unity's clamp: a light inside the surface is no farther than a thousandth from it.
inline constexpr float kSmallestSquare = 1e-6f;

inline Float rangeAttenuation(Float squaredDistance, Float range)
{
    const Float square = max(squaredDistance, Float(kSmallestSquare));
    const Float part = square / (range * range);
    const Float fade = saturate((1.0f - sqrt(part)) * 5.0f);
    return select(fade > 0.0f, fade / (1.0f + 25.0f * part), Float(0.0f));
}

}  // namespace detail

// --- the light that arrives at a point of the world ---

inline UnityLight CreateLight(const DirectionalLight& light, const float3&)
{
    return {light.color, light.dir};
}

// Where the point is the light itself there is no direction: dir is zero, and nothing is lit.
inline UnityLight CreateLight(const PointLight& light, const float3& worldPos)
{
    const float3 lightVec = light.position - worldPos;
    return {light.color * detail::rangeAttenuation(dot(lightVec, lightVec), light.range), normalize(lightVec)};
}

inline UnityLight CreateLight(const SpotLight& light, const float3& worldPos)
{
    const float3 lightVec = light.position - worldPos;
    const float3 dir = normalize(lightVec);
    const Float cosine = -dot(dir, light.axis);
    // In front of the light first: a cone has a mirror image behind it.
    const Float cone = select(cosine > 0.0f, smoothstep(light.cosOuter, light.cosInner, cosine), Float(0.0f));
    return {light.color * (detail::rangeAttenuation(dot(lightVec, lightVec), light.range) * cone), dir};
}

// --- whether a light can reach anything within bounds in world space: if not, its pass need not be drawn ---

inline bool lightReaches(const DirectionalLight&, const Bounds&)
{
    return true;
}

inline bool lightReaches(const PointLight& light, const Bounds& world)
{
    const glm::vec3 position = {light.position.x[0], light.position.y[0], light.position.z[0]};
    return world.squaredDistance(position) < light.range[0] * light.range[0];
}

// By the sphere around the bounds: a cone misses it if the sphere's centre is farther than its radius from the cone's
// side or behind its tip. Never says no where light arrives.
inline bool lightReaches(const SpotLight& light, const Bounds& world)
{
    const PointLight sphere = {light.color, light.position, light.range};
    if (!lightReaches(sphere, world)) return false;
    const float cosine = light.cosOuter[0];
    const float sine = std::sqrt(1.0f - cosine * cosine);
    float along = 0.0f, square = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const float v = world.centre()[i] - light.position[i][0];
        along += v * light.axis[i][0];
        square += v * v;
    }
    const float radius = world.radius() * 1.0001f;
    const float across = std::sqrt(square > along * along ? square - along * along : 0.0f);
    return across * cosine - along * sine <= radius && along >= -radius;
}

// --- lights per vertex (VERTEXLIGHT_ON) ---

// Four point lights; one that is not used is black.
struct VertexLights
{
    float4 positionX, positionY, positionZ;
    float4 attenSq;  // 25 / range^2
    float3 color[4];
};

// The diffuse light of four points at a vertex, as Unity's Shade4PointLights: at its range a light still has 1/26 of
// its strength, and pops when Unity stops counting it. `window` fades it to 0 there, as the lights per pixel.
inline float3 Shade4PointLights(const VertexLights& lights, const float3& pos, const float3& normal,
                                bool window = false)
{
    float3 sum(Float(0.0f));
    for (int i = 0; i < 4; ++i) {
        const float3 toLight = float3(lights.positionX[i], lights.positionY[i], lights.positionZ[i]) - pos;
        const Float lengthSq = max(dot(toLight, toLight), Float(detail::kSmallestSquare));
        const Float ndotl = max(Float(0.0f), dot(toLight, normal) * (1.0f / sqrt(lengthSq)));
        const Float part = lengthSq * lights.attenSq[i];
        Float attenuation = 1.0f / (1.0f + part);
        if (window) attenuation = attenuation * saturate((1.0f - sqrt(part * 0.04f)) * 5.0f);
        sum += lights.color[i] * (ndotl * attenuation);
    }
    return sum;
}

// --- the surroundings ---

// Nine coefficients a colour, in Unity's order (unity_SHAr ... unity_SHC).
struct SphericalHarmonics
{
    float4 A[3];  // for red, green, blue: of x, y, z and 1
    float4 B[3];  // of xy, yz, zz and zx
    float3 C;     // of x^2 - y^2
};

// The light that arrives from around a unit normal, as Unity's ShadeSH9; never negative.
inline float3 ShadeSH9(const SphericalHarmonics& sh, const float3& normal)
{
    const float4 linear = float4(normal, 1.0f);
    const float4 quadratic = {normal.x * normal.y, normal.y * normal.z, normal.z * normal.z, normal.z * normal.x};
    const Float difference = normal.x * normal.x - normal.y * normal.y;
    float3 r;
    for (int c = 0; c < 3; ++c)
        r[c] = max(Float(0.0f), dot(sh.A[c], linear) + dot(sh.B[c], quadratic) + sh.C[c] * difference);
    return r;
}

// Surroundings in which exactly `sky` arrives from above, `ground` from below and `equator` at every upright surface:
// equator + (sky - ground) / 2 * y + ((sky + ground) / 2 - equator) * y^2, with y^2 = (1 - z^2 - (x^2 - y^2)) / 2.
SphericalHarmonics gradientSurroundings(const glm::vec3& sky, const glm::vec3& equator, const glm::vec3& ground);

}  // namespace relief::inline RELIEF_WIDTH
