// Mask: one yes or no for every pixel of a block: what a comparison of lanes gives, and what select() chooses by.
// There is no conversion to bool, on purpose: ask any(), all() or none().
#pragma once

#include <bit>

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH {

class Mask
{
public:
    Mask() = default;
    Mask(bool all) : value(native::maskFromBits(all ? kAllLanes : 0u)) {}
    explicit Mask(native::MaskVector native) : value(native) {}

    // Lane i from bit i; and back.
    static Mask fromBits(unsigned bits) { return Mask(native::maskFromBits(bits)); }
    unsigned bits() const { return native::maskBits(value) & kAllLanes; }
    bool operator[](int lane) const { return (bits() >> lane & 1u) != 0; }

    friend Mask operator&(Mask a, Mask b) { return Mask(native::maskAnd(a.value, b.value)); }
    friend Mask operator|(Mask a, Mask b) { return Mask(native::maskOr(a.value, b.value)); }
    friend Mask operator!(Mask a) { return Mask(native::maskNot(a.value)); }
    friend Mask operator^(Mask a, Mask b) { return (a | b) & !(a & b); }
    friend Mask operator!=(Mask a, Mask b) { return a ^ b; }
    friend Mask operator==(Mask a, Mask b) { return !(a ^ b); }
    Mask& operator&=(Mask other) { return *this = *this & other; }
    Mask& operator|=(Mask other) { return *this = *this | other; }

    native::MaskVector value;
};

inline bool any(Mask m)
{
    return m.bits() != 0;
}
inline bool all(Mask m)
{
    return m.bits() == kAllLanes;
}
inline bool none(Mask m)
{
    return m.bits() == 0;
}

inline Mask select(Mask m, Mask a, Mask b)
{
    return (m & a) | ((!m) & b);
}

// How many of a block's bits are set. Plain x86-64 has no instruction for it; of four bits, a table in a register
// knows.
constexpr int countBits(unsigned bits)
{
    if constexpr (kLanes == 4) return static_cast<int>(0x4332322132212110u >> (4 * bits & 0x3fu) & 0xfu);
    return std::popcount(bits);
}
inline int count(Mask m)
{
    return countBits(m.bits());
}

// The quads of which at least one pixel is set, whole: the pixels that must be computed for derivatives to exist.
constexpr unsigned wholeQuads(unsigned bits)
{
    const unsigned pairs = bits | bits >> 1;
    return ((pairs | pairs >> 2) & 0x1111u) * 0xfu;
}

}  // namespace relief::inline RELIEF_WIDTH
