// Lanes against plain C++, lane by lane and bit by bit: whatever the width and the instruction set, an operation gives
// what the scalar one gives. Any NaN counts as equal to any other, since nothing depends on which one it is.
#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "lanes/active.h"
#include "lanes/double.h"
#include "lanes/environment.h"
#include "lanes/float.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace relief;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
constexpr float kSmallestNormal = std::numeric_limits<float>::min();
constexpr float kLargest = std::numeric_limits<float>::max();
constexpr std::int32_t kIntMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kIntMax = std::numeric_limits<std::int32_t>::max();

// Small, because the tests below take all pairs of them.
const std::vector<float> kFloats = {0.0f,
                                    -0.0f,
                                    1.0f,
                                    -1.0f,
                                    0.5f,
                                    -0.5f,
                                    1.5f,
                                    -1.5f,
                                    2.5f,
                                    -2.5f,
                                    0.75f,
                                    -0.75f,
                                    0.1f,
                                    -0.1f,
                                    kSmallest,
                                    -kSmallest,
                                    1e-40f,
                                    -1e-40f,
                                    1e-20f,
                                    kSmallestNormal,
                                    -kSmallestNormal,
                                    3.0f,
                                    1e6f,
                                    8388607.5f,
                                    -8388607.5f,
                                    8388608.0f,
                                    -8388608.0f,
                                    16777217.0f,
                                    2147483520.0f,
                                    -2147483520.0f,
                                    2147483648.0f,
                                    -2147483648.0f,
                                    3e9f,
                                    -3e9f,
                                    1e20f,
                                    kLargest,
                                    -kLargest,
                                    kInfinity,
                                    -kInfinity,
                                    kNan,
                                    -kNan};

const std::vector<std::int32_t> kInts = {0,       1,           -1,      2,          -2,         3,       7,
                                         -7,      31,          255,     -256,       65535,      65536,   -65537,
                                         1000,    46341,       -46341,  0x55555555, 0x3f800000, 1 << 30, -(1 << 30),
                                         kIntMin, kIntMin + 1, kIntMax, kIntMax - 1};

// Pseudo-random bits (xorshift), the same in every run.
class RandomBits
{
public:
    std::uint32_t operator()()
    {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        return state;
    }

private:
    std::uint32_t state = 2463534242u;
};

// kFloats, and many more of all exponents.
std::vector<float> manyFloats()
{
    std::vector<float> floats = kFloats;
    RandomBits random;
    for (int i = 0; i < 20000; ++i) floats.push_back(std::bit_cast<float>(random()));
    // Near zero, where rounding happens: halves, and their neighbours.
    for (int i = -2000; i <= 2000; ++i) {
        const float half = static_cast<float>(i) * 0.5f;
        floats.push_back(half);
        floats.push_back(std::nextafter(half, kInfinity));
        floats.push_back(std::nextafter(half, -kInfinity));
    }
    return floats;
}

bool same(float a, float b)
{
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}
bool same(std::int32_t a, std::int32_t b)
{
    return a == b;
}
bool same(bool a, bool b)
{
    return a == b;
}

std::string show(float a)
{
    std::ostringstream text;
    text << std::hexfloat << a;
    return text.str();
}
std::string show(std::int32_t a)
{
    return std::to_string(a);
}

Float load(const float* lanes)
{
    return Float::load(lanes);
}
Int load(const std::int32_t* lanes)
{
    return Int::load(lanes);
}

// What the lanes give for all values, where it differs from what the scalar function gives: the first such value, or
// nothing. The values are used in every lane, one after the other.
template <class T, class Lanes, class Scalar>
std::string difference(const std::vector<T>& values, Lanes lanes, Scalar scalar)
{
    T in[kLanes];
    for (std::size_t begin = 0; begin < values.size(); ++begin) {
        for (int i = 0; i < kLanes; ++i) in[i] = values[(begin + static_cast<std::size_t>(i)) % values.size()];
        const auto result = lanes(load(in));
        for (int i = 0; i < kLanes; ++i) {
            if (!same(result[i], scalar(in[i]))) {
                return "lane " + std::to_string(i) + " of " + std::to_string(kLanes) + " for " + show(in[i]);
            }
        }
    }
    return "";
}

