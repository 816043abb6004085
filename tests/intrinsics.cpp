// HLSL's intrinsics and operators on lanes: known answers, the ends of the range, and which way round matrices go.
#include "relief/hlsl/intrinsics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

#include "lane_check.h"
#include "relief/hlsl/semantics.h"
#include "stability.h"

using namespace relief;
using namespace lane_check;

namespace {

// Whether a vector is this in every lane, exactly.
bool is(const Float& v, float expected)
{
    return all(v == expected);
}
bool is(const float2& v, float x, float y)
{
    return is(v.x, x) && is(v.y, y);
}
bool is(const float3& v, float x, float y, float z)
{
    return is(v.x, x) && is(v.y, y) && is(v.z, z);
}
bool is(const float4& v, float x, float y, float z, float w)
{
    return is(v.xyz(), x, y, z) && is(v.w, w);
}

// Pseudo-random numbers of [-1, 1), a different one in every lane.
Float randomFloat(RandomBits& random)
{
    Float v;
    for (int i = 0; i < kLanes; ++i) v.set(i, static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f);
    return v;
}
float3 randomVector(RandomBits& random)
{
    return {randomFloat(random), randomFloat(random), randomFloat(random)};
}

// How far the lengths of vectors are from 1, at most, in units in the last place of 1 (2^-23).
double lengthError(const float3& v)
{
    double error = 0.0;
    for (int i = 0; i < kLanes; ++i) {
        const double length = std::sqrt(double{v.x[i]} * v.x[i] + double{v.y[i]} * v.y[i] + double{v.z[i]} * v.z[i]);
        error = std::max(error, std::isnan(length) ? double{kInfinity} : std::abs(length - 1.0) * 0x1p23);
    }
    return error;
}

const float4x4 kCounting = broadcast(glm::mat4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16));  // by columns
const float3x3 kCounting3 = broadcast(glm::mat3(1, 2, 3, 4, 5, 6, 7, 8, 9));

}  // namespace

// --- of one value, and of each component ---

TEST_CASE("lerp: ends, middle and beyond")
{
    CHECK(is(lerp(Float(2.0f), Float(10.0f), Float(0.0f)), 2.0f));
    CHECK(is(lerp(Float(2.0f), Float(10.0f), Float(1.0f)), 10.0f));
    CHECK(is(lerp(Float(2.0f), Float(10.0f), Float(0.25f)), 4.0f));
    CHECK(is(lerp(Float(2.0f), Float(10.0f), Float(-1.0f)), -6.0f));
    CHECK(is(lerp(float3(0.0f, 1.0f, 2.0f), float3(4.0f, 5.0f, 0.0f), Float(0.5f)), 2.0f, 3.0f, 1.0f));
}

TEST_CASE("step: 1 from the edge on")
{
    CHECK(is(step(Float(0.5f), Float(0.5f)), 1.0f));
    CHECK(is(step(Float(0.5f), Float(std::nextafter(0.5f, 0.0f))), 0.0f));
    CHECK(is(step(Float(0.0f), Float(-0.0f)), 1.0f));
    CHECK(is(step(Float(0.5f), Float(kNan)), 0.0f));
}

TEST_CASE("sign: -1, 0 or 1, and 0 of NaN")
{
    CHECK(is(sign(Float(-kSmallest)), -1.0f));
    CHECK(is(sign(Float(kSmallest)), 1.0f));
    CHECK(is(sign(Float(kInfinity)), 1.0f));
    CHECK(is(sign(Float(-0.0f)), 0.0f));
    CHECK(is(sign(Float(kNan)), 0.0f));
    CHECK(is(sign(float2(-3.0f, 5.0f)), -1.0f, 1.0f));
}

TEST_CASE("rcp and rsqrt are divisions, without estimates")
{
    const auto reciprocal = [](float x) { return 1.0f / x; };
    const auto reciprocalRoot = [](float x) { return 1.0f / std::sqrt(x); };
    CHECK(difference(
              kFloats, [](Float x) { return rcp(x); }, reciprocal) == "");
    CHECK(difference(
              kFloats, [](Float x) { return rsqrt(x); }, reciprocalRoot) == "");
}

TEST_CASE("smoothstep: 0 below, 1 above, a half in the middle")
{
    const Float low = 2.0f;
    const Float high = 4.0f;
    CHECK(is(smoothstep(low, high, Float(-kInfinity)), 0.0f));
    CHECK(is(smoothstep(low, high, Float(2.0f)), 0.0f));
    CHECK(is(smoothstep(low, high, Float(2.5f)), 0.15625f));
    CHECK(is(smoothstep(low, high, Float(3.0f)), 0.5f));
    CHECK(is(smoothstep(low, high, Float(4.0f)), 1.0f));
    CHECK(is(smoothstep(low, high, Float(kLargest)), 1.0f));
    CHECK(is(smoothstep(low, high, Float(kNan)), 0.0f));
}

