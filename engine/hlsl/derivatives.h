// ddx and ddy: how much a value changes from one pixel to the next, to the right and down. They are differences between
// the neighbours in a 2x2 quad, exact because a quad is always whole. Fine by default: ddx differs from row to row, ddy
// from column to column; the coarse forms give one value per quad (D3D 11.3, 22.5).
#pragma once

#include "hlsl/types.h"

namespace relief {

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

namespace detail {

template <int size, class Function>
FloatN<size> eachComponent(const FloatN<size>& v, Function function)
{
    FloatN<size> r;
    for (int i = 0; i < size; ++i) r[i] = function(v[i]);
    return r;
}

}  // namespace detail

template <int size>
FloatN<size> ddx(const FloatN<size>& v)
{
    return detail::eachComponent(v, [](Float x) { return ddx(x); });
}

template <int size>
FloatN<size> ddy(const FloatN<size>& v)
{
    return detail::eachComponent(v, [](Float x) { return ddy(x); });
}

template <int size>
FloatN<size> ddx_coarse(const FloatN<size>& v)
{
    return detail::eachComponent(v, [](Float x) { return ddx_coarse(x); });
}

template <int size>
FloatN<size> ddy_coarse(const FloatN<size>& v)
{
    return detail::eachComponent(v, [](Float x) { return ddy_coarse(x); });
}

}  // namespace relief
