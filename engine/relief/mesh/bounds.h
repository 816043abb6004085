// The box around a mesh, along the axes: in object space, or moved to world space. An empty mesh has the point 0.
#pragma once

#include <glm/mat4x4.hpp>

#include "relief/mesh/mesh.h"

namespace relief {

struct Bounds
{
    glm::vec3 low{0.0f}, high{0.0f};

    glm::vec3 centre() const;
    float radius() const;  // of the sphere around the box

    // From a point to the nearest point of the box; 0 inside.
    float squaredDistance(const glm::vec3& point) const;
};

Bounds boundsOf(const Mesh& mesh);

// The box around the moved box: of its eight corners. The matrix must be affine.
Bounds transformed(const Bounds& bounds, const glm::mat4& matrix);

}  // namespace relief
