// Samplers: how a shader reads a texture, under HLSL's names. A sampler2D is a uniform, a plain field of a fragment
// program; tex2D and its variants take one texture coordinate per lane and give one linear colour per lane.
//
// uv (0, 0) is the lower left corner of the picture, (1, 1) the upper right one. The coordinate may be anything, NaN
// and infinities included. A lane's result depends on its own coordinate and derivatives alone, never on what the other
// lanes do (derivatives come from the lane's own quad).
#pragma once

#include "relief/hlsl/types.h"
#include "relief/texture/address.h"
#include "relief/texture/texture.h"

namespace relief::inline RELIEF_WIDTH {

// nearest: one texel of the nearest mip level. bilinear: between 2x2 texels of the nearest mip level.
// trilinear: between two of those, of the two nearest levels.
enum class Filter
{
    nearest,
    bilinear,
    trilinear
};

struct sampler2D
{
    const Texture* texture = nullptr;  // not owned; a null texture is white
    Filter filter = Filter::trilinear;
    AddressMode u = AddressMode::wrap;
    AddressMode v = AddressMode::wrap;
    bool mipmaps = true;          // false: level 0 alone, and no derivatives are taken
    int maxAnisotropy = 1;        // 1..16; above 1 only with the trilinear filter
    float lodBias = 0.0f;         // with the bias of tex2Dbias limited to -16..15.99
    float minLod = 0.0f;          // wins where it is above maxLod
    float maxLod = 1000.0f;       // beyond every level
    glm::vec4 borderColor{0.0f};  // linear; what AddressMode::border shows outside 0..1
};

namespace detail {

// Single lanes as parameters travel in registers, vectors of them through memory. See sampler.cpp for the references.
void sampleImplicit(float4& result, const sampler2D& s, Float u, Float v);
void sampleBias(float4& result, const sampler2D& s, Float u, Float v, Float bias);
void sampleGradients(float4& result, const sampler2D& s, Float u, Float v, const float2& dx, const float2& dy);
void sampleLod(float4& result, const sampler2D& s, Float u, Float v, Float lod);

}  // namespace detail

// The colour at uv. The level of detail comes from the differences to the neighbouring pixels, so all lanes of a quad
// must get here together: call it outside of anything that only some lanes do, or use tex2Dgrad or tex2Dlod.
inline float4 tex2D(const sampler2D& s, const float2& uv)
{
    float4 color;
    detail::sampleImplicit(color, s, uv.x, uv.y);
    return color;
}

// The colour at uv where `needed`, 0 elsewhere; nothing is fetched where no pixel of the block needs it. HLSL's branch
// around a fetch, but with the right level of detail: uv is to be there in all lanes, so it is computed before.
float4 tex2DWhere(Mask needed, const sampler2D& s, const float2& uv);

// tex2D with the coordinate's change per pixel given, to the right and down. For coordinates that jump (a seam, a
// frac) where the surface does not.
inline float4 tex2Dgrad(const sampler2D& s, const float2& uv, const float2& dx, const float2& dy)
{
    float4 color;
    detail::sampleGradients(color, s, uv.x, uv.y, dx, dy);
    return color;
}

// The colour at uvLod.xy on level uvLod.w (the sampler's limits and bias apply). Never anisotropic.
inline float4 tex2Dlod(const sampler2D& s, const float4& uvLod)
{
    float4 color;
    detail::sampleLod(color, s, uvLod.x, uvLod.y, uvLod.w);
    return color;
}

// tex2D at uvBias.xy with uvBias.w added to the level of detail.
inline float4 tex2Dbias(const sampler2D& s, const float4& uvBias)
{
    float4 color;
    detail::sampleBias(color, s, uvBias.x, uvBias.y, uvBias.w);
    return color;
}

// The level that tex2D would use, bias and limits included, in 0..levels - 1; and without limits: below 0 is magnified,
// -infinity where the coordinate does not change. As HLSL's functions of these names.
Float calculateLevelOfDetail(const sampler2D& s, const float2& uv);
Float calculateLevelOfDetailUnclamped(const sampler2D& s, const float2& uv);

// (1 / width, 1 / height, width, height) in every lane: Unity's _MainTex_TexelSize. 1 for a null texture.
float4 texelSize(const sampler2D& s);

// Unity's tiling and offset: uv * st.xy + st.zw.
inline float2 TRANSFORM_TEX(const float2& uv, const float4& st)
{
    return {uv.x * st.x + st.z, uv.y * st.y + st.w};
}

}  // namespace relief::inline RELIEF_WIDTH
