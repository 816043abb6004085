// What a * b + c costs for floats, by SSE2 alone: rounded twice, as Relief does it; and rounded once, as hardware with
// FMA does it: by libm, and by doubles, four numbers at a time. See docs/performance.md.
//
//     g++ -std=c++20 -O3 -march=x86-64 -ffp-contract=off docs/report/fused_multiply_add.cpp -o /tmp/fused
//     GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2_Usable /tmp/fused
//
// Without the second line's setting libm sees what the processor has, and takes its FMA.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include <immintrin.h>

namespace {

constexpr int kCount = 1024;
alignas(16) float a[kCount], b[kCount], c[kCount], result[kCount];

template <class Operation>
[[gnu::always_inline]] inline void forFour(Operation operation)
{
    for (int i = 0; i < kCount; i += 4) {
        _mm_store_ps(result + i, operation(_mm_load_ps(a + i), _mm_load_ps(b + i), _mm_load_ps(c + i)));
    }
}

// The sum of two doubles, rounded to odd: towards zero, and then the last bit set where anything was cut off. Rounded
// to float once more it is the exact sum, rounded once. (S. Boldo, G. Melquiond, "Emulation of a FMA and correctly
// rounded sums", 2008.)
__m128d sumRoundedToOdd(__m128d x, __m128d y)
{
    const __m128d sum = _mm_add_pd(x, y);
    const __m128d yInSum = _mm_sub_pd(sum, x);
    const __m128d error = _mm_add_pd(_mm_sub_pd(x, _mm_sub_pd(sum, yInSum)), _mm_sub_pd(y, yInSum));
    // Where the sum is even and not exact, its odd neighbour on the side of the error.
    const __m128i one = _mm_set_epi32(0, 1, 0, 1);
    const __m128i bits = _mm_castpd_si128(sum);
    const __m128i inexact = _mm_castpd_si128(_mm_cmpneq_pd(error, _mm_setzero_pd()));
    const __m128i step = _mm_and_si128(inexact, _mm_andnot_si128(bits, one));
    const __m128i signs = _mm_srai_epi32(_mm_castpd_si128(_mm_xor_pd(error, sum)), 31);
    const __m128i down = _mm_shuffle_epi32(signs, _MM_SHUFFLE(3, 3, 1, 1));
    return _mm_castsi128_pd(_mm_add_epi64(bits, _mm_sub_epi64(_mm_xor_si128(step, down), down)));
}

// The product of two floats is exact in a double.
__m128 byDoubles(__m128 x, __m128 y, __m128 z)
{
    const auto half = [](__m128 p, __m128 q, __m128 r) {
        return _mm_cvtpd_ps(sumRoundedToOdd(_mm_mul_pd(_mm_cvtps_pd(p), _mm_cvtps_pd(q)), _mm_cvtps_pd(r)));
    };
    return _mm_movelh_ps(half(x, y, z), half(_mm_movehl_ps(x, x), _mm_movehl_ps(y, y), _mm_movehl_ps(z, z)));
}

[[gnu::noinline]] void roundTwice()
{
    forFour([](__m128 x, __m128 y, __m128 z) { return _mm_add_ps(_mm_mul_ps(x, y), z); });
}

[[gnu::noinline]] void roundOnceByDoubles()
{
    forFour(byDoubles);
}

[[gnu::noinline]] void roundOnceByLibm()
{
    for (int i = 0; i < kCount; ++i) result[i] = __builtin_fmaf(a[i], b[i], c[i]);
}

double nanoseconds(void (*compute)())
{
    double best = 1e9;
    for (int round = 0; round < 40; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < 100; ++i) {
            compute();
            asm volatile("" ::: "memory");
        }
        const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
        best = std::fmin(best, time.count() / 100 / kCount);
    }
    return best;
}

float randomFloat(std::uint32_t& noise, int exponents)
{
    noise = noise * 1664525u + 1013904223u;
    const float mantissa = 1.0f + static_cast<float>(noise >> 9) * 0x1p-23f;
    noise = noise * 1664525u + 1013904223u;
    const int exponent = static_cast<int>(noise >> 8) % exponents - exponents / 2;
    return std::ldexp(noise >> 31 != 0 ? -mantissa : mantissa, exponent);
}

}  // namespace

int main()
{
    std::uint32_t noise = 1;
    long numbers = 0, doublesDiffer = 0, twiceDiffers = 0;
    for (int round = 0; round < 1000; ++round) {
        for (int i = 0; i < kCount; ++i) {
            a[i] = randomFloat(noise, 8);
            b[i] = randomFloat(noise, 8);
            c[i] = i % 5 == 0 ? -a[i] * b[i] : randomFloat(noise, round % 2 == 0 ? 10 : 60);
        }
        float once[kCount];
        roundOnceByLibm();
        std::memcpy(once, result, sizeof once);
        roundTwice();
        for (int i = 0; i < kCount; ++i) twiceDiffers += result[i] != once[i];
        roundOnceByDoubles();
        for (int i = 0; i < kCount; ++i) doublesDiffer += result[i] != once[i];
        numbers += kCount;
    }
    std::printf("of %ld numbers, doubles give another than libm for %ld, rounding twice for %ld\n", numbers,
                doublesDiffer, twiceDiffers);
    std::printf("ns a number: rounded twice %.3f; once, by doubles %.3f, by libm %.3f\n", nanoseconds(roundTwice),
                nanoseconds(roundOnceByDoubles), nanoseconds(roundOnceByLibm));
}