TEST_CASE("smoothstep: from high to low falls")
{
    CHECK(is(smoothstep(Float(4.0f), Float(2.0f), Float(5.0f)), 0.0f));
    CHECK(is(smoothstep(Float(4.0f), Float(2.0f), Float(3.5f)), 0.15625f));
    CHECK(is(smoothstep(Float(4.0f), Float(2.0f), Float(1.0f)), 1.0f));
}

TEST_CASE("functions of each component")
{
    CHECK(is(saturate(float3(-1.0f, 0.5f, kNan)), 0.0f, 0.5f, 0.0f));
    CHECK(is(abs(float3(-1.0f, 0.5f, -kInfinity)), 1.0f, 0.5f, kInfinity));
    CHECK(is(floor(float3(-1.5f, 0.5f, 2.0f)), -2.0f, 0.0f, 2.0f));
    CHECK(is(frac(float3(-1.25f, 0.5f, 2.0f)), 0.75f, 0.5f, 0.0f));
    CHECK(is(sqrt(float3(4.0f, 0.25f, 0.0f)), 2.0f, 0.5f, 0.0f));
    CHECK(is(pow(float3(4.0f, 2.0f, 0.0f), Float(3.0f)), 64.0f, 8.0f, 0.0f));
    CHECK(is(min(float3(1.0f, 5.0f, kNan), float3(2.0f, 3.0f, 4.0f)), 1.0f, 3.0f, 4.0f));
    CHECK(is(max(float3(1.0f, 5.0f, kNan), float3(2.0f, 3.0f, 4.0f)), 2.0f, 5.0f, 4.0f));
    CHECK(is(clamp(float3(1.0f, 5.0f, kNan), 2.0f, 4.0f), 2.0f, 4.0f, 2.0f));
}

TEST_CASE("select of vectors takes all components of a lane from one side")
{
    const Mask odd = Mask::fromBits(0xaaaau);
    const float3 v = select(odd, float3(1.0f, 2.0f, 3.0f), float3(-1.0f, -2.0f, -3.0f));
    for (int i = 0; i < kLanes; ++i) {
        const float s = i % 2 == 1 ? 1.0f : -1.0f;
        CHECK(v.x[i] == 1.0f * s);
        CHECK(v.y[i] == 2.0f * s);
        CHECK(v.z[i] == 3.0f * s);
    }
}

TEST_CASE("functions of each component take numbers, single values, plain vectors and fields, in any place")
{
    const float3 v(-1.0f, 0.5f, 3.0f);
    const Float two = 2.0f;
    TEXCOORD<0, float3> field;
    field = v;
    CHECK(is(max(v, 0), 0.0f, 0.5f, 3.0f));
    CHECK(is(min(1, v), -1.0f, 0.5f, 1.0f));
    CHECK(is(max(field, glm::vec3(0, 1, 2)), 0.0f, 1.0f, 3.0f));
    CHECK(is(max(two, field), 2.0f, 2.0f, 3.0f));
    CHECK(is(clamp(v, 0, float3(1, 1, 2)), 0.0f, 0.5f, 2.0f));
    CHECK(is(lerp(v, 1, 0.5f), 0.0f, 0.75f, 2.0f));
    CHECK(is(lerp(0, field, float3(0, 1, 2)), 0.0f, 0.5f, 6.0f));
    CHECK(is(step(0.5f, v), 0.0f, 1.0f, 1.0f));
    CHECK(is(step(v, two), 1.0f, 1.0f, 0.0f));
    CHECK(is(smoothstep(0, 1, v), 0.0f, 0.5f, 1.0f));
    CHECK(is(smoothstep(float3(0, 0, 2), 4, field), 0.0f, 0.04296875f, 0.5f));
    CHECK(is(pow(2, field), 0.5f, 1.41421354f, 8.0f));
    CHECK(is(pow(float3(1, 2, 3), float3(3, 2, 1)), 1.0f, 4.0f, 3.0f));
    CHECK(is(fmod(v * 2, 1.5f), -0.5f, 1.0f, 0.0f));
    CHECK(is(mad(v, 2, 1), -1.0f, 2.0f, 7.0f));
    CHECK(is(saturate(field), 0.0f, 0.5f, 1.0f));
    CHECK(is(abs(field), 1.0f, 0.5f, 3.0f));
    CHECK(is(sign(field), -1.0f, 1.0f, 1.0f));
    CHECK(is(ceil(v), -1.0f, 1.0f, 3.0f));
    CHECK(is(round(v * 3), -3.0f, 2.0f, 9.0f));
    CHECK(is(trunc(v * 1.5f), -1.0f, 0.0f, 4.0f));
    CHECK(is(rcp(float2(2, 4)), 0.5f, 0.25f));
    CHECK(is(rsqrt(float2(4, 16)), 0.5f, 0.25f));
    CHECK(is(exp2(float2(3, -1)), 8.0f, 0.5f));
    CHECK(is(log2(float2(8, 0.5f)), 3.0f, -1.0f));
    CHECK(is(atan2(float2(0, 1), 1), 0.0f, 0.785398163f));
    CHECK(is(ldexp(float2(3, 5), 2), 12.0f, 20.0f));
    CHECK(is(degrees(float2(0, 3.14159265f)), 0.0f, 180.0f));
    CHECK(is(radians(float2(0, 180)), 0.0f, 3.14159265f));
    float3 sine, cosine, whole;
    sincos(v, sine, cosine);
    for (int k = 0; k < 3; ++k) {
        CHECK(all(sine[k] == sin(v[k])));
        CHECK(all(cosine[k] == cos(v[k])));
        CHECK(all(tan(v)[k] == tan(v[k])));
        CHECK(all(exp(v)[k] == exp(v[k])));
        CHECK(all(log(v)[2] == log(v.z)));
        CHECK(all(tanh(v)[k] == tanh(v[k])));
        CHECK(all(asin(v * 0.25f)[k] == asin(v[k] * 0.25f)));
    }
    // Into the argument itself.
    float3 both = v;
    sincos(both, both, cosine);
    for (int k = 0; k < 3; ++k) CHECK(all(cosine[k] == cos(v[k])));
    both = float3(1.25f, -1.25f, 2);
    CHECK(is(modf(both, both), 0.25f, -0.25f, 0.0f));
    CHECK(is(modf(float3(1.25f, -1.25f, 2), whole), 0.25f, -0.25f, 0.0f));
    CHECK(is(whole, 1.0f, -1.0f, 2.0f));
}

