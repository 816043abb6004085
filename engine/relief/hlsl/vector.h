// LaneVector<T, n>: two, three or four values of lanes; T is Float, Int or Mask. float3 is LaneVector<Float, 3>, see
// types.h.
//
// An operator is one function of two vectors. Whatever else may stand beside a vector becomes one first: a number or a
// single value in every component, a plain vector of GLM in every lane, and a field of a shader's struct. Operators are
// friends defined in a class: found for these types alone, and open to conversions, which templates are not.
#pragma once

#include <type_traits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "relief/hlsl/swizzles.h"
#include "relief/hlsl/vector_intrinsics.h"
#include "relief/lanes/float.h"

namespace relief::inline RELIEF_WIDTH {

namespace detail {

// Component by component. The three sizes are written out, because compilers read that faster than loops or helpers.
#define RELIEF_OPERATOR(R, op)                                                          \
    friend R operator op(const V& a, const V& b)                                        \
    {                                                                                   \
        if constexpr (n == 2) return R(a.x op b.x, a.y op b.y);                         \
        if constexpr (n == 3) return R(a.x op b.x, a.y op b.y, a.z op b.z);             \
        if constexpr (n == 4) return R(a.x op b.x, a.y op b.y, a.z op b.z, a.w op b.w); \
    }
#define RELIEF_UNARY_OPERATOR(op)                                       \
    friend V operator op(const V& a)                                    \
    {                                                                   \
        if constexpr (n == 2) return V(op a.x, op a.y);                 \
        if constexpr (n == 3) return V(op a.x, op a.y, op a.z);         \
        if constexpr (n == 4) return V(op a.x, op a.y, op a.z, op a.w); \
    }

// Of numbers: Float has no & | ^ ~ << >>.
template <class T, int n>
struct VectorOperators
{
    using V = LaneVector<T, n>;
    using B = LaneVector<Mask, n>;

    RELIEF_OPERATOR(V, +)
    RELIEF_OPERATOR(V, -)
    RELIEF_OPERATOR(V, *)
    RELIEF_OPERATOR(V, /)
    RELIEF_OPERATOR(V, %)
    RELIEF_OPERATOR(V, &)
    RELIEF_OPERATOR(V, |)
    RELIEF_OPERATOR(V, ^)
    RELIEF_OPERATOR(V, <<)
    RELIEF_OPERATOR(V, >>)
    RELIEF_UNARY_OPERATOR(-)
    RELIEF_UNARY_OPERATOR(~)
    friend V operator+(const V& a) { return a; }

    RELIEF_OPERATOR(B, <)
    RELIEF_OPERATOR(B, <=)
    RELIEF_OPERATOR(B, >)
    RELIEF_OPERATOR(B, >=)
    RELIEF_OPERATOR(B, ==)
    RELIEF_OPERATOR(B, !=)
};

template <int n>
struct VectorOperators<Mask, n>
{
    using V = LaneVector<Mask, n>;

    RELIEF_OPERATOR(V, &)
    RELIEF_OPERATOR(V, |)
    RELIEF_OPERATOR(V, ^)
    RELIEF_OPERATOR(V, ==)
    RELIEF_OPERATOR(V, !=)
    RELIEF_UNARY_OPERATOR(!)
};

#undef RELIEF_OPERATOR
#undef RELIEF_UNARY_OPERATOR

template <class V, class T, int n>
inline constexpr bool kIsPlainVector = false;
template <int n>
inline constexpr bool kIsPlainVector<glm::vec<n, float>, Float, n> = true;

// A vector of `n`, a field that is one, or a plain one of GLM, to be joined with others: no number, since float3(x, 1)
// is a mistake.
template <class V, class T, int n>
concept PartOf = std::is_base_of_v<LaneVector<T, n>, V> || kIsPlainVector<V, T, n>;

}  // namespace detail

template <class T, int n>
struct LaneVector : detail::Components<T, n>, detail::VectorOperators<T, n>, detail::VectorIntrinsics<T, n>
{
    using Base = detail::Components<T, n>;

    LaneVector() = default;
    LaneVector(T first, T second) requires(n == 2) : Base(first, second) {}
    LaneVector(T first, T second, T third) requires(n == 3) : Base(first, second, third) {}
    LaneVector(T first, T second, T third, T fourth) requires(n == 4) : Base(first, second, third, fourth) {}

