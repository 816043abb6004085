// The operations on compiler vectors that everything above this folder is written with. What compilers turn into one
// instruction for every instruction set and width stands here, once: + - * / and comparisons, conversions, shuffles.
// What they do not (minimum and maximum, square root, rounding, masks, doubles, moving a quad) has a file per
// instruction set. (g++ 12 makes one instruction of a < b ? a : b alone, but two of it among others.) Each function
// gives the same bits in all of them: that is what tests/lanes.cpp checks.
//
// This folder is the only place in the engine that knows an instruction set by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "relief/lanes/width.h"

namespace relief::inline RELIEF_WIDTH::native {

typedef float FloatVector __attribute__((vector_size(4 * kLanes)));
typedef std::int32_t IntVector __attribute__((vector_size(4 * kLanes)));
typedef std::uint32_t UintVector __attribute__((vector_size(4 * kLanes)));
typedef std::uint16_t HalfVector __attribute__((vector_size(4 * kLanes)));  // two in each lane
typedef double DoubleVector __attribute__((vector_size(4 * kLanes)));       // half of the lanes
typedef std::int32_t QuadVector __attribute__((vector_size(16)));           // four lanes, or 16 bytes of memory

// A mask is a vector of 0 and -1, except on AVX-512, which has registers for masks.
#if RELIEF_LANES != 16
typedef IntVector MaskVector;

inline MaskVector less(FloatVector a, FloatVector b)
{
    return (MaskVector)(a < b);
}
inline MaskVector lessEqual(FloatVector a, FloatVector b)
{
    return (MaskVector)(a <= b);
}
inline MaskVector equal(FloatVector a, FloatVector b)
{
    return (MaskVector)(a == b);
}
inline MaskVector less(IntVector a, IntVector b)
{
    return (MaskVector)(a < b);
}
inline MaskVector equal(IntVector a, IntVector b)
{
    return (MaskVector)(a == b);
}
inline MaskVector maskAnd(MaskVector a, MaskVector b)
{
    return a & b;
}
inline MaskVector maskOr(MaskVector a, MaskVector b)
{
    return a | b;
}
inline MaskVector maskNot(MaskVector a)
{
    return ~a;
}
inline MaskVector maskFromBits(unsigned bits)
{
    const IntVector lane = []<int... i>(std::integer_sequence<int, i...>)
    {
        return IntVector{(1 << i)...};
    }
    (std::make_integer_sequence<int, kLanes>());
    return equal(lane & static_cast<std::int32_t>(bits), lane);
}
#endif

inline FloatVector toFloat(IntVector a)
{
    return __builtin_convertvector(a, FloatVector);
}
// Toward zero, of numbers that an integer can hold.
#if !defined(__wasm_simd128__) || defined(RELIEF_PORTABLE)
inline IntVector truncateToInt(FloatVector a)
{
    return __builtin_convertvector(a, IntVector);
}
#endif

// Lane i of the result is lane from[i] of a, and from[i] - kLanes of b.
template <int... from, class V>
inline V shuffle(V a, V b)
{
#if __has_builtin(__builtin_shufflevector)
    return __builtin_shufflevector(a, b, from...);
#else
    return __builtin_shuffle(a, b, IntVector{from...});  // g++ 11
#endif
}

namespace detail {

// Where a lane comes from if its place in the quad gets lane k: 0 to 3 of a's quad, 4 to 7 of b's.
constexpr int laneOfQuad(int lane, int k)
{
    return lane / 4 * 4 + (k < 4 ? k : k - 4 + kLanes);
}

template <int k0, int k1, int k2, int k3, class V, int... lane>
inline V shuffleQuads(V a, V b, std::integer_sequence<int, lane...>)
{
    constexpr int k[4] = {k0, k1, k2, k3};
    return shuffle<laneOfQuad(lane, k[lane % 4])...>(a, b);
}

}  // namespace detail

// In every quad the lanes k0, k1, k2 and k3: 0 to 3 are those of a's quad, 4 to 7 those of b's.
template <int k0, int k1, int k2, int k3, class V>
inline V shuffleQuads(V a, V b)
{
    return detail::shuffleQuads<k0, k1, k2, k3>(a, b, std::make_integer_sequence<int, kLanes>());
}
template <int k0, int k1, int k2, int k3>
inline FloatVector permuteQuad(FloatVector a)
{
    return shuffleQuads<k0, k1, k2, k3>(a, a);
}

// Lane i of the result is lane from[i] of a, in 0..kLanes - 1.
#if RELIEF_LANES == 4
inline IntVector permute(IntVector a, IntVector from)
{
    IntVector r = a;
    for (int i = 0; i < kLanes; ++i) r[i] = a[from[i]];
    return r;
}
inline FloatVector permute(FloatVector a, IntVector from)
{
    return (FloatVector)permute((IntVector)a, from);
}
#endif

inline QuadVector loadQuad(const std::byte* address)
{
    QuadVector r;
    std::memcpy(&r, address, sizeof r);
    return r;
}

}  // namespace relief::inline RELIEF_WIDTH::native

// Each of these files has: select; min, max, maxOrNaN; signBits, maskBits; sqrt, floor, roundToInt; permute, where
// there is more than a quad; lowToDouble, highToDouble, toFloat, negativeBits; insertQuad, storeQuads, loadTwoHalves;
// multiplyAddHalves. RELIEF_PORTABLE takes the plain loops on any machine.
#if RELIEF_LANES == 16
#include "relief/lanes/native_avx512.h"
#elif RELIEF_LANES == 8
#include "relief/lanes/native_avx2.h"
#elif defined(__SSE2__) && !defined(RELIEF_PORTABLE)
#include "relief/lanes/native_sse2.h"
#elif defined(__aarch64__) && defined(__ARM_NEON) && !defined(RELIEF_PORTABLE)
#include "relief/lanes/native_neon.h"
#elif defined(__wasm_simd128__) && !defined(RELIEF_PORTABLE)
#include "relief/lanes/native_wasm.h"
#else
#include "relief/lanes/native_portable.h"
#endif

#include "relief/lanes/native_transpose.h"