TEST_CASE("functions of each component take plain vectors of GLM beside single values")
{
    const glm::vec3 ground(0, 1, 2), sky(4, 2, -1);
    const Float half = 0.5f;
    TEXCOORD<0, Float> field;
    field = half;
    CHECK(is(lerp(ground, sky, half), 2.0f, 1.5f, 0.5f));
    CHECK(is(lerp(ground, sky, field), 2.0f, 1.5f, 0.5f));
    CHECK(is(lerp(ground, half, sky), 2.0f, 0.0f, 3.5f));
    CHECK(is(lerp(half, ground, sky), -1.5f, 1.5f, -1.0f));
    CHECK(is(lerp(half, 1, ground), 0.5f, 1.0f, 1.5f));
    CHECK(is(lerp(half, ground, 2), -0.5f, 1.5f, 3.5f));
    CHECK(is(lerp(ground, 1, half), 0.5f, 1.0f, 1.5f));
    CHECK(is(max(ground, half), 0.5f, 1.0f, 2.0f));
    CHECK(is(min(field, ground), 0.0f, 0.5f, 0.5f));
    CHECK(is(step(half, ground), 0.0f, 1.0f, 1.0f));
    CHECK(is(pow(Float(2.0f), ground), 1.0f, 2.0f, 4.0f));
    CHECK(is(fmod(ground, Float(2.0f)), 0.0f, 1.0f, 0.0f));
    CHECK(is(clamp(sky, half, 2), 2.0f, 2.0f, 0.5f));
    CHECK(is(smoothstep(0, sky, half * 2), 0.15625f, 0.5f, 0.0f));
    CHECK(is(mad(ground, half, sky), 4.0f, 2.5f, 0.0f));
    CHECK(is(mul(ground, half), 0.0f, 0.5f, 1.0f));
    CHECK(is(mul(field, glm::vec2(1, 2)), 0.5f, 1.0f));
    CHECK(is(refract(glm::vec2(0, -1), glm::vec2(0, 1), half), 0.0f, -1.0f));
    CHECK(is(select(half > 0, ground, sky), 0.0f, 1.0f, 2.0f));
    CHECK(is(select(half < 0, ground, 3), 3.0f, 3.0f, 3.0f));
    CHECK(is(select(bool3(true, false, true), half, sky), 0.5f, 2.0f, 0.5f));
    // GLM's own functions stay GLM's.
    static_assert(std::is_same_v<decltype(max(ground, 0.5f)), glm::vec3>);
    static_assert(std::is_same_v<decltype(clamp(ground, 0.0f, 1.0f)), glm::vec3>);
}

TEST_CASE("isnan, isinf and isfinite of each component")
{
    const float4 v(kNan, -kInfinity, kLargest, 0.0f);
    CHECK(isnan(v).x.bits() == kAllLanes);
    CHECK(none(any(isnan(v.yzw()))));
    CHECK(isinf(v).y.bits() == kAllLanes);
    CHECK(none(any(isinf(v.xzw()))));
    CHECK(all(all(isfinite(v.zw()))));
    CHECK(none(any(isfinite(v.xy()))));
}

