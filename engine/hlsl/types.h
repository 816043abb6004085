// float2, float3, float4, float3x3, float4x4: GLM's vectors and matrices of lanes. GLM brings the members, swizzles
// (`v.xzy()`), constructors and the operators between equal types; here are the operators with a plain number.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lanes/float.h"

#if !defined(GLM_FORCE_SWIZZLE)
#error "compile with GLM_FORCE_SWIZZLE (the CMake target relief_engine passes it on)"
#endif
#if defined(GLM_FORCE_INTRINSICS) || defined(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES)
#error "GLM's intrinsics bring an approximate rsqrt, whose bits differ between processors: do not define them"
#endif

namespace relief {

template <int size>
using FloatN = glm::vec<size, Float, glm::defaultp>;

using float2 = FloatN<2>;
using float3 = FloatN<3>;
using float4 = FloatN<4>;
using float3x3 = glm::mat<3, 3, Float, glm::defaultp>;
using float4x4 = glm::mat<4, 4, Float, glm::defaultp>;

template <class T>
concept Number = std::is_arithmetic_v<T>;

template <int size, Number N>
FloatN<size> operator+(const FloatN<size>& a, N b)
{
    return a + Float(b);
}
template <int size, Number N>
FloatN<size> operator+(N a, const FloatN<size>& b)
{
    return Float(a) + b;
}
template <int size, Number N>
FloatN<size> operator-(const FloatN<size>& a, N b)
{
    return a - Float(b);
}
template <int size, Number N>
FloatN<size> operator-(N a, const FloatN<size>& b)
{
    return Float(a) - b;
}
template <int size, Number N>
FloatN<size> operator*(const FloatN<size>& a, N b)
{
    return a * Float(b);
}
template <int size, Number N>
FloatN<size> operator*(N a, const FloatN<size>& b)
{
    return Float(a) * b;
}
template <int size, Number N>
FloatN<size> operator/(const FloatN<size>& a, N b)
{
    return a / Float(b);
}
template <int size, Number N>
FloatN<size> operator/(N a, const FloatN<size>& b)
{
    return Float(a) / b;
}

// A uniform: the same plain value in every lane.
inline float2 broadcast(const glm::vec2& v)
{
    return {v.x, v.y};
}
inline float3 broadcast(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}
inline float4 broadcast(const glm::vec4& v)
{
    return {v.x, v.y, v.z, v.w};
}
inline float3x3 broadcast(const glm::mat3& m)
{
    return {broadcast(m[0]), broadcast(m[1]), broadcast(m[2])};
}
inline float4x4 broadcast(const glm::mat4& m)
{
    return {broadcast(m[0]), broadcast(m[1]), broadcast(m[2]), broadcast(m[3])};
}

// Back again: of a uniform, in which all lanes are the same.
inline glm::mat4 firstLane(const float4x4& m)
{
    glm::mat4 r;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) r[column][row] = m[column][row][0];
    }
    return r;
}

}  // namespace relief