// The same for all pairs of values.
template <class T, class Lanes, class Scalar>
std::string differenceOfPairs(const std::vector<T>& values, Lanes lanes, Scalar scalar)
{
    for (const T b : values) {
        const std::string found = difference(
            values, [&](auto a) { return lanes(a, decltype(a)(b)); }, [&](T a) { return scalar(a, b); });
        if (!found.empty()) return found + " and " + show(b);
    }
    return "";
}

// For every arrangement of the four lanes of a quad: calls check.operator()<a0, a1, a2, a3>().
template <class Check, std::size_t... code>
void forEachPermutation(const Check& check, std::index_sequence<code...>)
{
    (check.template operator() < code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 & 3 > (), ...);
}

}  // namespace

// --- Mask ---

TEST_CASE("Mask: bits go in and come back")
{
    for (unsigned bits = 0; bits <= 0xffffu; ++bits) REQUIRE(Mask::fromBits(bits).bits() == (bits & kAllLanes));
}

TEST_CASE("Mask: bits beyond the lanes are ignored")
{
    CHECK(Mask::fromBits(~0u).bits() == kAllLanes);
    CHECK(all(Mask::fromBits(~0u)));
    CHECK(none(!Mask::fromBits(~0u)));
}

TEST_CASE("Mask: lane i is bit i")
{
    for (int lane = 0; lane < kLanes; ++lane) {
        const Mask m = Mask::fromBits(1u << lane);
        for (int i = 0; i < kLanes; ++i) CHECK(m[i] == (i == lane));
    }
}

TEST_CASE("Mask: and, or, not")
{
    for (unsigned a = 0; a <= kAllLanes; a += 37) {
        for (unsigned b = 0; b <= kAllLanes; b += 41) {
            const Mask x = Mask::fromBits(a);
            const Mask y = Mask::fromBits(b);
            REQUIRE((x & y).bits() == (a & b));
            REQUIRE((x | y).bits() == (a | b));
            REQUIRE((!x).bits() == (~a & kAllLanes));
            Mask z = x;
            REQUIRE((z &= y).bits() == (a & b));
            REQUIRE((z |= x).bits() == a);
        }
    }
}

TEST_CASE("Mask: any, all, none and count")
{
    CHECK(all(Mask(true)));
    CHECK(any(Mask(true)));
    CHECK_FALSE(none(Mask(true)));
    CHECK(none(Mask(false)));
    CHECK_FALSE(any(Mask(false)));
    CHECK_FALSE(all(Mask(false)));
    for (int lane = 0; lane < kLanes; ++lane) {
        const Mask one = Mask::fromBits(1u << lane);
        CHECK(any(one));
        CHECK_FALSE(all(one));
        CHECK_FALSE(none(one));
        CHECK(count(one) == 1);
        CHECK_FALSE(all(!one));
        CHECK(any(!one));
        CHECK(count(!one) == kLanes - 1);
    }
}

TEST_CASE("Mask: wholeQuads completes every quad of which one pixel is set")
{
    for (unsigned bits = 0; bits <= 0xffffu; ++bits) {
        unsigned expected = 0;
        for (unsigned quad = 0; quad < 4; ++quad) {
            if ((bits >> 4 * quad & 0xfu) != 0) expected |= 0xfu << 4 * quad;
        }
        REQUIRE(wholeQuads(bits) == expected);
    }
}

TEST_CASE("activeLanes: all of them until a thread says otherwise")
{
    CHECK(activeLanes == kAllLanes);
}

// --- Float ---

TEST_CASE("Float: a plain number is the same in every lane")
{
    for (int i = 0; i < kLanes; ++i) {
        CHECK(Float(0.1f)[i] == 0.1f);
        CHECK(Float(0.1)[i] == 0.1f);
        CHECK(Float(7)[i] == 7.0f);
        CHECK(std::signbit(Float(-0.0f)[i]));
    }
}

TEST_CASE("Float: load, store and set keep every bit")
{
    float in[kLanes];
    float out[kLanes];
    RandomBits random;
    for (int i = 0; i < kLanes; ++i) in[i] = std::bit_cast<float>(random() & 0xff7fffffu);
    in[0] = -0.0f;
    Float f = Float::load(in);
    f.set(kLanes - 1, kSmallest);
    in[kLanes - 1] = kSmallest;
    f.store(out);
    CHECK(std::memcmp(in, out, sizeof in) == 0);
}

