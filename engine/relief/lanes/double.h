// Double: one 64-bit float for every pixel of a block, in two registers. It holds integers up to 2^53 exactly, which
// is what the edge functions of large triangles need (pipeline/edge_function.h); it is no shader type.
#pragma once

#include "relief/lanes/float.h"

namespace relief::inline RELIEF_WIDTH {

class Double
{
public:
    Double() = default;
    Double(double number) : low(number - native::DoubleVector{}), high(low) {}
    Double(native::DoubleVector l, native::DoubleVector h) : low(l), high(h) {}
    explicit Double(Int i) : low(native::lowToDouble(i.value)), high(native::highToDouble(i.value)) {}

    double operator[](int lane) const { return lane < kLanes / 2 ? low[lane] : high[lane - kLanes / 2]; }

    friend Double operator+(Double a, Double b) { return {a.low + b.low, a.high + b.high}; }
    friend Double operator-(Double a, Double b) { return {a.low - b.low, a.high - b.high}; }
    friend Double operator*(Double a, Double b) { return {a.low * b.low, a.high * b.high}; }

    native::DoubleVector low, high;
};

// To the nearest float.
inline Float toFloat(Double a)
{
    return Float(native::toFloat(a.low, a.high));
}

// Bit i is set where lane i is below zero.
inline unsigned negativeBits(Double a)
{
    return native::negativeBits(a.low, a.high);
}

}  // namespace relief::inline RELIEF_WIDTH
