// ddx and ddy: how much a value changes from one pixel to the next, to the right and down. They are differences between
// the neighbours in a 2x2 quad, exact because a quad is always whole. Fine by default: ddx differs from row to row, ddy
// from column to column; the coarse forms give one value per quad (D3D 11.3, 22.5).
#pragma once

#include "relief/hlsl/types.h"

namespace relief::inline RELIEF_WIDTH {

inline Float ddx(Float v)
{
    return permuteQuad<1, 1, 3, 3>(v) - permuteQuad<0, 0, 2, 2>(v);
}
inline Float ddy(Float v)
{
    return permuteQuad<2, 3, 2, 3>(v) - permuteQuad<0, 1, 0, 1>(v);
}
inline Float ddx_coarse(Float v)
{
    return permuteQuad<1, 1, 1, 1>(v) - permuteQuad<0, 0, 0, 0>(v);
}
inline Float ddy_coarse(Float v)
{
    return permuteQuad<2, 2, 2, 2>(v) - permuteQuad<0, 0, 0, 0>(v);
}

// The sum of both changes: how far a value goes on within one pixel.
inline Float fwidth(Float v)
{
    return abs(ddx(v)) + abs(ddy(v));
}

// HLSL's names for the default.
inline Float ddx_fine(Float v)
{
    return ddx(v);
}
inline Float ddy_fine(Float v)
{
    return ddy(v);
}

// Of each component.
template <int n>
LaneVector<Float, n> ddx(const LaneVector<Float, n>& v)
{
    return detail::each<LaneVector<Float, n>>([](Float x) { return ddx(x); }, v);
}
template <int n>
LaneVector<Float, n> ddy(const LaneVector<Float, n>& v)
{
    return detail::each<LaneVector<Float, n>>([](Float x) { return ddy(x); }, v);
}
template <int n>
LaneVector<Float, n> ddx_coarse(const LaneVector<Float, n>& v)
{
    return detail::each<LaneVector<Float, n>>([](Float x) { return ddx_coarse(x); }, v);
}
template <int n>
LaneVector<Float, n> ddy_coarse(const LaneVector<Float, n>& v)
{
    return detail::each<LaneVector<Float, n>>([](Float x) { return ddy_coarse(x); }, v);
}
template <int n>
LaneVector<Float, n> ddx_fine(const LaneVector<Float, n>& v)
{
    return ddx(v);
}
template <int n>
LaneVector<Float, n> ddy_fine(const LaneVector<Float, n>& v)
{
    return ddy(v);
}
template <int n>
LaneVector<Float, n> fwidth(const LaneVector<Float, n>& v)
{
    return abs(ddx(v)) + abs(ddy(v));
}

}  // namespace relief::inline RELIEF_WIDTH