TEST_CASE("Float: sum, difference, product and quotient")
{
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a + b; }, [](float a, float b) { return a + b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a - b; }, [](float a, float b) { return a - b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a * b; }, [](float a, float b) { return a * b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a / b; }, [](float a, float b) { return a / b; }) == "");
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
    // (1 + e)(1 - e) - 1 is -e^2 where a fused operation keeps the product, and 0 where it is rounded.
    volatile float e = 0x1p-13f;
    const Float product = Float(1.0f + e) * Float(1.0f - e) - 1.0f;
    CHECK(product[0] == 0.0f);
}

TEST_CASE("Float: minus changes the sign, also of zero")
{
    CHECK(difference(
              kFloats, [](Float a) { return -a; }, [](float a) { return -a; }) == "");
    CHECK(difference(
              kFloats, [](Float a) { return +a; }, [](float a) { return a; }) == "");
    CHECK(std::signbit((-Float(0.0f))[0]));
}

TEST_CASE("Float: comparisons")
{
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a < b; }, [](float a, float b) { return a < b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a <= b; }, [](float a, float b) { return a <= b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a > b; }, [](float a, float b) { return a > b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a >= b; }, [](float a, float b) { return a >= b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a == b; }, [](float a, float b) { return a == b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return a != b; }, [](float a, float b) { return a != b; }) == "");
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
    CHECK(difference(
              manyFloats(), [](Float a) { return asInt(a); }, [](float a) { return std::bit_cast<std::int32_t>(a); }) ==
          "");
    CHECK(difference(
              kInts, [](Int a) { return asFloat(a); }, [](std::int32_t a) { return std::bit_cast<float>(a); }) == "");
}

TEST_CASE("Float: abs clears the sign alone")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return asInt(abs(a)); },
              [](float a) { return std::bit_cast<std::int32_t>(a) & kIntMax; }) == "");
}

TEST_CASE("Float: sqrt is the correctly rounded one")
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
    CHECK(std::signbit(floor(Float(-0.0f))[0]));
    CHECK(std::signbit(ceil(Float(-0.5f))[0]));
}

TEST_CASE("Float: frac is what is above the floor")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return frac(a); }, [](float a) { return a - std::floor(a); }) == "");
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

TEST_CASE("Float: min and max of all pairs, the second of two equal ones")
{
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return min(a, b); },
              [](float a, float b) { return std::isnan(b) ? a
                                            : a < b       ? a
                                                          : b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return max(a, b); },
              [](float a, float b) { return std::isnan(b) ? a
                                            : a > b       ? a
                                                          : b; }) == "");
    CHECK(differenceOfPairs(
              kFloats, [](Float a, Float b) { return min(a, b) == Float(0.0f); },
              [](float a, float b) { return std::fmin(a, b) == 0.0f; }) == "");
}

TEST_CASE("Float: saturate of NaN is 0")
{
    CHECK(asInt(saturate(Float(kNan)))[0] == 0);
    CHECK(asInt(saturate(Float(-kNan)))[0] == 0);
}

TEST_CASE("Float: saturate stays in [0, 1] and has no negative zero")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return saturate(a); },
              [](float a) { return a > 0.0f ? (a < 1.0f ? a : 1.0f) : 0.0f; }) == "");
}

TEST_CASE("Float: clamp, with NaN to the lower limit")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return clamp(a, -2.0f, 3.5f); },
              [](float a) { return a > -2.0f ? (a < 3.5f ? a : 3.5f) : -2.0f; }) == "");
    CHECK(clamp(Float(kNan), -2.0f, 3.5f)[kLanes - 1] == -2.0f);
}

TEST_CASE("Float: numeric_limits are float's")
{
    static_assert(std::numeric_limits<Float>::is_iec559);
    CHECK(std::numeric_limits<Float>::epsilon() == std::numeric_limits<float>::epsilon());
}

// --- Float to Int and back ---

namespace {

float limited(float a)
{
    if (!(a > -2147483520.0f)) return -2147483520.0f;
    return a < 2147483520.0f ? a : 2147483520.0f;
}

}  // namespace

TEST_CASE("roundToInt: to the nearest, as std::nearbyint")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return roundToInt(a); },
              [](float a) { return static_cast<std::int32_t>(std::nearbyint(limited(a))); }) == "");
}

