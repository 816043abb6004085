// Float, and Float to Int and back: whatever the width and the instruction set, an operation on lanes gives what the
// scalar one gives, to the last bit.
#include <cstring>

#include <doctest/doctest.h>

#include "lane_check.h"
#include "relief/lanes/float.h"

using namespace relief;
using namespace lane_check;

namespace {

// What roundToInt and truncateToInt do first.
float limited(float a)
{
    if (!(a > -2147483520.0f)) return -2147483520.0f;
    return a < 2147483520.0f ? a : 2147483520.0f;
}

}  // namespace

TEST_CASE("Float: a plain number is the same in every lane")
{
    for (int i = 0; i < kLanes; ++i) {
        CHECK(Float(0.1f)[i] == 0.1f);
        CHECK(Float(0.1)[i] == 0.1f);
        CHECK(Float(7)[i] == 7.0f);
    }
}

TEST_CASE("Float: load, store and set keep every bit")
{
    float in[kLanes];
    float out[kLanes];
    RandomBits random;
    for (float& number : in) number = std::bit_cast<float>(random());
    in[0] = -0.0f;
    Float f = Float::load(in);
    in[kLanes - 1] = kSmallest;
    f.set(kLanes - 1, kSmallest);
    f.store(out);
    CHECK(std::memcmp(in, out, sizeof in) == 0);
}

TEST_CASE("Float: sum, difference, product and quotient")
{
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a + b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a - b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a * b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a / b; }) == "");
}

TEST_CASE("Float: compound assignment")
{
    Float a = 3.0f;
    CHECK((a += 4.0f)[0] == 7.0f);
    CHECK((a -= 1.0f)[0] == 6.0f);
    CHECK((a *= 2.0f)[0] == 12.0f);
    CHECK((a /= 8.0f)[0] == 1.5f);
    CHECK(a[kLanes - 1] == 1.5f);
}

TEST_CASE("Float: a product and a sum are rounded one after the other")
{
    // (1 + e)(1 - e) - 1 is -e^2 where the product is not rounded (contraction), and 0 where it is.
    volatile float e = 0x1p-13f;
    CHECK((Float(1.0f + e) * Float(1.0f - e) - 1.0f)[0] == 0.0f);
}

TEST_CASE("Float: signs")
{
    CHECK(difference(kFloats, [](auto a) { return -a; }) == "");
    CHECK(difference(kFloats, [](auto a) { return +a; }) == "");
    CHECK(asInt(-Float(0.0f))[0] == kIntMin);
}

TEST_CASE("Float: comparisons")
{
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a < b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a <= b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a > b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a >= b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a == b; }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto a, auto b) { return a != b; }) == "");
}

TEST_CASE("Float: comparisons with NaN are false, except unequal")
{
    const Float nan = kNan;
    CHECK(none((nan < 1.0f) | (nan <= 1.0f) | (nan > 1.0f) | (nan >= 1.0f) | (nan == 1.0f) | (nan == nan)));
    CHECK(all((nan != 1.0f) & (nan != nan)));
}

TEST_CASE("Float: isnan")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return isnan(a); }, [](float a) { return std::isnan(a); }) == "");
}

TEST_CASE("Float: select takes every lane from the side that its mask names")
{
    float a[kLanes];
    float b[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        a[i] = static_cast<float>(i);
        b[i] = i % 2 == 0 ? kNan : -0.0f;
    }
    for (unsigned bits = 0; bits <= kAllLanes; bits += 29) {
        const Float s = select(Mask::fromBits(bits), Float::load(a), Float::load(b));
        for (int i = 0; i < kLanes; ++i) REQUIRE(same(s[i], (bits >> i & 1u) != 0 ? a[i] : b[i]));
    }
}

TEST_CASE("Float: bits as Int and back")
{
    const auto bitsOf = [](float a) { return std::bit_cast<std::int32_t>(a); };
    CHECK(difference(
              manyFloats(), [](Float a) { return asInt(a); }, bitsOf) == "");
    CHECK(difference(
              kInts, [](Int a) { return asInt(asFloat(a)); }, [](std::int32_t a) { return a; }) == "");
}

TEST_CASE("Float: abs clears the sign alone")
{
    const auto bitsOfAbs = [](float a) { return std::bit_cast<std::int32_t>(a) & kIntMax; };
    CHECK(difference(
              manyFloats(), [](Float a) { return asInt(abs(a)); }, bitsOfAbs) == "");
}

TEST_CASE("Float: sqrt is correctly rounded")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return sqrt(a); }, [](float a) { return std::sqrt(a); }) == "");
}

TEST_CASE("Float: floor and ceil, with the sign of zero")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return floor(a); }, [](float a) { return std::floor(a); }) == "");
    CHECK(difference(
              manyFloats(), [](Float a) { return ceil(a); }, [](float a) { return std::ceil(a); }) == "");
    CHECK(asInt(floor(Float(-0.0f)))[0] == kIntMin);
    CHECK(asInt(ceil(Float(-0.5f)))[0] == kIntMin);
}

TEST_CASE("Float: frac is what is above the floor")
{
    const auto aboveFloor = [](float a) { return a - std::floor(a); };
    CHECK(difference(
              manyFloats(), [](Float a) { return frac(a); }, aboveFloor) == "");
    CHECK(frac(Float(-0.25f))[0] == 0.75f);
}

