#include "relief/shading/object_transform.h"

#include "relief/lanes/environment.h"

namespace relief::inline RELIEF_WIDTH {

ObjectTransform::ObjectTransform(const glm::mat4& clipFromWorld, const glm::mat4& world)
{
    const DefaultFloatingPoint environment;
    clipFromObject = broadcast(clipFromWorld * world);
    worldFromObject = broadcast(world);
    normalFromObject = broadcast(normalMatrix(glm::mat3(world)));
    unity_WorldTransformParams = float4(0.0f, 0.0f, 0.0f, mirrorSign(world));
}

}  // namespace relief::inline RELIEF_WIDTH