TEST_CASE("roundToInt: ties go to the even side, below zero too")
{
    std::vector<float> ties;
    for (int k = -(1 << 22); k < 1 << 22; k += 61) ties.push_back(static_cast<float>(k) + 0.5f);
    for (int k = -1000; k < 1000; ++k) ties.push_back(static_cast<float>(k) + 0.5f);
    CHECK(difference(
              ties, [](Float a) { return roundToInt(a); },
              [](float a) {
                  const auto below = static_cast<std::int32_t>(std::floor(a));
                  return below % 2 == 0 ? below : below + 1;
              }) == "");
}

TEST_CASE("roundToInt: snapping to 1/256 is symmetric around zero")
{
    std::vector<float> snapped;
    for (int k = 0; k < 4096; ++k) snapped.push_back((static_cast<float>(k) / 256.0f + 1.0f / 512.0f) * 256.0f);
    CHECK(difference(
              snapped, [](Float a) { return roundToInt(a) + roundToInt(-a); }, [](float) { return 0; }) == "");
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

TEST_CASE("truncateToInt: toward zero")
{
    CHECK(difference(
              manyFloats(), [](Float a) { return truncateToInt(a); },
              [](float a) { return static_cast<std::int32_t>(limited(a)); }) == "");
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

// --- Int ---

namespace {

std::int32_t wrap(std::int64_t a)
{
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a));
}

}  // namespace

TEST_CASE("Int: sum, difference and product wrap around")
{
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a + b; }, [](std::int64_t a, std::int64_t b) { return wrap(a + b); }) ==
          "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a - b; }, [](std::int64_t a, std::int64_t b) { return wrap(a - b); }) ==
          "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a * b; }, [](std::int64_t a, std::int64_t b) { return wrap(a * b); }) ==
          "");
    CHECK(difference(
              kInts, [](Int a) { return -a; }, [](std::int64_t a) { return wrap(-a); }) == "");
}

TEST_CASE("Int: compound assignment")
{
    Int a = 3;
    CHECK((a += Int(4))[0] == 7);
    CHECK((a -= Int(10))[0] == -3);
    CHECK(a[kLanes - 1] == -3);
}

TEST_CASE("Int: and, or, exclusive or")
{
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a & b; }, [](std::int32_t a, std::int32_t b) { return a & b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a | b; }, [](std::int32_t a, std::int32_t b) { return a | b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a ^ b; }, [](std::int32_t a, std::int32_t b) { return a ^ b; }) == "");
}

TEST_CASE("Int: shifts by every number of bits")
{
    for (int bits = 0; bits < 32; ++bits) {
        CAPTURE(bits);
        CHECK(difference(
                  kInts, [&](Int a) { return a << bits; },
                  [&](std::int32_t a) { return wrap(std::int64_t{a} * (std::int64_t{1} << bits)); }) == "");
        CHECK(difference(
                  kInts, [&](Int a) { return a >> bits; }, [&](std::int32_t a) { return a >> bits; }) == "");
        CHECK(difference(
                  kInts, [&](Int a) { return shiftRightLogical(a, bits); },
                  [&](std::int32_t a) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) >> bits); }) ==
              "");
    }
}

TEST_CASE("Int: comparisons")
{
    using I = std::int32_t;
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a < b; }, [](I a, I b) { return a < b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a <= b; }, [](I a, I b) { return a <= b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a > b; }, [](I a, I b) { return a > b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a >= b; }, [](I a, I b) { return a >= b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a == b; }, [](I a, I b) { return a == b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a != b; }, [](I a, I b) { return a != b; }) == "");
}

TEST_CASE("Int: min, max and clamp")
{
    using I = std::int32_t;
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return min(a, b); }, [](I a, I b) { return a < b ? a : b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return max(a, b); }, [](I a, I b) { return a > b ? a : b; }) == "");
    CHECK(difference(
              kInts, [](Int a) { return clamp(a, -7, 255); }, [](I a) { return a < -7    ? -7
                                                                               : a > 255 ? 255
                                                                                         : a; }) ==
          "");
}

TEST_CASE("Int: select takes every lane from the side that its mask names")
{
    std::int32_t a[kLanes];
    std::int32_t b[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        a[i] = kIntMin + i;
        b[i] = kIntMax - i;
    }
    for (unsigned bits = 0; bits <= kAllLanes; bits += 29) {
        const Int s = select(Mask::fromBits(bits), Int::load(a), Int::load(b));
        for (int i = 0; i < kLanes; ++i) REQUIRE(s[i] == ((bits >> i & 1u) != 0 ? a[i] : b[i]));
    }
}

