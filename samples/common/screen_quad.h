// A picture that a pass has drawn, on the screen: programs for primitive("quad").
#pragma once

#include "common/assets.h"
#include "relief/relief.h"

namespace relief::samples {

struct ScreenVertexData
{
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct ScreenInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
};

// In the middle of the viewport: a part of its width and height.
struct ScreenVertexProgram
{
    float width = 1.0f, height = 1.0f;

    ScreenInterpolators operator()(ScreenVertexData v) const
    {
        return {float4(v.position.x * (2.0f * width), v.position.y * (2.0f * height), 0.5f, 1.0f), v.uv};
    }
};

// Over what is there, where alpha says so; colours are the mean of what was drawn and of nothing, which is black.
// Opaque: wherever anything was drawn, as if all of the pixel were covered.
struct ShowPicture
{
    sampler2D picture;
    bool isOpaque = false;

    float4 operator()(ScreenInterpolators i, Discard& discard) const
    {
        const float4 color = tex2D(picture, i.uv);
        discard(color.a == 0.0f);
        return isOpaque ? float4(color.rgb(), 1.0f) : float4(color.rgb() / color.a, color.a);
    }
};

inline constexpr RenderState kOverThePicture = {.blend = Blend::alpha};

}  // namespace relief::samples
