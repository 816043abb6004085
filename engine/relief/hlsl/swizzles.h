// The components of a vector under HLSL's names, and its swizzles: v.xzy(), c.rgb(), v.wwxy(), all that are two to four
// letters long. A swizzle is a function that returns a copy; it cannot be assigned to.
#pragma once

#include "relief/lanes/width.h"

namespace relief::inline RELIEF_WIDTH {

template <class T, int n>
struct LaneVector;

namespace detail {

// Plain member functions, written by macros: a compiler reads them in a few milliseconds. `SECOND` goes through all
// second letters after a, `THIRD` through all third letters after a and b, and so on.
// clang-format off
#define RELIEF_TWO(a, b) LaneVector<T, 2> a##b() const { return {a, b}; }
#define RELIEF_THREE(a, b, c) LaneVector<T, 3> a##b##c() const { return {a, b, c}; }
#define RELIEF_FOUR(a, b, c, d) LaneVector<T, 4> a##b##c##d() const { return {a, b, c, d}; }

#define RELIEF_FOURTH2(a, b, c, x, y) RELIEF_FOUR(a, b, c, x) RELIEF_FOUR(a, b, c, y)
#define RELIEF_THIRD2(a, b, x, y) \
    RELIEF_THREE(a, b, x) RELIEF_THREE(a, b, y) RELIEF_FOURTH2(a, b, x, x, y) RELIEF_FOURTH2(a, b, y, x, y)
#define RELIEF_SECOND2(a, x, y) \
    RELIEF_TWO(a, x) RELIEF_TWO(a, y) RELIEF_THIRD2(a, x, x, y) RELIEF_THIRD2(a, y, x, y)
#define RELIEF_SWIZZLES2(x, y) RELIEF_SECOND2(x, x, y) RELIEF_SECOND2(y, x, y)

#define RELIEF_FOURTH3(a, b, c, x, y, z) RELIEF_FOURTH2(a, b, c, x, y) RELIEF_FOUR(a, b, c, z)
#define RELIEF_THIRD3(a, b, x, y, z) \
    RELIEF_THREE(a, b, x) RELIEF_THREE(a, b, y) RELIEF_THREE(a, b, z) \
    RELIEF_FOURTH3(a, b, x, x, y, z) RELIEF_FOURTH3(a, b, y, x, y, z) RELIEF_FOURTH3(a, b, z, x, y, z)
#define RELIEF_SECOND3(a, x, y, z) \
    RELIEF_TWO(a, x) RELIEF_TWO(a, y) RELIEF_TWO(a, z) \
    RELIEF_THIRD3(a, x, x, y, z) RELIEF_THIRD3(a, y, x, y, z) RELIEF_THIRD3(a, z, x, y, z)
#define RELIEF_SWIZZLES3(x, y, z) RELIEF_SECOND3(x, x, y, z) RELIEF_SECOND3(y, x, y, z) RELIEF_SECOND3(z, x, y, z)

#define RELIEF_FOURTH4(a, b, c, x, y, z, w) RELIEF_FOURTH3(a, b, c, x, y, z) RELIEF_FOUR(a, b, c, w)
#define RELIEF_THIRD4(a, b, x, y, z, w) \
    RELIEF_THREE(a, b, x) RELIEF_THREE(a, b, y) RELIEF_THREE(a, b, z) RELIEF_THREE(a, b, w) \
    RELIEF_FOURTH4(a, b, x, x, y, z, w) RELIEF_FOURTH4(a, b, y, x, y, z, w) \
    RELIEF_FOURTH4(a, b, z, x, y, z, w) RELIEF_FOURTH4(a, b, w, x, y, z, w)
#define RELIEF_SECOND4(a, x, y, z, w) \
    RELIEF_TWO(a, x) RELIEF_TWO(a, y) RELIEF_TWO(a, z) RELIEF_TWO(a, w) \
    RELIEF_THIRD4(a, x, x, y, z, w) RELIEF_THIRD4(a, y, x, y, z, w) \
    RELIEF_THIRD4(a, z, x, y, z, w) RELIEF_THIRD4(a, w, x, y, z, w)
#define RELIEF_SWIZZLES4(x, y, z, w) \
    RELIEF_SECOND4(x, x, y, z, w) RELIEF_SECOND4(y, x, y, z, w) \
    RELIEF_SECOND4(z, x, y, z, w) RELIEF_SECOND4(w, x, y, z, w)
// clang-format on

template <class T, int n>
struct Components;

template <class T>
struct Components<T, 2>
{
    Components() = default;
    Components(T first, T second) : x(first), y(second) {}

    // clang-format off
    union { T x, r; };
    union { T y, g; };
    // clang-format on

    RELIEF_SWIZZLES2(x, y)
    RELIEF_SWIZZLES2(r, g)
};

template <class T>
struct Components<T, 3>
{
    Components() = default;
    Components(T first, T second, T third) : x(first), y(second), z(third) {}

    // clang-format off
    union { T x, r; };
    union { T y, g; };
    union { T z, b; };
    // clang-format on

    RELIEF_SWIZZLES3(x, y, z)
    RELIEF_SWIZZLES3(r, g, b)
};

template <class T>
struct Components<T, 4>
{
    Components() = default;
    Components(T first, T second, T third, T fourth) : x(first), y(second), z(third), w(fourth) {}

    // clang-format off
    union { T x, r; };
    union { T y, g; };
    union { T z, b; };
    union { T w, a; };
    // clang-format on

    RELIEF_SWIZZLES4(x, y, z, w)
    RELIEF_SWIZZLES4(r, g, b, a)
};

#undef RELIEF_TWO
#undef RELIEF_THREE
#undef RELIEF_FOUR
#undef RELIEF_SECOND2
#undef RELIEF_SECOND3
#undef RELIEF_SECOND4
#undef RELIEF_THIRD2
#undef RELIEF_THIRD3
#undef RELIEF_THIRD4
#undef RELIEF_FOURTH2
#undef RELIEF_FOURTH3
#undef RELIEF_FOURTH4
#undef RELIEF_SWIZZLES2
#undef RELIEF_SWIZZLES3
#undef RELIEF_SWIZZLES4

}  // namespace detail

}  // namespace relief::inline RELIEF_WIDTH
