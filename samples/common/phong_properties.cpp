#include "common/phong_properties.h"

namespace relief::samples {

std::vector<Property> diffuseProperties(const std::vector<Property>& more)
{
    const std::vector<Property> material = {
        {"color", glm::vec4(1.0f), 0.0f, 1.0f, 4, "diffuse material colour"},
        {"bumpMap_ST", {1, 1, 0, 0}, -16.0f, 16.0f, 4, "tiling in x and y, offset in z and w"},
    };
    return joined(joined(material, lightAngles(35.0f, -20.0f)), more);
}

std::vector<Property> phongProperties(const std::vector<Property>& more)
{
    return joined(
        diffuseProperties(
            {{"specColor", glm::vec4(1.0f), 0.0f, 1.0f, 4, "specular material colour"},
             {"shininess", glm::vec4(10.0f), 0.0f, 1000.0f, 1, "exponent of the highlight; the higher, the smaller"},
             {"sun", glm::vec4(0.5f), 0.0f, 8.0f, 1, "strength of the directional light"},
             {"ambient", glm::vec4(0.033f), 0.0f, 1.0f, 3, "light from everywhere"},
             {"tutorialForm", glm::vec4(0.0f), 0.0f, 1.0f, 1, "1: the highlight without N.L, and cut"}}),
        more);
}

std::vector<Property> cgProperties(const std::vector<Property>& more)
{
    const std::vector<Property> material = {
        {"color", glm::vec4(1.0f), 0.0f, 1.0f, 4, "Color Tint: what all light is multiplied by"},
        {"specColor", glm::vec4(1.0f), 0.0f, 1.0f, 4, "Specular Color"},
        {"shininess", glm::vec4(10.0f), 0.0f, 1000.0f, 1, "exponent of the highlight; larger is smaller"},
        {"bumpMap_ST", {1, 1, 0, 0}, -16.0f, 16.0f, 4, "tiling in x and y, offset in z and w"},
        {"ambient", glm::vec4(0.05f), 0.0f, 1.0f, 3, "the scene's ambient light"},
        {"lightStrength", glm::vec4(0.5f), 0.0f, 16.0f, 1, "of the directional light"},
    };
    return joined(joined(material, lightAngles(35.0f, -75.0f)), more);
}

}  // namespace relief::samples
