// A normal map from geometry: how the surface of a detailed mesh leans against that of a coarse one, in the tangent
// space in which the coarse one is shaded (tangent_frame.h). In: two meshes in one object space. Out: one vector per
// texel. "Synched": baker and shader use the same tangents, so that what was baked is what is shaded (Rendering
// 6, 4.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "relief/mesh/tangent_frame.h"

namespace relief {

struct BakeOptions
{
    int width = 512, height = 512;  // texels, 1..16384
    float distance = 0.1f;          // how far to search outwards and inwards, in object space; above 0
    BinormalAt binormal = BinormalAt::vertex;
    int padding = 4;  // texels by which islands are continued outwards, 0..64: filters reach over their border
};

enum class TexelState : std::uint8_t
{
    background,  // of no triangle
    padding,     // the same, with a vector continued from nearby
    missed,      // of a triangle, but the detailed mesh has no front face within the distance
    hit
};

struct BakedNormalMap
{
    static constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

    int width = 0, height = 0;
    BinormalAt binormal = BinormalAt::vertex;  // as it was baked
    // One per texel, row by row from the top, as in Texture.
    std::vector<glm::vec3> normals;  // tangent space, unit length; (0, 0, 1) for background and missed
    std::vector<TexelState> states;
    std::vector<std::uint32_t> triangles;  // of the coarse mesh; kNoTriangle for background and padding
    std::vector<glm::vec3> detailNormals;  // of the detailed mesh where it was hit: object space, unit length; else 0
    std::size_t hits = 0, misses = 0;      // texels
};

// For each texel whose centre lies in a triangle of `low`'s uvs, borders included (the first triangle, where several
// do): a ray along the unit interpolated normal, from `distance` outside of the surface to `distance` inside; the first
// front face of `high` that it meets, which is the one seen from outside; the unit normal interpolated there, in the
// frame of `low` at the texel. All in double, so the bits are the same everywhere. A vector of zero length or a flat
// frame gives (0, 0, 1), never NaN. uvs wrap around, and so does the padding.
//
// Halves that share their uvs, mirrored or not, get the map of the half that comes first. Normals and tangents are made
// unit at the vertices, as vertex programs do; under a transform that is no rotation and uniform scale a shader's frame
// is another one. An error if an option is out of range, the map does not fit into memory, a mesh is not valid, or
// `low` has triangles but no uvs, no tangents, or a uv beyond +-kLargestBakedUv.
Expected<BakedNormalMap> bakeNormalMap(const Mesh& low, const Mesh& high, const BakeOptions& options);

// The map as its file would hold it: each coordinate n as the 8-bit code nearest to (n * 0.5 + 0.5) * 255, back as
// code / 255 * 2 - 1. The vectors are no longer of exact length, and 0 has no code.
BakedNormalMap roundedTo8Bits(BakedNormalMap map);

// Four floats per texel, (n * 0.5 + 0.5, 1), row by row from the top: what Texture::fromRgbaFloat takes.
std::vector<float> rgbaOf(const BakedNormalMap& map);

}  // namespace relief