TEST_CASE("Int: signBits has bit i where lane i is negative")
{
    CHECK(difference(
              kInts, [](Int a) { return Mask::fromBits(signBits(a)); }, [](std::int32_t a) { return a < 0; }) == "");
    CHECK(signBits(Int(-1)) == kAllLanes);
    CHECK(signBits(Int(kIntMin)) == kAllLanes);
    CHECK(signBits(Int(kIntMax)) == 0);
}

TEST_CASE("Int: load, store and set")
{
    std::int32_t in[kLanes];
    std::int32_t out[kLanes];
    for (int i = 0; i < kLanes; ++i) in[i] = 1000 - 77 * i;
    Int v = Int::load(in);
    v.set(1, kIntMin);
    v.store(out);
    for (int i = 0; i < kLanes; ++i) CHECK(out[i] == (i == 1 ? kIntMin : in[i]));
}

// --- rearranging lanes ---

TEST_CASE("permuteQuad: every arrangement, in every quad")
{
    float in[kLanes];
    for (int i = 0; i < kLanes; ++i) in[i] = static_cast<float>(i + 1);
    const Float v = Float::load(in);
    int wrong = 0;
    forEachPermutation(
        [&]<std::size_t a0, std::size_t a1, std::size_t a2, std::size_t a3>() {
            const Float p =
                permuteQuad<static_cast<int>(a0), static_cast<int>(a1), static_cast<int>(a2), static_cast<int>(a3)>(v);
            const std::array<std::size_t, 4> from = {a0, a1, a2, a3};
            for (int i = 0; i < kLanes; ++i) {
                const int expected = (i & ~3) + static_cast<int>(from[static_cast<std::size_t>(i & 3)]);
                if (p[i] != in[expected]) ++wrong;
            }
        },
        std::make_index_sequence<256>{});
    CHECK(wrong == 0);
}

namespace {

// 256 different words, and an address for every lane: unaligned, in no order, partly the same.
struct Memory
{
    Memory()
    {
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 167u + i / 251u);
        RandomBits random;
        for (int i = 0; i < kLanes; ++i) address[i] = bytes.data() + random() % (bytes.size() - 16);
        address[kLanes - 1] = address[0];
    }
    std::int32_t wordAt(int lane, int k) const
    {
        std::int32_t word;
        std::memcpy(&word, address[lane] + 4 * k, 4);
        return word;
    }
    std::array<std::byte, 1024> bytes;
    const std::byte* address[kLanes];
};

}  // namespace

TEST_CASE("loadTransposed: word k of every lane's address")
{
    const Memory memory;
    native::IntVector out[4];
    native::loadTransposed(memory.address, out);
    for (int k = 0; k < 4; ++k) {
        for (int i = 0; i < kLanes; ++i) CHECK(Int(out[k])[i] == memory.wordAt(i, k));
    }
}

TEST_CASE("loadTransposedPair: both words of every lane's address")
{
    const Memory memory;
    native::IntVector out[2];
    native::loadTransposedPair(memory.address, out);
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < kLanes; ++i) CHECK(Int(out[k])[i] == memory.wordAt(i, k));
    }
}

// --- Double ---

namespace {

constexpr std::int64_t kTwo53 = std::int64_t{1} << 53;

// Different numbers in the lanes, close to +-limit.
Double nearLimit(double limit, double step)
{
    Double d = limit;
    for (int i = 0; i < kLanes; ++i) {
        const double number = (i % 2 == 0 ? 1.0 : -1.0) * (limit - step * i);
        (i < kLanes / 2 ? d.low : d.high)[i % (kLanes / 2)] = number;
    }
    return d;
}

}  // namespace

TEST_CASE("Double: of every Int, exactly, lane for lane")
{
    std::int32_t in[kLanes];
    for (std::size_t begin = 0; begin < kInts.size(); ++begin) {
        for (int i = 0; i < kLanes; ++i) in[i] = kInts[(begin + static_cast<std::size_t>(i)) % kInts.size()];
        const Double d(Int::load(in));
        for (int i = 0; i < kLanes; ++i) CHECK(d[i] == static_cast<double>(in[i]));
    }
}

TEST_CASE("Double: sums and differences of integers are exact up to 2^53")
{
    const Double d = nearLimit(static_cast<double>(kTwo53 - 64), 1.0);
    const Double up = d + Double(63.0);
    const Double down = d - Double(63.0);
    Double added = d;
    added += Double(1.0);
    for (int i = 0; i < kLanes; ++i) {
        const std::int64_t exact = (i % 2 == 0 ? 1 : -1) * (kTwo53 - 64 - i);
        CHECK(static_cast<std::int64_t>(up[i]) == exact + 63);
        CHECK(static_cast<std::int64_t>(down[i]) == exact - 63);
        CHECK(static_cast<std::int64_t>(added[i]) == exact + 1);
    }
}

