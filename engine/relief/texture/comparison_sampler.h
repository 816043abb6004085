// Comparison sampling: how much of a texture's neighbourhood passes a comparison with a number of the shader's own.
// Shadow maps are read in this way. The texels are compared first, and the results are weighted (D3D 11.3, 7.18.16):
// never the other way round, as the mean of two depths is the depth of nothing.
#pragma once

#include <array>

#include "relief/hlsl/compare.h"
#include "relief/hlsl/types.h"
#include "relief/texture/address.h"
#include "relief/texture/cube_face.h"
#include "relief/texture/texture.h"

namespace relief::inline RELIEF_WIDTH {

struct SamplerComparisonState
{
    const Texture* texture = nullptr;         // not owned; its red is compared, and a null texture is 1 everywhere
    Compare comparison = Compare::lessEqual;  // reference `comparison` texel
    AddressMode u = AddressMode::border;
    AddressMode v = AddressMode::border;
    float border = 1.0f;  // what lies outside 0..1 in border mode: 1 is lit, where texels are depths
};

// The share of the 2x2 texels around uv, weighted as a bilinear filter does, whose comparison holds: 0..1, and exactly
// these where all four agree. Of the finest level. A reference that is NaN passes no comparison but notEqual and
// always.
Float SampleCmp(const SamplerComparisonState& s, const float2& uv, Float reference);

// Six textures that are a cube's faces (cube_face.h): a lamp's shadow map, one picture along each axis.
struct SamplerCubeComparisonState
{
    std::array<const Texture*, kCubeFaces> faces = {};  // not owned; of a null texture each comparison is with 1
    Compare comparison = Compare::lessEqual;            // reference `comparison` texel
};

// The same in a direction of any length, on the face that each lane's direction passes through. The 2x2 texels are of
// one face: the weights end at its edge, where they repeat the last texel.
Float SampleCmp(const SamplerCubeComparisonState& s, const float3& direction, Float reference);

}  // namespace relief::inline RELIEF_WIDTH
