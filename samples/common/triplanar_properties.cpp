#include "common/triplanar_properties.h"

namespace relief::samples {

std::vector<Property> triplanarProperties(const std::vector<Property>& more, float lightYaw)
{
    const std::vector<Property> surface = {
        {"tiling", glm::vec4(1.0f), 0.0f, 64.0f, 1, "how often the texture repeats per unit of the world"},
        mapScaleProperty("bumpScale", 1.0f),
        {"ambient", glm::vec4(0.05f), 0.0f, 1.0f, 3, "light from everywhere"},
    };
    return joined(joined(surface, lightAngles(35.0f, lightYaw)), more);
}

Inputs bricks(const std::string& mesh)
{
    return {.mesh = mesh,
            .albedo = "bricks-albedo.png",
            .normal = "bricks-heights.png",
            .cubesTurnedBy = 0.0f,
            .normalImport = normalMapSettings(0.04f)};
}

}  // namespace relief::samples
