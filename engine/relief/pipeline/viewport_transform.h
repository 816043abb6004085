// Perspective division, viewport and snapping: from clip space to 24.8 fixed-point pixels (D3D 11.3, 3.4.1 and 15.6).
// The only place where positions are rounded; everything after it is exact.
#pragma once

#include "relief/hlsl/types.h"
#include "relief/pipeline/geometry.h"

namespace relief::inline RELIEF_WIDTH {

struct ScreenLanes
{
    Int x, y;  // 24.8 fixed point
    Float z, invW;
};

struct ViewportTransform
{
    float halfWidth, halfHeight, x, y;
    float inverseGuardX, inverseGuardY;  // |x| * inverseGuardX <= w holds within the guard band

    explicit ViewportTransform(const Viewport& v)
        : halfWidth(static_cast<float>(v.width) * 0.5f),
          halfHeight(static_cast<float>(v.height) * 0.5f),
          x(static_cast<float>(v.x)),
          y(static_cast<float>(v.y)),
          inverseGuardX(inverseGuard(v.x, v.width)),
          inverseGuardY(inverseGuard(v.y, v.height))
    {
    }

    ScreenLanes project(const float4& clip) const
    {
        const Float invW = 1.0f / clip.w;
        const Float screenX = (clip.x * invW + 1.0f) * halfWidth + x;
        const Float screenY = (1.0f - clip.y * invW) * halfHeight + y;
        // Depth beyond 0 ... 1 is clamped pixel by pixel (interpolate.h), here only kept finite.
        return {snap(screenX), snap(screenY), clamp(clip.z * invW, -1e30f, 1e30f), invW};
    }

    // Round to the nearest 1/256, ties to even; clamped to the guard band, so that no input can leave 24 bits.
    static Int snap(Float pixels)
    {
        const float limit = kGuardBand;
        return roundToInt(clamp(pixels, -limit, limit) * static_cast<float>(kSubpixels));
    }

private:
    // The guard band in units of the viewport's half size: one pixel narrower than what the integers can hold, since a
    // line is moved by as much, and never narrower than the viewport. Where a visible one reaches into that pixel, at
    // 16383 and 16384 wide, the band is the viewport itself, and differences within it are far below 2^24.
    static float inverseGuard(int origin, int size)
    {
        const float half = static_cast<float>(size) * 0.5f;
        const float centre = static_cast<float>(origin) + half;
        const float room = static_cast<float>(kGuardBand - 1) - (centre < 0.0f ? -centre : centre);
        return half / (room < half ? half : room);
    }
};

}  // namespace relief::inline RELIEF_WIDTH