    // The same in every component; a plain vector in every lane.
    LaneVector(T all) requires(n == 2) : Base(all, all) {}
    LaneVector(T all) requires(n == 3) : Base(all, all, all) {}
    LaneVector(T all) requires(n == 4) : Base(all, all, all, all) {}
    template <detail::NumberFor<T> N>
    LaneVector(N all) : LaneVector(T(all))
    {
    }
    LaneVector(const glm::vec2& v) requires(n == 2 && std::is_same_v<T, Float>) : Base(v.x, v.y) {}
    LaneVector(const glm::vec3& v) requires(n == 3 && std::is_same_v<T, Float>) : Base(v.x, v.y, v.z) {}
    LaneVector(const glm::vec4& v) requires(n == 4 && std::is_same_v<T, Float>) : Base(v.x, v.y, v.z, v.w) {}

    // Of parts.
    template <detail::PartOf<T, 2> Two>
    LaneVector(const Two& v, T third) requires(n == 3) : Base(v.x, v.y, third)
    {
    }
    template <detail::PartOf<T, 2> Two>
    LaneVector(T first, const Two& v) requires(n == 3) : Base(first, v.x, v.y)
    {
    }
    template <detail::PartOf<T, 2> Two>
    LaneVector(const Two& v, T third, T fourth) requires(n == 4) : Base(v.x, v.y, third, fourth)
    {
    }
    template <detail::PartOf<T, 2> Two>
    LaneVector(T first, const Two& v, T fourth) requires(n == 4) : Base(first, v.x, v.y, fourth)
    {
    }
    template <detail::PartOf<T, 2> Two>
    LaneVector(T first, T second, const Two& v) requires(n == 4) : Base(first, second, v.x, v.y)
    {
    }
    template <detail::PartOf<T, 2> Two, detail::PartOf<T, 2> OtherTwo>
    LaneVector(const Two& v, const OtherTwo& u) requires(n == 4) : Base(v.x, v.y, u.x, u.y)
    {
    }
    template <detail::PartOf<T, 3> Three>
    LaneVector(const Three& v, T fourth) requires(n == 4) : Base(v.x, v.y, v.z, fourth)
    {
    }
    template <detail::PartOf<T, 3> Three>
    LaneVector(T first, const Three& v) requires(n == 4) : Base(first, v.x, v.y, v.z)
    {
    }

    // HLSL's cast to other components, (int3)v: toward zero.
    template <class U>
    explicit LaneVector(const LaneVector<U, n>& v) requires(!std::is_same_v<T, U>)
        : LaneVector(detail::each<LaneVector>([](U u) { return detail::castTo<T>(u); }, v))
    {
    }

    // A longer vector is cut off, as in HLSL.
    template <int more>
    LaneVector(const LaneVector<T, more>& v) requires(n == 2 && more > 2) : Base(v.x, v.y)
    {
    }
    template <int more>
    LaneVector(const LaneVector<T, more>& v) requires(n == 3 && more > 3) : Base(v.x, v.y, v.z)
    {
    }

    T& operator[](int i)
    {
        if constexpr (n == 2) return i == 0 ? this->x : this->y;
        if constexpr (n == 3) return i == 0 ? this->x : i == 1 ? this->y : this->z;
        if constexpr (n == 4) return i == 0 ? this->x : i == 1 ? this->y : i == 2 ? this->z : this->w;
    }
    const T& operator[](int i) const { return const_cast<LaneVector&>(*this)[i]; }

