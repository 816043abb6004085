// The lights of glTF's KHR_lights_punctual on lanes, by that extension's formulas. lights.h has Unity's.
//
// A picture's 1 is one candela per square metre: a white matte surface that faces a light shows as 1 where pi = 3.14
// lux arrive. So a light's colour here is its intensity / pi, which is what lighting.h multiplies by.
#pragma once

#include "relief/scene/scene_file.h"
#include "relief/shading/lighting.h"

namespace relief::samples {

struct PunctualLight
{
    SceneLight::Kind kind;
    float3 color;                   // of a unit's distance
    float3 position;                // world space
    float3 dir;                     // towards where it comes from, unit length; not of points
    Float inverseSquareRange;       // 0: no range
    Float angleScale, angleOffset;  // of spots
};

// Of a light in a scene that is scaled by `scale` and moved, after that, to where `worldFromScene` says: distances in
// the formulas are the scene's.
inline PunctualLight punctualLight(const SceneLight& light, const glm::mat4& worldFromScene, float scale)
{
    constexpr double kPi = 3.14159265358979323846;
    const bool isDirectional = light.kind == SceneLight::Kind::directional;
    const double distance = isDirectional ? 1.0 : static_cast<double>(scale);
    const double strength = static_cast<double>(light.intensity) * distance * distance / kPi;
    const glm::vec4 position = worldFromScene * glm::vec4(light.position, 1.0f);
    PunctualLight made = {.kind = light.kind, .dir = broadcast(-light.forward)};
    for (int i = 0; i < 3; ++i) {
        made.color[i] = static_cast<float>(std::min(strength * static_cast<double>(light.color[i]), 1e30));
        made.position[i] = position[i];
    }
    const double range = static_cast<double>(light.range) * static_cast<double>(scale);
    made.inverseSquareRange = static_cast<float>(std::min(1.0 / (range * range), 1e30));
    made.angleScale = 1.0f / std::max(0.001f, light.cosInner - light.cosOuter);
    made.angleOffset = -light.cosOuter * made.angleScale[0];
    return made;
}

// What arrives at a point of the world: 1 / d^2, faded out as max(0, 1 - (d / range)^4); of a spot times the square of
// saturate(cos of the angle * scale + offset).
inline UnityLight CreateLight(const PunctualLight& light, const float3& worldPos)
{
    if (light.kind == SceneLight::Kind::directional) return {light.color, light.dir};
    const float3 lightVec = light.position - worldPos;
    const Float square = max(dot(lightVec, lightVec), Float(1e-6f));
    const float3 dir = normalize(lightVec);
    const Float part = min(square * light.inverseSquareRange, Float(1.0f));
    Float attenuation = (1.0f - part * part) / square;
    if (light.kind == SceneLight::Kind::spot) {
        const Float cone = saturate(dot(dir, light.dir) * light.angleScale + light.angleOffset);
        attenuation = attenuation * (cone * cone);
    }
    return {light.color * attenuation, dir};
}

}  // namespace relief::samples
