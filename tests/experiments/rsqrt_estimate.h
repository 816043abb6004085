// The processor's estimate of 1 / sqrt(x), for experiments only: its last bits differ between makers, so nothing that
// draws may use it. Where a processor has none, a number of the same quality stands in, rounded to 11 bits.
#pragma once

#include "relief/lanes/math.h"
#if defined(__SSE__)
#include <immintrin.h>
#endif

namespace relief::experiments {

inline Float rsqrtEstimate(Float x)
{
    Float result = x;
#if RELIEF_LANES == 16 || RELIEF_LANES == 8
    // Eight at a time: 512-bit vectors have a finer estimate only, of 14 bits.
    for (int lane = 0; lane < kLanes; lane += 8) {
        __m256 eight;
        std::memcpy(&eight, reinterpret_cast<const char*>(&x.value) + lane * 4, sizeof eight);
        eight = _mm256_rsqrt_ps(eight);
        std::memcpy(reinterpret_cast<char*>(&result.value) + lane * 4, &eight, sizeof eight);
    }
#elif defined(__SSE__)
    result.value = (native::FloatVector)_mm_rsqrt_ps((__m128)x.value);
#else
    result = asFloat((asInt(1.0f / sqrt(x)) + 0x800) & ~0xfff);
#endif
    return result;
}

// One step of Newton's method on it: y (3 - x y^2) / 2.
inline Float rsqrtRefined(Float x)
{
    const Float y = rsqrtEstimate(x);
    return y * (1.5f - 0.5f * x * y * y);
}

}  // namespace relief::experiments
