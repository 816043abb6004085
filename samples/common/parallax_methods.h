// The methods of 5.10 to 5.15 by name, for stage 5.16, which compares them with geometry.
#pragma once

#include "relief/shading/parallax.h"

namespace relief::samples {

enum class ParallaxMethod
{
    none,
    parallax,   // 5.10
    limited,    // 5.11
    steep,      // 5.12
    occlusion,  // 5.13
    relief,     // 5.14
    selfShadow  // 5.15: the same points
};
inline constexpr int kParallaxMethods = 7;

// The first two move the picture up and down from the middle height, the others down from the highest.
constexpr bool BeginsInTheMiddle(ParallaxMethod method)
{
    return method == ParallaxMethod::parallax || method == ParallaxMethod::limited;
}

// How far the picture is moved, in uv (shading/parallax.h). `bias` is 5.11's, `steps` are those of the others.
template <ParallaxMethod METHOD, class HeightAt>
float2 ParallaxOffset(const float3& viewDir, Float strength, Float bias, Float steps, const HeightAt& heightAt)
{
    const float2 here(0.0f);
    if constexpr (METHOD == ParallaxMethod::none) return here;
    if constexpr (METHOD == ParallaxMethod::parallax)
        return parallaxOffset(viewDir, (heightAt(here) - 0.5f) * strength);
    if constexpr (METHOD == ParallaxMethod::limited)
        return limitedParallaxOffset(viewDir, (heightAt(here) - 0.5f) * strength, bias);
    if constexpr (METHOD == ParallaxMethod::steep) return steepParallaxOffset(viewDir, strength, steps, heightAt);
    if constexpr (METHOD == ParallaxMethod::occlusion)
        return occlusionParallaxOffset(viewDir, strength, steps, heightAt);
    return reliefParallaxOffset(viewDir, strength, steps, 5, heightAt);
}

// What of the light arrives at a point of the relief: 5.15's march from there up towards the light, 1 or 0. heightAt is
// given how far aside of the point.
template <class HeightAt>
Float SelfShadow(const float3& lightDir, Float strength, Float steps, const HeightAt& heightAt)
{
    constexpr float shadowBias = 0.02f;
    const Float step = 1.0f / steps;
    const float2 delta = lightDir.xy() / lightDir.z * (step * strength);
    float2 offset(0.0f);
    Float ray = heightAt(offset) + shadowBias;
    Mask free = (ray < 1.0f) & (lightDir.z > 0.0f), climbing = free;
    whileAny(climbing, [&] {
        offset = select(climbing, offset + delta, offset);
        ray = select(climbing, ray + step, ray);
        free &= !(climbing & (heightAt(offset) > ray));
        climbing &= free & (ray < 1.0f);
    });
    return select(free | (ray >= 1.0f), Float(1.0f), Float(0.0f));
}

}  // namespace relief::samples
