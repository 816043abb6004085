// Float: one 32-bit float for every pixel of a block. Used like a float; a plain number next to it is broadcast.
// Only operations that IEEE 754 defines to the last bit are here (lanes/math.h builds the others from them), so the
// result of an expression is the same on every machine and for every number of lanes.
#pragma once

#include <limits>

#include "relief/lanes/int.h"
#include "relief/lanes/mask.h"
#include "relief/lanes/number.h"

namespace relief::inline RELIEF_WIDTH {

class Float
{
public:
    Float() = default;
    template <Number N>
    constexpr Float(N number) : value(static_cast<float>(number) - native::FloatVector{})  // keeps -0
    {
    }
    explicit Float(native::FloatVector native) : value(native) {}
    explicit Float(Int i) : value(native::toFloat(i.value)) {}

    static Float load(const float* lanes)
    {
        Float r;
        std::memcpy(&r.value, lanes, sizeof r.value);
        return r;
    }
    void store(float* lanes) const { std::memcpy(lanes, &value, sizeof value); }

    float operator[](int lane) const { return value[lane]; }
    void set(int lane, float number) { value[lane] = number; }

    friend Float operator+(Float a, Float b) { return Float(a.value + b.value); }
    friend Float operator-(Float a, Float b) { return Float(a.value - b.value); }
    friend Float operator*(Float a, Float b) { return Float(a.value * b.value); }
    friend Float operator/(Float a, Float b) { return Float(a.value / b.value); }
    friend Float operator-(Float a) { return Float(-a.value); }
    friend Float operator+(Float a) { return a; }
    Float& operator+=(Float b) { return *this = *this + b; }
    Float& operator-=(Float b) { return *this = *this - b; }
    Float& operator*=(Float b) { return *this = *this * b; }
    Float& operator/=(Float b) { return *this = *this / b; }

    // Comparisons with NaN are false, except !=.
    friend Mask operator<(Float a, Float b) { return Mask(native::less(a.value, b.value)); }
    friend Mask operator<=(Float a, Float b) { return Mask(native::lessEqual(a.value, b.value)); }
    friend Mask operator>(Float a, Float b) { return b < a; }
    friend Mask operator>=(Float a, Float b) { return b <= a; }
    friend Mask operator==(Float a, Float b) { return Mask(native::equal(a.value, b.value)); }
    friend Mask operator!=(Float a, Float b) { return !(a == b); }

    native::FloatVector value;
};

inline Float select(Mask m, Float a, Float b)
{
    return Float(native::select(m.value, a.value, b.value));
}
inline Mask isnan(Float a)
{
    return a != a;
}
inline Mask isfinite(Float a)
{
    return a - a == 0.0f;
}
inline Mask isinf(Float a)
{
    return (a - a != 0.0f) & (a == a);
}

inline Int asInt(Float a)
{
    return Int((native::IntVector)a.value);
}
inline Float asFloat(Int a)
{
    return Float((native::FloatVector)a.value);
}

// The NaN that exp, log, sin and their like give (math.h, trigonometry.h). An operation of the processor gives one of
// the other sign, and a compiler that works the operation out beforehand may give either: a written one is the same in
// every build.
inline Float quietNan()
{
    return asFloat(Int(0x7fc00000));
}

// HLSL's asint: as asInt, but every NaN is the one above, because the bits of others depend on the build.
inline Int asint(Float a)
{
    return select(isnan(a), Int(0x7fc00000), asInt(a));
}
inline Float asfloat(Int a)
{
    return asFloat(a);
}

// a with the sign of b, that of a zero included.
inline Float copySign(Float a, Float b)
{
    return asFloat((asInt(a) & 0x7fffffff) | (asInt(b) & Int(std::numeric_limits<std::int32_t>::min())));
}

inline Float abs(Float a)
{
    return asFloat(asInt(a) & 0x7fffffff);
}
inline Float sqrt(Float a)
{
    return Float(native::sqrt(a.value));
}
inline Float floor(Float a)
{
    return Float(native::floor(a.value));
}
inline Float ceil(Float a)
{
    return -floor(-a);
}
inline Float frac(Float a)
{
    return a - floor(a);
}
inline Float trunc(Float a)
{
    return copySign(floor(abs(a)), a);
}
// To the nearest integer, ties to even. From 2^23 on floats are whole; below, adding 2^23 leaves no room for fractions.
inline Float round(Float a)
{
    const Float whole = abs(a) + 8388608.0f - 8388608.0f;
    return select(abs(a) < 8388608.0f, copySign(whole, a), a);
}

// The number, where one of the two is NaN (IEEE 754-2019 minimumNumber; D3D 11.3, 22.19).
inline Float min(Float a, Float b)
{
    return select(isnan(b), a, Float(native::min(a.value, b.value)));
}
inline Float max(Float a, Float b)
{
    return select(isnan(b), a, Float(native::max(a.value, b.value)));
}

// NaN becomes the lower limit: `native::max` gives its second operand where the first is NaN.
inline Float clamp(Float a, Float low, Float high)
{
    return Float(native::min(native::max(a.value, low.value), high.value));
}
inline Float saturate(Float a)
{
    return clamp(a, 0.0f, 1.0f);
}

// To the nearest integer, ties to even; toward zero. Clamped to +-2147483520 first, the largest float below 2^31;
// NaN becomes the lower limit.
inline Int roundToInt(Float a)
{
    return Int(native::roundToInt(clamp(a, -2147483520.0f, 2147483520.0f).value));
}
inline Int truncateToInt(Float a)
{
    return Int(native::truncateToInt(clamp(a, -2147483520.0f, 2147483520.0f).value));
}

// Lane i of the result is lane from[i] of a, in 0..kLanes - 1.
inline Float permute(Float a, Int from)
{
    return Float(native::permute(a.value, from.value));
}

// Rearranges every quad (upper left, upper right, lower left, lower right): its lane k becomes its lane a<k>.
template <int a0, int a1, int a2, int a3>
Float permuteQuad(Float a)
{
    return Float(native::permuteQuad<a0, a1, a2, a3>(a.value));
}

}  // namespace relief::inline RELIEF_WIDTH
