// Texture coordinates for meshes that come without: a map of the world around the mesh. Object space, left-handed, Y
// up.
#pragma once

#include "relief/mesh/mesh.h"

namespace relief {

// The mesh with uvs by longitude and latitude about the centre of its bounding box, laid out as on makeSphere: v grows
// from 0 at -Y to 1 at +Y; u grows to the right for who looks at the mesh from -Z, and the picture's middle faces -Z.
// Where triangles cross the seam at +Z their vertices are split, and those to the right of it get u + 1, so that u lies
// in 0..1.5. A vertex on the vertical axis has no longitude: in each triangle it takes the mean u of the other corners.
// So no triangle spans more than half of the picture, unless the axis passes through it. A vertex in the very centre
// has v = 0.5. uvs that the mesh had are replaced, tangents are removed. A split vertex keeps its index for the first
// use, the others are appended. An error if the mesh is not valid.
Expected<Mesh> withSphericalUvs(Mesh mesh);

}  // namespace relief
