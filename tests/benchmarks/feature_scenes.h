// More benchmark scenes, each for a feature that those of scenes.h do not have: several samples a pixel, and what is
// drawn in several passes or with a cube map.
#pragma once

#include "scenes.h"

namespace relief::benchmarks {

const std::vector<BenchScene>& featureScenes();

// What these scenes' programs are given, the same numbers for both rasterizers.
inline constexpr float kBumpScale = 0.6f;
inline constexpr float kAmbient = 0.15f, kShininess = 32.0f, kSpecular = 0.4f;
inline constexpr int kShadowMapSide = 1024;
inline constexpr float kNormalOffset = 0.03f;  // how far a point is moved off its surface before its shadow is read
inline constexpr glm::vec3 kLampPosition{0.7f, 0.9f, -1.1f}, kLampColor{1.6f, 1.1f, 0.5f};

}  // namespace relief::benchmarks
