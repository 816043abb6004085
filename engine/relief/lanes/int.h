// Int: one 32-bit signed integer for every pixel of a block: texel addresses, snapped coordinates, edge values.
// Sums, differences, products and quotients wrap around. A float beside it is no Int: Float(i) * 0.5f.
#pragma once

#include <utility>

#include "relief/lanes/mask.h"
#include "relief/lanes/number.h"

namespace relief::inline RELIEF_WIDTH {

class Int
{
public:
    Int() = default;
    template <WholeNumber N>
    constexpr Int(N number) : value(native::IntVector{} + static_cast<std::int32_t>(number))
    {
        static_assert(sizeof(N) <= sizeof(std::int32_t), "an Int has 32 bits: convert the number first");
    }
    explicit Int(native::IntVector native) : value(native) {}

    static Int load(const std::int32_t* lanes)
    {
        Int r;
        std::memcpy(&r.value, lanes, sizeof r.value);
        return r;
    }
    void store(std::int32_t* lanes) const { std::memcpy(lanes, &value, sizeof value); }

    std::int32_t operator[](int lane) const { return value[lane]; }
    void set(int lane, std::int32_t number) { value[lane] = number; }

    friend Int operator+(Int a, Int b) { return fromUnsigned(a.asUnsigned() + b.asUnsigned()); }
    friend Int operator-(Int a, Int b) { return fromUnsigned(a.asUnsigned() - b.asUnsigned()); }
    friend Int operator*(Int a, Int b) { return fromUnsigned(a.asUnsigned() * b.asUnsigned()); }
    friend Int operator-(Int a) { return Int(0) - a; }
    friend Int operator&(Int a, Int b) { return Int(a.value & b.value); }
    friend Int operator|(Int a, Int b) { return Int(a.value | b.value); }
    friend Int operator^(Int a, Int b) { return Int(a.value ^ b.value); }
    friend Int operator~(Int a) { return Int(~a.value); }
    // By a number of which the lowest five bits count, as of each pixel's own number below.
    friend Int operator<<(Int a, int bits) { return Int(a.value << (bits & 31)); }
    friend Int operator>>(Int a, int bits) { return Int(a.value >> (bits & 31)); }  // keeps the sign
    Int& operator+=(Int b) { return *this = *this + b; }
    Int& operator-=(Int b) { return *this = *this - b; }
    Int& operator*=(Int b) { return *this = *this * b; }
    Int& operator&=(Int b) { return *this = *this & b; }
    Int& operator|=(Int b) { return *this = *this | b; }
    Int& operator^=(Int b) { return *this = *this ^ b; }

    friend Mask operator<(Int a, Int b) { return Mask(native::less(a.value, b.value)); }
    friend Mask operator>(Int a, Int b) { return b < a; }
    friend Mask operator<=(Int a, Int b) { return !(b < a); }
    friend Mask operator>=(Int a, Int b) { return !(a < b); }
    friend Mask operator==(Int a, Int b) { return Mask(native::equal(a.value, b.value)); }
    friend Mask operator!=(Int a, Int b) { return !(a == b); }

    native::IntVector value;

private:
    native::UintVector asUnsigned() const { return (native::UintVector)value; }
    static Int fromUnsigned(native::UintVector v) { return Int((native::IntVector)v); }
};

// By each pixel's own number, of which the lowest five bits count.
inline Int operator<<(Int a, Int bits)
{
    return Int(a.value << (bits.value & 31));
}
inline Int operator>>(Int a, Int bits)
{
    return Int(a.value >> (bits.value & 31));
}
inline Int& operator<<=(Int& a, Int bits)
{
    return a = a << bits;
}
inline Int& operator>>=(Int& a, Int bits)
{
    return a = a >> bits;
}

// Toward zero, one pixel after the other: processors divide no vectors of integers. Divided by 0: -1, and the rest is
// all of it.
inline Int operator/(Int a, Int b)
{
    Int quotient;
    for (int i = 0; i < kLanes; ++i)
        quotient.set(i, b[i] == 0 ? -1 : static_cast<std::int32_t>(std::int64_t{a[i]} / b[i]));
    return quotient;
}
inline Int operator%(Int a, Int b)
{
    return a - a / b * b;
}
inline Int& operator/=(Int& a, Int b)
{
    return a = a / b;
}
inline Int& operator%=(Int& a, Int b)
{
    return a = a % b;
}

inline Int select(Mask m, Int a, Int b)
{
    return Int(native::select(m.value, a.value, b.value));
}
inline Int min(Int a, Int b)
{
    return Int(native::min(a.value, b.value));
}
inline Int max(Int a, Int b)
{
    return Int(native::max(a.value, b.value));
}
inline Int clamp(Int a, Int low, Int high)
{
    return min(max(a, low), high);
}
inline Int shiftRightLogical(Int a, int bits)
{
    return Int((native::IntVector)((native::UintVector)a.value >> (static_cast<unsigned>(bits) & 31)));
}

// The upper byte of each 16-bit half, as that half.
inline Int upperBytes(Int a)
{
    return Int((native::IntVector)((native::HalfVector)a.value >> 8));
}

// The low halves' product plus the high halves', halves taken as signed 16-bit numbers. No overflow but for
// -32768 in all four.
inline Int multiplyAddHalves(Int a, Int b)
{
    return Int(native::multiplyAddHalves(a.value, b.value));
}

// Bit i is set where lane i is negative.
inline unsigned signBits(Int a)
{
    return native::signBits(a.value) & kAllLanes;
}

namespace detail {

struct LanePixels
{
    alignas(64) std::int32_t x[kLanes], y[kLanes];
};

inline constexpr LanePixels kLanePixels = [] {
    LanePixels pixels{};
    for (int i = 0; i < kLanes; ++i) {
        pixels.x[i] = laneX(i);
        pixels.y[i] = laneY(i);
    }
    return pixels;
}();

}  // namespace detail

// The block's pixels row after row, from left to right.
inline Int inRows(Int a)
{
    return [a]<int... i>(std::integer_sequence<int, i...>)
    {
        return Int(native::shuffle<laneAt(i % kBlockWidth, i / kBlockWidth)...>(a.value, a.value));
    }
    (std::make_integer_sequence<int, kLanes>());
}

// From there back.
inline Int fromRows(Int a)
{
    return [a]<int... i>(std::integer_sequence<int, i...>)
    {
        return Int(native::shuffle<laneY(i) * kBlockWidth + laneX(i)...>(a.value, a.value));
    }
    (std::make_integer_sequence<int, kLanes>());
}

// Lane i of the result is lane from[i] of a, in 0..kLanes - 1.
inline Int permute(Int a, Int from)
{
    return Int(native::permute(a.value, from.value));
}

// Every lane's pixel, counted from the block's upper left one.
inline Int laneXs()
{
    return Int::load(detail::kLanePixels.x);
}
inline Int laneYs()
{
    return Int::load(detail::kLanePixels.y);
}

}  // namespace relief::inline RELIEF_WIDTH