    LaneVector& operator+=(const LaneVector& v) { return *this = *this + v; }
    LaneVector& operator-=(const LaneVector& v) { return *this = *this - v; }
    LaneVector& operator*=(const LaneVector& v) { return *this = *this * v; }
    LaneVector& operator/=(const LaneVector& v) { return *this = *this / v; }
    LaneVector& operator&=(const LaneVector& v) { return *this = *this & v; }
    LaneVector& operator|=(const LaneVector& v) { return *this = *this | v; }
    LaneVector& operator%=(const LaneVector& v) { return *this = *this % v; }
    LaneVector& operator^=(const LaneVector& v) { return *this = *this ^ v; }
    LaneVector& operator<<=(const LaneVector& v) { return *this = *this << v; }
    LaneVector& operator>>=(const LaneVector& v) { return *this = *this >> v; }
};

// Plain vectors of GLM beside single values: none of them is a vector of lanes yet.
#define RELIEF_PLAIN const glm::vec<n, float>&
#define RELIEF_OF_TWO(name, A, B)       \
    template <int n>                    \
    LaneVector<Float, n> name(A a, B b) \
    {                                   \
        using V = LaneVector<Float, n>; \
        return name(V(a), V(b));        \
    }
#define RELIEF_OF_THREE(name, A, B, C)       \
    template <int n>                         \
    LaneVector<Float, n> name(A a, B b, C c) \
    {                                        \
        using V = LaneVector<Float, n>;      \
        return name(V(a), V(b), V(c));       \
    }
#define RELIEF_OF_PLAIN_TWO(name)            \
    RELIEF_OF_TWO(name, RELIEF_PLAIN, Float) \
    RELIEF_OF_TWO(name, Float, RELIEF_PLAIN)
#define RELIEF_OF_PLAIN_THREE(name)                          \
    RELIEF_OF_THREE(name, RELIEF_PLAIN, RELIEF_PLAIN, Float) \
    RELIEF_OF_THREE(name, RELIEF_PLAIN, Float, RELIEF_PLAIN) \
    RELIEF_OF_THREE(name, Float, RELIEF_PLAIN, RELIEF_PLAIN) \
    RELIEF_OF_THREE(name, RELIEF_PLAIN, Float, Float)        \
    RELIEF_OF_THREE(name, Float, RELIEF_PLAIN, Float)        \
    RELIEF_OF_THREE(name, Float, Float, RELIEF_PLAIN)

RELIEF_OF_PLAIN_TWO(operator+)
RELIEF_OF_PLAIN_TWO(operator-)
RELIEF_OF_PLAIN_TWO(operator*)
RELIEF_OF_PLAIN_TWO(operator/)
RELIEF_OF_PLAIN_TWO(min)
RELIEF_OF_PLAIN_TWO(max)
RELIEF_OF_PLAIN_TWO(step)
RELIEF_OF_PLAIN_TWO(pow)
RELIEF_OF_PLAIN_TWO(fmod)
RELIEF_OF_PLAIN_TWO(atan2)
RELIEF_OF_PLAIN_TWO(ldexp)
RELIEF_OF_PLAIN_THREE(clamp)
RELIEF_OF_PLAIN_THREE(lerp)
RELIEF_OF_PLAIN_THREE(smoothstep)
RELIEF_OF_PLAIN_THREE(mad)

#undef RELIEF_PLAIN
#undef RELIEF_OF_TWO
#undef RELIEF_OF_THREE
#undef RELIEF_OF_PLAIN_TWO
#undef RELIEF_OF_PLAIN_THREE

template <int n>
LaneVector<Float, n> mul(const glm::vec<n, float>& v, Float s)
{
    return v * s;
}
template <int n>
LaneVector<Float, n> mul(Float s, const glm::vec<n, float>& v)
{
    return s * v;
}

template <int n>
LaneVector<Float, n> refract(const glm::vec<n, float>& incident, const glm::vec<n, float>& normal, Float eta)
{
    return refract(LaneVector<Float, n>(incident), LaneVector<Float, n>(normal), eta);
}

// By a mask of pixels, or of components.
template <int n>
LaneVector<Float, n> select(const std::type_identity_t<LaneVector<Mask, n>>& m, const glm::vec<n, float>& a,
                            const glm::vec<n, float>& b)
{
    return select(m, LaneVector<Float, n>(a), LaneVector<Float, n>(b));
}
template <int n>
LaneVector<Float, n> select(const std::type_identity_t<LaneVector<Mask, n>>& m, const glm::vec<n, float>& a, Float b)
{
    return select(m, LaneVector<Float, n>(a), LaneVector<Float, n>(b));
}
template <int n>
LaneVector<Float, n> select(const std::type_identity_t<LaneVector<Mask, n>>& m, Float a, const glm::vec<n, float>& b)
{
    return select(m, LaneVector<Float, n>(a), LaneVector<Float, n>(b));
}

}  // namespace relief::inline RELIEF_WIDTH