TEST_CASE("Float: min and max prefer the number to NaN")
{
    CHECK(min(Float(kNan), Float(2.0f))[0] == 2.0f);
    CHECK(min(Float(2.0f), Float(kNan))[0] == 2.0f);
    CHECK(max(Float(kNan), Float(2.0f))[0] == 2.0f);
    CHECK(max(Float(2.0f), Float(kNan))[0] == 2.0f);
    CHECK(max(Float(kNan), Float(-kInfinity))[0] == -kInfinity);
    CHECK(std::isnan(min(Float(kNan), Float(kNan))[0]));
    CHECK(std::isnan(max(Float(kNan), Float(kNan))[0]));
}

TEST_CASE("Float: min and max give the second of two equal numbers, as zeros of both signs are")
{
    const auto minimum = [](float a, float b) { return std::isnan(b) ? a : a < b ? a : b; };
    const auto maximum = [](float a, float b) { return std::isnan(b) ? a : a > b ? a : b; };
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return min(a, b); }, minimum) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return max(a, b); }, maximum) == "");
    CHECK(asInt(min(Float(0.0f), Float(-0.0f)))[0] == kIntMin);
    CHECK(asInt(min(Float(-0.0f), Float(0.0f)))[0] == 0);
}

TEST_CASE("Float: saturate of NaN is 0")
{
    CHECK(asInt(saturate(Float(kNan)))[0] == 0);
    CHECK(asInt(saturate(Float(-kNan)))[kLanes - 1] == 0);
}

TEST_CASE("Float: saturate stays in 0 to 1 and has no negative zero")
{
    const auto reference = [](float a) { return a > 0.0f ? (a < 1.0f ? a : 1.0f) : 0.0f; };
    CHECK(difference(
              manyFloats(), [](Float a) { return saturate(a); }, reference) == "");
}

TEST_CASE("Float: clamp, S-707 with NaN to the lower limit")
{
    const auto reference = [](float a) { return a > -2.0f ? (a < 3.5f ? a : 3.5f) : -2.0f; };
    CHECK(difference(
              manyFloats(), [](Float a) { return clamp(a, -2.0f, 3.5f); }, reference) == "");
    CHECK(clamp(Float(kNan), -2.0f, 3.5f)[kLanes - 1] == -2.0f);
}

TEST_CASE("Float: trunc, round to even, copySign, isinf and isfinite as the standard library's")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return trunc(a); }, [](float a) { return std::trunc(a); }) == "");
    CHECK(difference(
              manyFloats(), [](Float a) { return round(a); }, [](float a) { return std::nearbyint(a); }) == "");
    CHECK(difference(
              manyFloats(), [](Float a) { return isinf(a); }, [](float a) { return std::isinf(a); }) == "");
    CHECK(difference(
              manyFloats(), [](Float a) { return isfinite(a); }, [](float a) { return std::isfinite(a); }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return copySign(a, b); },
              [](float a, float b) { return std::copysign(a, b); }) == "");
}

// --- Float to Int and back ---

TEST_CASE("roundToInt: to the nearest, as std::nearbyint")
{
    const auto reference = [](float a) { return static_cast<std::int32_t>(std::nearbyint(limited(a))); };
    CHECK(difference(
              manyFloats(), [](Float a) { return roundToInt(a); }, reference) == "");
}

TEST_CASE("roundToInt: ties go to the even side, below zero too")
{
    std::vector<float> ties;
    for (int k = -(1 << 22); k < 1 << 22; k += 61) ties.push_back(static_cast<float>(k) + 0.5f);
    for (int k = -1000; k < 1000; ++k) ties.push_back(static_cast<float>(k) + 0.5f);
    const auto even = [](float a) {
        const auto below = static_cast<std::int32_t>(std::floor(a));
        return below % 2 == 0 ? below : below + 1;
    };
    CHECK(difference(
              ties, [](Float a) { return roundToInt(a); }, even) == "");
}

TEST_CASE("roundToInt: ties of the grid of 1/256 pixel are symmetric around zero")
{
    std::vector<float> snapped;
    for (int k = 0; k < 4096; ++k) snapped.push_back((static_cast<float>(k) / 256.0f + 1.0f / 512.0f) * 256.0f);
    const auto sumOfBoth = [](Float a) { return roundToInt(a) + roundToInt(-a); };
    CHECK(difference(snapped, sumOfBoth, [](float) { return 0; }) == "");
}

TEST_CASE("truncateToInt: toward zero")
{
    const auto reference = [](float a) { return static_cast<std::int32_t>(limited(a)); };
    CHECK(difference(
              manyFloats(), [](Float a) { return truncateToInt(a); }, reference) == "");
}

TEST_CASE("roundToInt and truncateToInt: out of range is clamped")
{
    for (const float huge : {2147483648.0f, 3e9f, kLargest, kInfinity}) {
        CHECK(roundToInt(Float(huge))[0] == 2147483520);
        CHECK(truncateToInt(Float(huge))[0] == 2147483520);
        CHECK(roundToInt(Float(-huge))[0] == -2147483520);
        CHECK(truncateToInt(Float(-huge))[0] == -2147483520);
    }
}

TEST_CASE("roundToInt and truncateToInt: NaN is the lower limit")
{
    CHECK(roundToInt(Float(kNan))[kLanes - 1] == -2147483520);
    CHECK(truncateToInt(Float(kNan))[kLanes - 1] == -2147483520);
}

TEST_CASE("Float of Int: to the nearest float")
{
    std::vector<std::int32_t> ints = kInts;
    RandomBits random;
    for (int i = 0; i < 10000; ++i) ints.push_back(static_cast<std::int32_t>(random()));
    for (int i = -100; i < 100; ++i) ints.push_back((1 << 25) + i);  // ties and their neighbours
    CHECK(difference(
              ints, [](Int a) { return Float(a); }, [](std::int32_t a) { return static_cast<float>(a); }) == "");
}
