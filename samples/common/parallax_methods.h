// The methods of 5.11 to 5.14 by name, for stage 5.16, which compares them with geometry.
#pragma once

#include "relief/shading/parallax.h"

namespace relief::samples {

enum class ParallaxMethod
{
    none,
    limited,    // 5.11
    steep,      // 5.12
    occlusion,  // 5.13
    relief      // 5.14
};

// How far the picture is moved, in uv (shading/parallax.h). `bias` is 5.11's, `steps` are those of the others.
template <ParallaxMethod METHOD, class HeightAt>
float2 ParallaxOffset(const float3& viewDir, Float strength, Float bias, Float steps, const HeightAt& heightAt)
{
    const float2 here(0.0f);
    if constexpr (METHOD == ParallaxMethod::none) return here;
    if constexpr (METHOD == ParallaxMethod::limited)
        return limitedParallaxOffset(viewDir, (heightAt(here) - 0.5f) * strength, bias);
    if constexpr (METHOD == ParallaxMethod::steep) return steepParallaxOffset(viewDir, strength, steps, heightAt);
    if constexpr (METHOD == ParallaxMethod::occlusion)
        return occlusionParallaxOffset(viewDir, strength, steps, heightAt);
    return reliefParallaxOffset(viewDir, strength, steps, 5, heightAt);
}

}  // namespace relief::samples
