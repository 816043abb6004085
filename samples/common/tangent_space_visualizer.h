// Draws the tangent space of a mesh as lines: the tutorial's TangentSpaceVisualizer (Rendering 6, 4.1), which there is
// a component with Gizmos.DrawLine. From every vertex one line along the normal (green), one along the tangent (red)
// and one along the binormal (blue), in world space, hidden by what is in front of them.
#pragma once

#include "common/scene.h"

namespace relief::samples {

struct TangentSpaceVisualizer
{
    float offset = 0.01f;  // from the surface along the normal, so that lines of neighbouring faces do not overlap
    float scale = 0.1f;    // the lines' length

    // A mesh without tangents gets them.
    void ShowTangentSpace(const Scene& s, const Mesh& mesh, const glm::mat4& worldFromObject) const;
};

}  // namespace relief::samples