TEST_CASE("fmod: of x's sign, below |y|, and what the division has in common with std::fmod")
{
    CHECK(is(fmod(Float(5.5f), Float(2.0f)), 1.5f));
    CHECK(is(fmod(Float(-5.5f), Float(2.0f)), -1.5f));
    CHECK(is(fmod(Float(5.5f), Float(-2.0f)), 1.5f));
    CHECK(is(fmod(Float(1.0f), Float(kInfinity)), 1.0f));
    CHECK(all(isnan(fmod(Float(1.0f), Float(0.0f)))));
    CHECK(all(isnan(fmod(Float(kInfinity), Float(2.0f)))));
    Float rest = 5.5f;
    CHECK(is(rest %= 2.0f, 1.5f));
    CHECK(is(fmod(Float(1e38f), Float(1e-30f)), 0.0f));
    RandomBits random;
    for (int n = 0; n < 4000; ++n) {
        // Quotients beyond 2^25, too.
        const Float x = randomFloat(random) * (n % 2 == 0 ? 1e3f : 1e10f), y = randomFloat(random);
        rest = fmod(x, y);
        REQUIRE(all(abs(rest) < abs(y)));
        for (int i = 0; i < kLanes; ++i) {
            const double off = std::abs(double{rest[i]} - std::fmod(double{x[i]}, double{y[i]}));
            REQUIRE(std::min(off, std::abs(double{y[i]}) - off) <= 0x1p-24 * std::abs(double{x[i]}));
        }
    }
}

TEST_CASE("frexp: as the standard library's")
{
    for (const float x : kFloats) {
        CAPTURE(x);
        int expected = 0;
        const float mantissa = std::frexp(x, &expected);
        Float exponent = 0.0f;
        CHECK(same(frexp(Float(x), exponent)[0], mantissa));
        CHECK(exponent[kLanes - 1] == (std::isfinite(x) ? static_cast<float>(expected) : 0.0f));
    }
    float2 exponents;
    CHECK(is(frexp(float2(12, -0.25f), exponents), 0.75f, -0.5f));
    CHECK(is(exponents, 4.0f, -1.0f));
}

TEST_CASE("countbits, reversebits, firstbitlow and firstbithigh")
{
    RandomBits random;
    for (int n = 0; n < 1000; ++n) {
        const std::uint32_t bits = random() >> (n % 32);
        const auto x = static_cast<std::int32_t>(bits);
        std::uint32_t reversed = 0;
        for (int i = 0; i < 32; ++i) reversed |= (bits >> i & 1u) << (31 - i);
        REQUIRE(countbits(Int(x))[0] == std::popcount(bits));
        REQUIRE(reversebits(Int(x))[0] == static_cast<std::int32_t>(reversed));
        REQUIRE(firstbitlow(Int(x))[0] == (bits == 0 ? -1 : std::countr_zero(bits)));
        REQUIRE(firstbithigh(Int(x))[0] == 31 - std::countl_zero(x < 0 ? ~bits : bits));
    }
    CHECK(firstbitlow(Int(0))[0] == -1);
    CHECK(firstbithigh(Int(-1))[0] == -1);
    CHECK(all(countbits(int2(3, -1)).y == 32));
}

TEST_CASE("select: between plain numbers, and by a mask for each component")
{
    const Mask odd = Mask::fromBits(0xaaaau);
    const Float one = select(odd, 1.0f, 0.0f), mixed = select(odd, 1, 0.5);
    const Int whole = select(odd, 1, 0);
    for (int i = 0; i < kLanes; ++i) {
        CHECK(one[i] == (i % 2 == 1 ? 1.0f : 0.0f));
        CHECK(mixed[i] == (i % 2 == 1 ? 1.0f : 0.5f));
        CHECK(whole[i] == i % 2);
    }
    const float3 v(-1.0f, 0.5f, 3.0f);
    CHECK(is(select(v < 1, v, 9), -1.0f, 0.5f, 9.0f));
    CHECK(is(select(v < 1, 0.0f, 1), 0.0f, 0.0f, 1.0f));
    CHECK(is(select(v < 1, Float(0.5f), 1), 0.5f, 0.5f, 1.0f));
}

// --- of vectors ---

TEST_CASE("dot of two, three and four components")
{
    CHECK(is(dot(float2(1.0f, 2.0f), float2(3.0f, 4.0f)), 11.0f));
    CHECK(is(dot(float3(1.0f, 2.0f, 3.0f), float3(4.0f, 5.0f, 6.0f)), 32.0f));
    CHECK(is(dot(float4(1.0f, 2.0f, 3.0f, 4.0f), float4(5.0f, 6.0f, 7.0f, 8.0f)), 70.0f));
}

TEST_CASE("dot adds from left to right")
{
    CHECK(is(dot(float3(1e8f, -1e8f, 1.0f), float3(1.0f)), 1.0f));
    CHECK(is(dot(float3(1.0f, 1e8f, -1e8f), float3(1.0f)), 0.0f));
    CHECK(is(dot(float4(1e8f, 1.0f, -1e8f, 1.0f), float4(1.0f)), 1.0f));
}

TEST_CASE("cross of the axes is right-handed in the formula's sense: x cross y is z")
{
    const float3 x(1.0f, 0.0f, 0.0f);
    const float3 y(0.0f, 1.0f, 0.0f);
    const float3 z(0.0f, 0.0f, 1.0f);
    CHECK(is(cross(x, y), 0.0f, 0.0f, 1.0f));
    CHECK(is(cross(y, z), 1.0f, 0.0f, 0.0f));
    CHECK(is(cross(z, x), 0.0f, 1.0f, 0.0f));
    CHECK(is(cross(y, x), 0.0f, 0.0f, -1.0f));
    CHECK(is(cross(float3(1.0f, 2.0f, 3.0f), float3(4.0f, 5.0f, 6.0f)), -3.0f, 6.0f, -3.0f));
}

