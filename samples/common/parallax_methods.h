// The methods of 5.11 to 5.14 in one place, for stage 5.16, which compares them with geometry. Each says how far the
// picture is moved, in uv, where a ray of sight meets the flat quad.
#pragma once

#include "relief.h"

namespace relief::samples {

enum class ParallaxMethod
{
    none,
    limited,    // 5.11
    steep,      // 5.12
    occlusion,  // 5.13
    relief      // 5.14
};

struct Parallax
{
    sampler2D heightMap;
    Float strength;  // from the lowest to the highest, in uv
    Float bias;      // of 5.11
    Float steps;     // of the others

    // `viewDir` is in tangent space, of any length; dx and dy are the uv's derivatives.
    template <ParallaxMethod METHOD>
    float2 Offset(const float2& uv, const float3& viewDir, const float2& dx, const float2& dy) const
    {
        if constexpr (METHOD == ParallaxMethod::none) return float2(0.0f);
        const auto heightAt = [&](const float2& at) { return tex2Dgrad(heightMap, at, dx, dy).x; };
        if constexpr (METHOD == ParallaxMethod::limited) {
            const float3 unit = normalize(viewDir);
            return unit.xy() / (unit.z + bias) * ((heightAt(uv) - 0.5f) * strength);
        }
        Float step = 1.0f / steps;
        float2 delta = viewDir.xy() / viewDir.z * (step * strength), offset(0.0f);
        Float ray = 1.0f, surface = heightAt(uv), surfaceBefore = surface;
        Mask above = surface < ray;
        whileAny(above, [&] {
            offset = select(above, offset - delta, offset);
            ray = select(above, ray - step, ray);
            surfaceBefore = select(above, surface, surfaceBefore);
            surface = select(above, heightAt(uv + offset), surface);
            above &= surface < ray;
        });
        if constexpr (METHOD == ParallaxMethod::occlusion) {
            const Float over = ray + step - surfaceBefore, under = surface - ray;
            offset += delta * select(ray < 1.0f, under / (over + under), Float(0.0f));
        }
        for (int k = 0; k < (METHOD == ParallaxMethod::relief ? 5 : 0); ++k) {
            step *= 0.5f;
            delta *= 0.5f;
            const Float sign = select(heightAt(uv + offset) < ray, Float(-1.0f), Float(1.0f));
            offset += delta * sign;
            ray += step * sign;
        }
        return offset;
    }
};

}  // namespace relief::samples
