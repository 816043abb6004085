// Parallax mapping: how far the picture of a surface has to be moved so that its heights seem real. A ray of sight
// meets the flat surface at some uv; these functions say where it meets the heights, as an offset to that uv.
//
// viewDir points to the viewer, in tangent space, and has any length. strength is the distance from the lowest height,
// 0, to the highest, 1, in units of uv. heightAt(offset) gives the height at the flat surface's uv plus the offset; it
// is called in loops that each pixel leaves for itself, so it is to fetch by tex2Dgrad or tex2Dlod.
//
// A direction along the surface, or from below it, has no such point: the offset is 0 there. Above it no offset is
// longer than kMaxParallaxTangent times the strength, and none is NaN. A march ends for any direction and any heights,
// and where there are none, below 0.
//
// How far off each of them is, and what it costs: docs/report/error/E-35.md.
#pragma once

#include "relief/hlsl/intrinsics.h"
#include "relief/shading/loop.h"

namespace relief::inline RELIEF_WIDTH {

inline constexpr float kMaxParallaxTangent = 1e6f;  // beyond it a ray counts as no steeper; 6e-5 degrees are left
inline constexpr float kMaxParallaxSteps = 1024.0f;

namespace detail {

// How far a ray goes aside for each unit that it goes down.
inline float2 parallaxTangent(const float2& aside, Float down)
{
    const float2 tangent = clamp(aside / down, -kMaxParallaxTangent, kMaxParallaxTangent);
    return select((down > 0.0f) & !(isnan(aside.x) | isnan(aside.y)), tangent, float2(0.0f));
}

// Fewer than one step, or NaN, is one.
inline Float usableSteps(Float steps)
{
    return clamp(steps, 1.0f, kMaxParallaxSteps);
}

// A march from height 1 down along a ray, layer by layer, until the surface is above it.
struct ParallaxMarch
{
    Float step;    // down
    float2 delta;  // aside, for each step
    float2 offset = 0.0f;
    Float ray = 1.0f, surface, surfaceBefore;  // heights at the offset, and the surface's a step before

    template <class HeightAt>
    ParallaxMarch(const float3& viewDir, Float strength, Float steps, const HeightAt& heightAt)
        : step(1.0f / usableSteps(steps)),
          delta(parallaxTangent(viewDir.xy(), viewDir.z) * (step * strength)),
          surface(heightAt(offset)),
          surfaceBefore(surface)
    {
        Mask above = surface < ray;
        whileAny(above, [&] {
            offset = select(above, offset - delta, offset);
            ray = select(above, ray - step, ray);
            surfaceBefore = select(above, surface, surfaceBefore);
            surface = select(above, heightAt(offset), surface);
            above &= (surface < ray) & (ray > 0.0f);
        });
    }
};

}  // namespace detail

// The height at the flat surface, taken for that of the point that the ray meets (Kaneko et al. 2001). It is measured
// from the flat surface, upwards, in units of uv.
inline float2 parallaxOffset(const float3& viewDir, Float height)
{
    return detail::parallaxTangent(viewDir.xy(), viewDir.z) * height;
}

// The same, but with bias added to the z of the unit vector, which limits the offset (Welsh 2004; Unity's bias is
// 0.42).
inline float2 limitedParallaxOffset(const float3& viewDir, Float height, Float bias)
{
    const float3 unit = normalize(viewDir);
    return detail::parallaxTangent(unit.xy(), select(viewDir.z > 0.0f, unit.z + bias, Float(0.0f))) * height;
}

// Down along the ray, layer by layer, until the surface is above it (McGuire and McGuire 2005). steps is taken into
// 1..kMaxParallaxSteps, as in the two that follow.
template <class HeightAt>
float2 steepParallaxOffset(const float3& viewDir, Float strength, Float steps, const HeightAt& heightAt)
{
    return detail::ParallaxMarch(viewDir, strength, steps, heightAt).offset;
}

// The same, and then to where the ray crosses the surface, if both are straight between the last two layers (Tatarchuk
// 2006).
template <class HeightAt>
float2 occlusionParallaxOffset(const float3& viewDir, Float strength, Float steps, const HeightAt& heightAt)
{
    const detail::ParallaxMarch m(viewDir, strength, steps, heightAt);
    const Float over = m.ray + m.step - m.surfaceBefore, under = m.surface - m.ray;
    return m.offset + m.delta * select(m.ray < 1.0f, saturate(under / (over + under)), Float(0.0f));
}

// The march, and then a search by halves: half a step back or forth, a quarter, an eighth (Policarpo et al. 2005).
template <class HeightAt>
float2 reliefParallaxOffset(const float3& viewDir, Float strength, Float steps, int bisections,
                            const HeightAt& heightAt)
{
    detail::ParallaxMarch m(viewDir, strength, steps, heightAt);
    for (int k = 0; k < bisections; ++k) {
        m.step *= 0.5f;
        m.delta *= 0.5f;
        const Float sign = select(heightAt(m.offset) < m.ray, Float(-1.0f), Float(1.0f));
        m.offset += m.delta * sign;
        m.ray += m.step * sign;
    }
    return m.offset;
}

}  // namespace relief::inline RELIEF_WIDTH