TEST_CASE("Double: products of integers are exact up to 2^53")
{
    for (int i = 0; i < 1000; ++i) {
        const std::int32_t a = (1 << 26) - 7 * i;
        const std::int32_t b = (1 << 27) - 1 - 3 * i;
        const Double product = Double(Int(a)) * Double(Int(-b));
        REQUIRE(static_cast<std::int64_t>(product[i % kLanes]) == -std::int64_t{a} * b);
    }
}

TEST_CASE("Double: negativeBits has bit i where lane i is below zero")
{
    for (int lane = 0; lane < kLanes; ++lane) {
        std::int32_t in[kLanes] = {};
        in[lane] = -1;
        CHECK(negativeBits(Double(Int::load(in))) == 1u << lane);
        CHECK(negativeBits(Double(Int::load(in)) + Double(1.0)) == 0);
        CHECK(negativeBits(Double(0.0) - Double(Int::load(in)) - Double(0.5)) == (kAllLanes & ~(1u << lane)));
    }
}

TEST_CASE("Double: neither zero nor NaN is negative, the smallest number below zero is")
{
    CHECK(negativeBits(Double(0.0)) == 0);
    CHECK(negativeBits(Double(-0.0)) == 0);
    CHECK(negativeBits(Double(-std::numeric_limits<double>::quiet_NaN())) == 0);
    CHECK(negativeBits(Double(-std::numeric_limits<double>::denorm_min())) == kAllLanes);
    CHECK(negativeBits(Double(-std::numeric_limits<double>::infinity())) == kAllLanes);
}

TEST_CASE("Double: toFloat rounds to the nearest float, lane for lane")
{
    const Double d = nearLimit(16777217.0 * 4.0, 1.0);  // more bits than a float has, ties among them
    const Float f = toFloat(d);
    for (int i = 0; i < kLanes; ++i) CHECK(f[i] == static_cast<float>(d[i]));
    CHECK(toFloat(Double(1e300))[0] == kInfinity);
    CHECK(toFloat(Double(1e-300))[kLanes - 1] == 0.0f);
    CHECK(toFloat(Double(1.5 * static_cast<double>(kSmallest)))[0] == 2.0f * kSmallest);
}

// --- the floating-point environment ---

TEST_CASE("Float: subnormal numbers are kept")
{
    const DefaultFloatingPoint environment;
    volatile float tiny = kSmallestNormal;
    CHECK((Float(tiny) * 0.5f)[0] == 0x1p-127f);
    CHECK((Float(tiny) * 0.5f + Float(tiny) * 0.5f)[0] == kSmallestNormal);
}

#if !defined(__wasm__)
TEST_CASE("DefaultFloatingPoint: rounds to the nearest inside, and gives the caller's rounding back")
{
    REQUIRE(std::fesetround(FE_UPWARD) == 0);
    volatile float one = 1.0f;
    volatile float tiny = 1e-20f;
    volatile float above = one + tiny;
    float nearest;
    {
        const DefaultFloatingPoint environment;
        volatile float sum = one + tiny;
        nearest = sum;
    }
    const int restored = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(above > 1.0f);
    CHECK(nearest == 1.0f);
    CHECK(restored == FE_UPWARD);
}
#endif

#if defined(__SSE2__)
TEST_CASE("DefaultFloatingPoint: keeps subnormals inside, and gives the caller's whole control word back")
{
    constexpr unsigned kFlushToZero = 0x8000u;
    constexpr unsigned kDenormalsAreZero = 0x0040u;
    const unsigned before = _mm_getcsr();
    const unsigned callers = (before & ~0x3fu) | kFlushToZero | kDenormalsAreZero;
    _mm_setcsr(callers);
    volatile float tiny = kSmallestNormal;
    volatile float flushed = tiny * 0.5f;
    float kept;
    {
        const DefaultFloatingPoint environment;
        volatile float half = tiny * 0.5f;
        kept = half;
    }
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    CHECK(flushed == 0.0f);
    CHECK(kept == 0x1p-127f);
    CHECK(after == callers);
}
#endif
