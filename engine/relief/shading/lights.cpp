#include "relief/shading/lights.h"

#include "relief/lanes/environment.h"

namespace relief::inline RELIEF_WIDTH {

SphericalHarmonics gradientSurroundings(const glm::vec3& sky, const glm::vec3& equator, const glm::vec3& ground)
{
    const DefaultFloatingPoint environment;
    SphericalHarmonics sh;
    for (int c = 0; c < 3; ++c) {
        const float slope = (sky[c] - ground[c]) * 0.5f;
        const float half = ((sky[c] + ground[c]) * 0.5f - equator[c]) * 0.5f;
        sh.A[c] = float4(0.0f, slope, 0.0f, equator[c] + half);
        sh.B[c] = float4(0.0f, 0.0f, -half, 0.0f);
        sh.C[c] = -half;
    }
    return sh;
}

}  // namespace relief::inline RELIEF_WIDTH
