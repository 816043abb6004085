// Relief as geometry: a mesh whose vertices are moved along their normals by a height over the picture. Object space.
// For the detailed side of a normal map's baking (bake.h).
#pragma once

#include <functional>

#include "relief/mesh/mesh.h"

namespace relief {

// The mesh with every vertex moved along its normal by amount * heights(u, v), in object-space units, and with smooth
// normals of the new surface (computeNormals). Vertices at one position, as along a sphere's seam and at its poles,
// move together, so that no crack opens: by the mean of their heights, along the mean of their normals; and they get
// one normal, so that hard edges become smooth. uvs stay; tangents are removed, because they are another surface's now
// (withTangents). An error if the mesh is not valid, has vertices but no uvs, or a vertex ends up where no float is.
Expected<Mesh> displaced(Mesh base, const std::function<float(float u, float v)>& heights, float amount);

}  // namespace relief
