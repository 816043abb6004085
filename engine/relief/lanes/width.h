// How many pixels a block has, and which pixel each lane is. One value of a shader variable is held for every pixel of
// a block: 4 lanes (2x2 pixels), 8 (4x2) or 16 (4x4). A quad (2x2 pixels, the unit of derivatives) is always whole and
// always four neighbouring lanes:
//
//     16 lanes, 4x4:    0  1 |  4  5        8 lanes, 4x2:    0  1 |  4  5        4 lanes, 2x2:    0  1
//                       2  3 |  6  7                         2  3 |  6  7                         2  3
//                       8  9 | 12 13
//                      10 11 | 14 15
//
// The results do not depend on the width; the speed does. The default is the widest that the target has in hardware.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "compile without -ffast-math: it lets the compiler change the order of sums and drop NaN, and so the picture"
#endif

#if !defined(RELIEF_OPTIONS)
#error \
    "compile with the flags that Relief's bits depend on: in CMake link relief::engine, elsewhere `pkg-config --cflags relief`"
#endif

#if !defined(RELIEF_LANES)
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define RELIEF_LANES 16
#elif defined(__AVX2__)
#define RELIEF_LANES 8
#else
#define RELIEF_LANES 4
#endif
#endif

// g++ turns vectors wider than the instruction set into scalar code, 2.5 to 5 times slower: refuse to build that.
#if RELIEF_LANES == 16 && !(defined(__AVX512F__) && defined(__AVX512DQ__))
#error "RELIEF_LANES=16 needs AVX-512 (F and DQ): build with -march=native on such a machine, or choose 4 or 8"
#elif RELIEF_LANES == 8 && !defined(__AVX2__)
#error "RELIEF_LANES=8 needs AVX2: build with -march=x86-64-v3 or choose 4"
#elif RELIEF_LANES != 4 && RELIEF_LANES != 8 && RELIEF_LANES != 16
#error "RELIEF_LANES must be 4, 8 or 16"
#endif

// Everything that depends on the width lies in a namespace named after it, within relief: a program that is compiled
// for another width than the library does not link with it, instead of drawing nothing.
#if RELIEF_LANES == 16
#define RELIEF_WIDTH lanes16
#elif RELIEF_LANES == 8
#define RELIEF_WIDTH lanes8
#else
#define RELIEF_WIDTH lanes4
#endif

namespace relief::inline RELIEF_WIDTH {

inline constexpr int kLanes = RELIEF_LANES;
inline constexpr int kBlockWidth = kLanes == 4 ? 2 : 4;    // pixels
inline constexpr int kBlockHeight = kLanes == 16 ? 4 : 2;  // pixels
inline constexpr unsigned kAllLanes = kLanes == 16 ? 0xffffu : kLanes == 8 ? 0xffu : 0xfu;

// The pixel of a lane, counted from the block's upper left pixel.
constexpr int laneX(int lane)
{
    return (lane & 1) + (lane & 4) / 2;
}
constexpr int laneY(int lane)
{
    return (lane & 2) / 2 + (lane & 8) / 4;
}

// The lane of a pixel.
constexpr int laneAt(int x, int y)
{
    return (x & 1) + (x & 2) * 2 + (y & 1) * 2 + (y & 2) * 4;
}

}  // namespace relief::inline RELIEF_WIDTH
