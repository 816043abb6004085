// LaneMatrix<n>: n columns of n Floats each. m[1] is the second column, m[1].x its first row. Sums are taken from left
// to right, the same by `mul` and by `*`: the order is part of the result.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "relief/hlsl/vector.h"

namespace relief::inline RELIEF_WIDTH {

template <int n>
struct LaneMatrix
{
    using V = LaneVector<Float, n>;

    LaneMatrix() = default;
    LaneMatrix(const V& a, const V& b, const V& c) requires(n == 3) : columns{a, b, c} {}
    LaneMatrix(const V& a, const V& b, const V& c, const V& d) requires(n == 4) : columns{a, b, c, d} {}
    LaneMatrix(const glm::mat3& m) requires(n == 3) : columns{m[0], m[1], m[2]} {}
    LaneMatrix(const glm::mat4& m) requires(n == 4) : columns{m[0], m[1], m[2], m[3]} {}

    // HLSL: (float3x3)m
    template <int more>
    explicit LaneMatrix(const LaneMatrix<more>& m) requires(more == 4 && n == 3)
        : columns{m[0].xyz(), m[1].xyz(), m[2].xyz()}
    {
    }

    V& operator[](int i) { return columns[i]; }
    const V& operator[](int i) const { return columns[i]; }

    // A vector is a column on the right, and a row on the left.
    friend V mul(const LaneMatrix& m, const V& v)
    {
        if constexpr (n == 3) return m[0] * v.x + m[1] * v.y + m[2] * v.z;
        if constexpr (n == 4) return m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3] * v.w;
    }
    friend V mul(const V& v, const LaneMatrix& m)
    {
        if constexpr (n == 3) return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2])};
        if constexpr (n == 4) return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2]), dot(v, m[3])};
    }
    friend LaneMatrix mul(const LaneMatrix& a, const LaneMatrix& b)
    {
        if constexpr (n == 3) return {mul(a, b[0]), mul(a, b[1]), mul(a, b[2])};
        if constexpr (n == 4) return {mul(a, b[0]), mul(a, b[1]), mul(a, b[2]), mul(a, b[3])};
    }

    friend LaneMatrix mul(const LaneMatrix& m, Float s)
    {
        if constexpr (n == 3) return {m[0] * s, m[1] * s, m[2] * s};
        if constexpr (n == 4) return {m[0] * s, m[1] * s, m[2] * s, m[3] * s};
    }
    friend LaneMatrix mul(Float s, const LaneMatrix& m) { return mul(m, s); }
    template <Number N>
    friend LaneMatrix mul(const LaneMatrix& m, N s)
    {
        return mul(m, Float(s));
    }
    template <Number N>
    friend LaneMatrix mul(N s, const LaneMatrix& m)
    {
        return mul(m, Float(s));
    }

    friend V operator*(const LaneMatrix& m, const V& v) { return mul(m, v); }
    friend V operator*(const V& v, const LaneMatrix& m) { return mul(v, m); }
    friend LaneMatrix operator*(const LaneMatrix& a, const LaneMatrix& b) { return mul(a, b); }
    friend LaneMatrix operator+(const LaneMatrix& a, const LaneMatrix& b)
    {
        if constexpr (n == 3) return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
        if constexpr (n == 4) return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
    }
    friend LaneMatrix operator-(const LaneMatrix& a, const LaneMatrix& b)
    {
        if constexpr (n == 3) return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        if constexpr (n == 4) return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
    }
    friend LaneMatrix operator-(const LaneMatrix& m)
    {
        if constexpr (n == 3) return {-m[0], -m[1], -m[2]};
        if constexpr (n == 4) return {-m[0], -m[1], -m[2], -m[3]};
    }

    V columns[n];
};

// A plain matrix of GLM beside a vector.
template <int n>
LaneVector<Float, n> mul(const glm::mat<n, n, float>& m, const LaneVector<Float, n>& v)
{
    return mul(LaneMatrix<n>(m), v);
}
template <int n>
LaneVector<Float, n> mul(const LaneVector<Float, n>& v, const glm::mat<n, n, float>& m)
{
    return mul(v, LaneMatrix<n>(m));
}

// The rows of m as columns.
inline LaneMatrix<3> transpose(const LaneMatrix<3>& m)
{
    return {{m[0].x, m[1].x, m[2].x}, {m[0].y, m[1].y, m[2].y}, {m[0].z, m[1].z, m[2].z}};
}
inline LaneMatrix<4> transpose(const LaneMatrix<4>& m)
{
    return {{m[0].x, m[1].x, m[2].x, m[3].x},
            {m[0].y, m[1].y, m[2].y, m[3].y},
            {m[0].z, m[1].z, m[2].z, m[3].z},
            {m[0].w, m[1].w, m[2].w, m[3].w}};
}

// By the cofactors of the first column, those of four rows by pairs of rows.
inline Float determinant(const LaneMatrix<3>& m)
{
    return m[0].x * (m[1].y * m[2].z - m[2].y * m[1].z) + m[0].y * (m[1].z * m[2].x - m[2].z * m[1].x) +
           m[0].z * (m[1].x * m[2].y - m[2].x * m[1].y);
}
inline Float determinant(const LaneMatrix<4>& m)
{
    const auto minor = [&m](int a, int b, int row, int other) {
        return m[a][row] * m[b][other] - m[b][row] * m[a][other];
    };
    return minor(0, 1, 0, 1) * minor(2, 3, 2, 3) - minor(0, 1, 0, 2) * minor(2, 3, 1, 3) +
           minor(0, 1, 0, 3) * minor(2, 3, 1, 2) + minor(0, 1, 1, 2) * minor(2, 3, 0, 3) -
           minor(0, 1, 1, 3) * minor(2, 3, 0, 2) + minor(0, 1, 2, 3) * minor(2, 3, 0, 1);
}

}  // namespace relief::inline RELIEF_WIDTH