TEST_CASE("cross is orthogonal to both vectors")
{
    RandomBits random;
    for (int n = 0; n < 200; ++n) {
        const float3 a = randomVector(random);
        const float3 b = randomVector(random);
        CHECK(all(abs(dot(cross(a, b), a)) < 1e-6f));
        CHECK(all(abs(dot(cross(a, b), b)) < 1e-6f));
    }
}

TEST_CASE("length and distance")
{
    CHECK(is(length(float2(3.0f, 4.0f)), 5.0f));
    CHECK(is(length(float3(2.0f, 3.0f, 6.0f)), 7.0f));
    CHECK(is(length(float4(0.0f)), 0.0f));
    CHECK(is(distance(float3(1.0f, 1.0f, 1.0f), float3(3.0f, 4.0f, 7.0f)), 7.0f));
}

TEST_CASE("normalize: the same direction, with length 1")
{
    CHECK(is(normalize(float2(0.0f, -5.0f)), 0.0f, -1.0f));
    CHECK(is(normalize(float4(0.0f, 0.0f, 0.0f, 0.5f)), 0.0f, 0.0f, 0.0f, 1.0f));
    const float3 v = normalize(float3(2.0f, 3.0f, 6.0f));
    CHECK(all(abs(v.x - 2.0f / 7.0f) < 1e-7f));
    CHECK(all(abs(v.y - 3.0f / 7.0f) < 1e-7f));
    CHECK(all(abs(v.z - 6.0f / 7.0f) < 1e-7f));
}

TEST_CASE("normalize: the length is within 4 units in the last place of 1, whatever it was")
{
    RandomBits random;
    for (const float scale : {1.0f, 1e-10f, 1e10f, 1e-14f, 1e-15f, 1e-16f, 1e14f, 1e15f, 1e16f, 1e-20f, 1e20f, 1e-30f,
                              1e30f, 1e-37f, 1e38f}) {
        CAPTURE(scale);
        for (int n = 0; n < 200; ++n) REQUIRE(lengthError(normalize(randomVector(random) * scale)) < 4.0);
    }
}

TEST_CASE("normalize: one lane out of the ordinary range does not change the others")
{
    RandomBits random;
    for (const float unusual : {0.0f, 1e-30f, 1e30f, kSmallest, kInfinity, kNan}) {
        CAPTURE(unusual);
        const float3 ordinary = randomVector(random);
        float3 mixed = ordinary;
        mixed.x.set(0, unusual);
        mixed.y.set(0, 0.0f);
        mixed.z.set(0, 0.0f);
        const float3 a = normalize(ordinary);
        const float3 b = normalize(mixed);
        CHECK(b.x[0] == (unusual > 0.0f && unusual < kInfinity ? 1.0f : 0.0f));
        for (int i = 1; i < kLanes; ++i) {
            CHECK(same(a.x[i], b.x[i]));
            CHECK(same(a.y[i], b.y[i]));
            CHECK(same(a.z[i], b.z[i]));
        }
    }
}

TEST_CASE("normalize: subnormal vectors have a direction too")
{
    CHECK(is(normalize(float3(kSmallest, 0.0f, 0.0f)), 1.0f, 0.0f, 0.0f));
    CHECK(is(normalize(float3(0.0f, -1e-40f, 0.0f)), 0.0f, -1.0f, 0.0f));
    CHECK(lengthError(normalize(float3(kSmallest, kSmallest, -kSmallest))) < 4.0);
    CHECK(lengthError(normalize(float3(1e-40f, -3e-39f, kSmallestNormal))) < 4.0);
}

TEST_CASE("normalize: the largest vectors have a direction too")
{
    CHECK(is(normalize(float3(0.0f, kLargest, 0.0f)), 0.0f, 1.0f, 0.0f));
    CHECK(lengthError(normalize(float3(kLargest, -kLargest, kLargest))) < 4.0);
}

TEST_CASE("normalize: the zero vector stays zero")
{
    CHECK(is(normalize(float3(0.0f)), 0.0f, 0.0f, 0.0f));
    CHECK(is(normalize(float3(-0.0f, 0.0f, -0.0f)), 0.0f, 0.0f, 0.0f));
    CHECK(is(normalize(float2(0.0f)), 0.0f, 0.0f));
    CHECK(is(normalize(float4(0.0f)), 0.0f, 0.0f, 0.0f, 0.0f));
}

