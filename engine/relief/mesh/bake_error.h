// How far a normal map's vectors are from the surface that they were baked from, once a shader has decoded them. In: a
// map, and the mesh that is shaded with it, in object space. Out: angles in degrees.
#pragma once

#include <cstddef>

#include "relief/mesh/bake.h"

namespace relief {

// How the shader makes its tangent frame. A map is synched with the shader if this and the mesh's tangents are what it
// was baked with.
struct DecodeOptions
{
    BinormalAt binormal = BinormalAt::vertex;
    bool orthonormalise = false;  // normal, tangent and binormal made unit and perpendicular in every fragment
};

// Over the texels that hit the detailed mesh. All 0 if there is none.
struct AngleError
{
    double mean = 0, max = 0;  // degrees, 0..180
    std::size_t texels = 0;
};

// Decodes each hit texel at its centre, without filtering, and measures the angle to the detailed mesh's normal there.
// `mesh` is the one that the map was baked for, or the same triangles with other tangents. Angles are
// 2 atan2(|a - b|, |a + b|), good for small ones too; what floats round off the two vectors leaves about 5e-6 degrees.
// An error if the mesh is not valid, has no uvs or tangents, or covers other texels than the map's.
Expected<AngleError> bakeError(const BakedNormalMap& map, const Mesh& mesh, const DecodeOptions& options);

}  // namespace relief