TEST_CASE("normalize: a vector with NaN or infinity in it becomes the zero vector, wherever it is")
{
    for (const float bad : {kNan, -kNan, kInfinity, -kInfinity}) {
        CAPTURE(bad);
        for (const float other : {0.0f, 1.0f, 1e-40f, 1e30f}) {
            CAPTURE(other);
            CHECK(is(normalize(float3(bad, other, other)), 0.0f, 0.0f, 0.0f));
            CHECK(is(normalize(float3(other, bad, other)), 0.0f, 0.0f, 0.0f));
            CHECK(is(normalize(float3(other, other, bad)), 0.0f, 0.0f, 0.0f));
        }
    }
    CHECK(is(normalize(float3(kNan, kInfinity, 1.0f)), 0.0f, 0.0f, 0.0f));
    CHECK(is(normalize(float3(kInfinity, -kInfinity, kNan)), 0.0f, 0.0f, 0.0f));
}

TEST_CASE("reflect: the part along the normal turns around, the rest stays")
{
    const float3 up(0.0f, 1.0f, 0.0f);
    CHECK(is(reflect(float3(1.0f, -2.0f, 3.0f), up), 1.0f, 2.0f, 3.0f));
    CHECK(is(reflect(float3(0.0f, -1.0f, 0.0f), up), 0.0f, 1.0f, 0.0f));
    CHECK(is(reflect(float3(1.0f, 0.0f, 0.0f), up), 1.0f, 0.0f, 0.0f));
}

TEST_CASE("refract: straight on nothing bends, at 30 degrees Snell's law, and total reflection is zero")
{
    const float3 up(0.0f, 1.0f, 0.0f);
    CHECK(is(refract(float3(0.0f, -1.0f, 0.0f), up, 0.5f), 0.0f, -1.0f, 0.0f));
    const float3 bent = refract(float3(0.5f, -std::sqrt(0.75f), 0.0f), up, 0.5f);
    CHECK(all(abs(bent.x - 0.25f) < 1e-7f));
    CHECK(all(abs(length(bent) - 1.0f) < 2e-7f));
    CHECK(is(refract(float3(0.8f, -0.6f, 0.0f), up, 1.5f), 0.0f, 0.0f, 0.0f));
}

TEST_CASE("faceforward: turned against the incident direction")
{
    const float3 n(0.0f, 0.0f, -1.0f);
    CHECK(is(faceforward(n, float3(0, 0, 1), n), 0.0f, 0.0f, -1.0f));
    CHECK(is(faceforward(n, float3(0, 0, -1), n), 0.0f, 0.0f, 1.0f));
}

TEST_CASE("lit and dst")
{
    CHECK(is(lit(0.5f, 0.5f, 2.0f), 1.0f, 0.5f, 0.25f, 1.0f));
    CHECK(is(lit(-0.5f, 0.5f, 2.0f), 1.0f, 0.0f, 0.0f, 1.0f));
    CHECK(is(lit(0.5f, -0.5f, 2.0f), 1.0f, 0.5f, 0.0f, 1.0f));
    CHECK(is(dst(float4(0, 9, 9, 0), float4(0, 0.5f, 0, 0.25f)), 1.0f, 4.5f, 9.0f, 0.25f));
}

TEST_CASE("dot, length, distance and reflect take plain vectors, fields and vectors of any size")
{
    TEXCOORD<0, float3> field;
    field = float3(1.0f, 2.0f, 3.0f);
    CHECK(is(dot(field, glm::vec3(1, 1, 1)), 6.0f));
    CHECK(is(dot(field, field), 14.0f));
    CHECK(is(distance(field, glm::vec3(1, 2, 5)), 2.0f));
    CHECK(is(length(float2(3.0f, 4.0f)), 5.0f));
    CHECK(is(reflect(float2(1.0f, -2.0f), float2(0.0f, 1.0f)), 1.0f, 2.0f));
    CHECK(is(mul(field, Float(2.0f)), 2.0f, 4.0f, 6.0f));
    CHECK(is(mul(field, field), 14.0f));
}

// --- of matrices ---

TEST_CASE("mul(M, v): the vector is a column")
{
    CHECK(is(mul(kCounting, float4(1.0f, 0.0f, 0.0f, 0.0f)), 1.0f, 2.0f, 3.0f, 4.0f));
    CHECK(is(mul(kCounting, float4(0.0f, 0.0f, 0.0f, 1.0f)), 13.0f, 14.0f, 15.0f, 16.0f));
    CHECK(is(mul(kCounting, float4(1.0f, 2.0f, 3.0f, 4.0f)), 90.0f, 100.0f, 110.0f, 120.0f));
    CHECK(is(mul(kCounting3, float3(1.0f, 2.0f, 3.0f)), 30.0f, 36.0f, 42.0f));
}

TEST_CASE("mul(v, M): the vector is a row")
{
    CHECK(is(mul(float4(1.0f, 0.0f, 0.0f, 0.0f), kCounting), 1.0f, 5.0f, 9.0f, 13.0f));
    CHECK(is(mul(float4(1.0f, 2.0f, 3.0f, 4.0f), kCounting), 30.0f, 70.0f, 110.0f, 150.0f));
    CHECK(is(mul(float3(1.0f, 2.0f, 3.0f), kCounting3), 14.0f, 32.0f, 50.0f));
}

TEST_CASE("mul: a translation is the last column, and moves points but not directions")
{
    glm::mat4 move(1.0f);
    move[3] = glm::vec4(10.0f, 20.0f, 30.0f, 1.0f);
    const float4x4 worldFromObject = broadcast(move);
    CHECK(is(mul(worldFromObject, float4(1.0f, 2.0f, 3.0f, 1.0f)), 11.0f, 22.0f, 33.0f, 1.0f));
    CHECK(is(mul(worldFromObject, float4(1.0f, 2.0f, 3.0f, 0.0f)), 1.0f, 2.0f, 3.0f, 0.0f));
}

TEST_CASE("mul: v M is transposed M v")
{
    const float3 v(0.5f, -2.0f, 4.0f);
    const float3x3 transposed = broadcast(glm::mat3(1, 4, 7, 2, 5, 8, 3, 6, 9));
    const float3 row = mul(v, kCounting3);
    CHECK(is(mul(transposed, v), row.x[0], row.y[0], row.z[0]));
}

TEST_CASE("transpose: rows become columns")
{
    const float3x3 m = transpose(kCounting3);
    CHECK(is(m[0], 1.0f, 4.0f, 7.0f));
    CHECK(is(m[1], 2.0f, 5.0f, 8.0f));
    CHECK(is(m[2], 3.0f, 6.0f, 9.0f));
}

TEST_CASE("upper3x3 leaves out the last row and column")
{
    const float3x3 m = upper3x3(kCounting);
    CHECK(is(m[0], 1.0f, 2.0f, 3.0f));
    CHECK(is(m[1], 5.0f, 6.0f, 7.0f));
    CHECK(is(m[2], 9.0f, 10.0f, 11.0f));
}

TEST_CASE("broadcast: plain vectors and matrices in every lane")
{
    CHECK(is(broadcast(glm::vec2(1.0f, 2.0f)), 1.0f, 2.0f));
    CHECK(is(broadcast(glm::vec3(1.0f, 2.0f, 3.0f)), 1.0f, 2.0f, 3.0f));
    CHECK(is(broadcast(glm::vec4(1.0f, 2.0f, 3.0f, 4.0f)), 1.0f, 2.0f, 3.0f, 4.0f));
    CHECK(is(kCounting[2], 9.0f, 10.0f, 11.0f, 12.0f));
    CHECK(is(kCounting3[1], 4.0f, 5.0f, 6.0f));
}

// --- operators and swizzles ---

TEST_CASE("operators of vectors work component by component")
{
    const float3 a(1.0f, 2.0f, 4.0f);
    const float3 b(8.0f, 16.0f, 2.0f);
    CHECK(is(a + b, 9.0f, 18.0f, 6.0f));
    CHECK(is(a - b, -7.0f, -14.0f, 2.0f));
    CHECK(is(a * b, 8.0f, 32.0f, 8.0f));
    CHECK(is(b / a, 8.0f, 8.0f, 0.5f));
    CHECK(is(-a, -1.0f, -2.0f, -4.0f));
    float3 c = a;
    c += b;
    c *= 2.0f;
    CHECK(is(c, 18.0f, 36.0f, 12.0f));
}

TEST_CASE("operators take plain numbers on both sides: float, double and int")
{
    const float2 v(1.0f, 4.0f);
    CHECK(is(v + 1.0f, 2.0f, 5.0f));
    CHECK(is(1.0f + v, 2.0f, 5.0f));
    CHECK(is(v - 1.0f, 0.0f, 3.0f));
    CHECK(is(1.0f - v, 0.0f, -3.0f));
    CHECK(is(v * 0.5f, 0.5f, 2.0f));
    CHECK(is(0.5f * v, 0.5f, 2.0f));
    CHECK(is(v / 2.0f, 0.5f, 2.0f));
    CHECK(is(2.0f / v, 2.0f, 0.5f));
    CHECK(is(v * 2, 2.0f, 8.0f));
    CHECK(is(2 - v, 1.0f, -2.0f));
    CHECK(is(v * 0.5, 0.5f, 2.0f));
    CHECK(is(0.5 + v, 1.5f, 4.5f));
}

TEST_CASE("operators take a Float on both sides")
{
    const Float f = 2.0f;
    CHECK(is(float3(1.0f, 2.0f, 3.0f) * f, 2.0f, 4.0f, 6.0f));
    CHECK(is(f * float3(1.0f, 2.0f, 3.0f), 2.0f, 4.0f, 6.0f));
    CHECK(is(float3(1.0f, 2.0f, 3.0f) - f, -1.0f, 0.0f, 1.0f));
    CHECK(is(f / float3(1.0f, 2.0f, 4.0f), 2.0f, 1.0f, 0.5f));
    CHECK(is(f + 1, 3.0f));
    CHECK(is(1 - f, -1.0f));
    CHECK(is(0.5 * f, 1.0f));
    CHECK(is(1.0f / f, 0.5f));
    CHECK(all(2 == f));
    CHECK(all(1.0 < f));
}

TEST_CASE("swizzles")
{
    const float4 v(1.0f, 2.0f, 3.0f, 4.0f);
    CHECK(is(v.xy(), 1.0f, 2.0f));
    CHECK(is(v.zw(), 3.0f, 4.0f));
    CHECK(is(v.xyz(), 1.0f, 2.0f, 3.0f));
    CHECK(is(v.xzy(), 1.0f, 3.0f, 2.0f));
    CHECK(is(v.wzyx(), 4.0f, 3.0f, 2.0f, 1.0f));
    CHECK(is(v.xyz().zzx(), 3.0f, 3.0f, 1.0f));
}

TEST_CASE("any and all of single values and of integers, per pixel")
{
    CHECK(all(any(int3(0, 0, 2))));
    CHECK(none(any(int3(0, 0, 0))));
    CHECK(none(all(int2(1, 0))));
    CHECK(all(all(int4(1, 2, 3, -4))));
    CHECK(all(any(Float(laneXs() + 1))));
    CHECK(none(all(Int(0))));
}

TEST_CASE("bool vectors: chosen, compared and told apart")
{
    const bool3 a(true, false, true), b(true, true, false);
    const auto isBits = [](const bool3& v, bool x, bool y, bool z) {
        return all(v.x == x) && all(v.y == y) && all(v.z == z);
    };
    CHECK(isBits(a ^ b, false, true, true));
    CHECK(isBits(a == b, true, false, false));
    CHECK(isBits(a != b, false, true, true));
    CHECK(isBits(select(a, b, !b), true, false, false));
    CHECK(isBits(select(laneXs() >= 0, a, b), true, false, true));
    CHECK(all(select(Mask(false), Mask(false), Mask(true))));
}

TEST_CASE("integers: quotients, rests, shifts and products of vectors")
{
    const auto isInts = [](const int3& v, int x, int y, int z) { return all(all(v == int3(x, y, z))); };
    const int3 v(7, -7, 9);
    CHECK(isInts(v / 2, 3, -3, 4));
    CHECK(isInts(v % 4, 3, -3, 1));
    CHECK(isInts(v << int3(1, 2, 3), 14, -28, 72));
    CHECK(isInts(v >> 1, 3, -4, 4));
    CHECK(isInts(~v, -8, 6, -10));
    CHECK(isInts(mul(2, v), 14, -14, 18));
    CHECK(all(dot(v, int3(1, 2, 3)) == 20));
    CHECK(all(mul(v, v) == 179));
    CHECK(is(float2(7.5f, -7.5f) % 2, 1.5f, -1.5f));
    // No number with a fraction becomes an Int by itself.
    static_assert(!std::is_convertible_v<float, Int> && std::is_convertible_v<int, Int>);
}

TEST_CASE("mul: of a vector and a plain number")
{
    CHECK(is(mul(float3(1, 2, 3), 2.0f), 2.0f, 4.0f, 6.0f));
    CHECK(is(mul(2, float3(1, 2, 3)), 2.0f, 4.0f, 6.0f));
}

TEST_CASE("constructors join vectors and numbers")
{
    CHECK(is(float4(glm::vec3(1, 2, 3), 4), 1.0f, 2.0f, 3.0f, 4.0f));
    CHECK(is(float3(Float(1.0f), glm::vec2(2, 3)), 1.0f, 2.0f, 3.0f));
    CHECK(is(float4(float3(1.0f, 2.0f, 3.0f), 1.0f), 1.0f, 2.0f, 3.0f, 1.0f));
    CHECK(is(float4(float2(1.0f, 2.0f), float2(3.0f, 4.0f)), 1.0f, 2.0f, 3.0f, 4.0f));
    CHECK(is(float3(Float(5.0f)), 5.0f, 5.0f, 5.0f));
    CHECK(is(float3(0.5f), 0.5f, 0.5f, 0.5f));
}

TEST_CASE("normalize: S-619 vectors of lengths 1e-30 to 1e30 keep their direction")
{
    RandomBits random;
    double worst = 0.0;
    for (const float scale : {1e-30f, 1e-25f, 1e-23f, 1e-20f, 1.0f, 1e19f, 1e20f, 1e25f, 1e30f}) {
        for (int n = 0; n < stability::trials(200); ++n) {
            const float3 v = randomVector(random) * scale;
            const float3 unit = normalize(v);
            for (int i = 0; i < kLanes; ++i) {
                double square = 0.0, off = 0.0;
                for (int c = 0; c < 3; ++c) square += static_cast<double>(v[c][i]) * static_cast<double>(v[c][i]);
                for (int c = 0; c < 3; ++c) {
                    off +=
                        std::pow(static_cast<double>(v[c][i]) / std::sqrt(square) - static_cast<double>(unit[c][i]), 2);
                }
                worst = std::fmax(worst, std::sqrt(off) * 180.0 / 3.14159265358979);
            }
        }
    }
    stability::measured("degrees off", worst, 1e-5);
}
