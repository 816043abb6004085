// Masks, lanes that change places, doubles, and the floating-point environment. lanes_float.cpp and lanes_int.cpp hold
// the arithmetic.
#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include <doctest/doctest.h>

#include "lane_check.h"
#include "relief/lanes/double.h"
#include "relief/lanes/environment.h"
#include "relief/lanes/float.h"
#include "relief/texture/shading_scope.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace relief;
using namespace lane_check;

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
    RandomBits random;
    for (int i = 0; i < 1000; ++i) {
        const unsigned a = random() & kAllLanes;
        const unsigned b = random() & kAllLanes;
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

TEST_CASE("countBits: of every mask of a block")
{
    for (unsigned bits = 0; bits <= kAllLanes; ++bits) {
        int expected = 0;
        for (int i = 0; i < kLanes; ++i) expected += static_cast<int>(bits >> i & 1u);
        REQUIRE(countBits(bits) == expected);
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

TEST_CASE("shading scope: all lanes count until a thread says otherwise")
{
    CHECK(shading.activeLanes == kAllLanes);
}

// --- lanes that change places ---

namespace {

// Of one arrangement of a quad's lanes, two bits for each: how many lanes are not where they should be.
template <int code>
int misplacedLanes()
{
    float in[kLanes];
    for (int i = 0; i < kLanes; ++i) in[i] = static_cast<float>(i + 1);
    const Float p = permuteQuad<(code & 3), (code >> 2 & 3), (code >> 4 & 3), (code >> 6)>(Float::load(in));
    int misplaced = 0;
    for (int i = 0; i < kLanes; ++i) misplaced += p[i] != in[(i & ~3) + (code >> 2 * (i & 3) & 3)] ? 1 : 0;
    return misplaced;
}

template <int... code>
int misplacedLanes(std::integer_sequence<int, code...>)
{
    return (0 + ... + misplacedLanes<code>());
}

}  // namespace

TEST_CASE("maxOrNaN: the larger of two numbers that are not negative, NaN where one of them is NaN")
{
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const float numbers[] = {0.0f, 1e-45f, 1.0f, std::nextafter(1.0f, 2.0f), 3.4e38f, infinity, nan, -nan};
    int wrong = 0;
    for (const float a : numbers) {
        for (const float b : numbers) {
            const Float larger(native::maxOrNaN(Float(a).value, Float(b).value));
            for (int i = 0; i < kLanes; ++i) {
                const bool right = std::isnan(a) || std::isnan(b) ? std::isnan(larger[i]) : larger[i] == std::max(a, b);
                wrong += right ? 0 : 1;
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("permuteQuad: every arrangement, in every quad")
{
    CHECK(misplacedLanes(std::make_integer_sequence<int, 256>{}) == 0);
}

namespace {

// Some bytes, and an address for every lane: unaligned, in no order, one of them twice.
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

TEST_CASE("permute: any lane from any other, floats and integers")
{
    RandomBits random;
    for (int round = 0; round < 100; ++round) {
        Int values, from;
        for (int i = 0; i < kLanes; ++i) {
            values.set(i, static_cast<std::int32_t>(random()));
            from.set(i, static_cast<std::int32_t>(random() % kLanes));
        }
        const Int integers = permute(values, from), floats = asInt(permute(asFloat(values), from));
        for (int i = 0; i < kLanes; ++i) {
            CHECK(integers[i] == values[from[i]]);
            CHECK(floats[i] == values[from[i]]);
        }
    }
}

TEST_CASE("loadTransposed: word k of every lane's address")
{
    const Memory memory;
    native::IntVector out[4];
    native::loadTransposed<native::FourWords>([&](int lane) { return memory.address[lane]; }, out);
    for (int k = 0; k < 4; ++k) {
        for (int i = 0; i < kLanes; ++i) CHECK(Int(out[k])[i] == memory.wordAt(i, k));
    }
}

TEST_CASE("storeTransposed: word k of every lane's address, and no other byte")
{
    std::array<std::byte, 32 * kLanes> bytes{};
    std::array<std::byte, 32 * kLanes> expected{};
    std::byte* address[kLanes];
    native::IntVector in[4];
    for (int i = 0; i < kLanes; ++i) {
        const std::size_t place = static_cast<std::size_t>(i * 7 % kLanes) * 32 + static_cast<std::size_t>(i);
        address[i] = bytes.data() + place;
        for (int k = 0; k < 4; ++k) {
            const std::int32_t word = 0x00034567 * (4 * i + k + 1);
            in[k][i] = word;
            std::memcpy(expected.data() + place + 4 * k, &word, 4);
        }
    }
    native::storeTransposed(in, [&](int lane) { return address[lane]; });
    CHECK(bytes == expected);
}

TEST_CASE("loadTransposed of two words: both words of every lane's address")
{
    const Memory memory;
    native::IntVector out[2];
    native::loadTransposed<native::TwoWords>([&](int lane) { return memory.address[lane]; }, out);
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < kLanes; ++i) CHECK(Int(out[k])[i] == memory.wordAt(i, k));
    }
}

TEST_CASE("loadTransposed: from two addresses per lane")
{
    const Memory memory;
    native::IntVector out[4], next[4];
    native::loadTransposed<native::FourWords>([&](int i) { return memory.address[i]; },
                                              [&](int i) { return memory.address[(i + 1) % kLanes]; }, out, next);
    for (int k = 0; k < 4; ++k) {
        for (int i = 0; i < kLanes; ++i) {
            CHECK(Int(out[k])[i] == memory.wordAt(i, k));
            CHECK(Int(next[k])[i] == memory.wordAt((i + 1) % kLanes, k));
        }
    }
}

TEST_CASE("multiplyAddHalves: signed halves, exact sums")
{
    RandomBits random;
    for (int round = 0; round < 100; ++round) {
        Int a, b;
        std::int32_t expected[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const auto half = [&random] { return static_cast<std::int16_t>(random() & 0xffff); };
            const std::int16_t lowA = half(), highA = half(), lowB = half();
            const auto highB = static_cast<std::int16_t>(half() | 1);  // not all four -32768
            const auto pack = [](std::int16_t low, std::int16_t high) {
                return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint16_t>(high)) << 16 |
                                                 static_cast<std::uint16_t>(low));
            };
            a.set(i, pack(lowA, highA));
            b.set(i, pack(lowB, highB));
            expected[i] = lowA * lowB + highA * highB;
        }
        CHECK(all(multiplyAddHalves(a, b) == Int::load(expected)));
    }
}

TEST_CASE("upperBytes: of both halves of every lane")
{
    RandomBits random;
    for (int round = 0; round < 100; ++round) {
        Int a;
        std::int32_t expected[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t bits = random();
            a.set(i, static_cast<std::int32_t>(bits));
            expected[i] = static_cast<std::int32_t>(bits >> 8 & 0x00ff00ffu);
        }
        CHECK(all(upperBytes(a) == Int::load(expected)));
    }
}

TEST_CASE("inRows: pixel after pixel, row after row")
{
    const Int x = inRows(laneXs()), y = inRows(laneYs());
    for (int i = 0; i < kLanes; ++i) {
        CHECK(x[i] == i % kBlockWidth);
        CHECK(y[i] == i / kBlockWidth);
        CHECK(laneAt(laneX(i), laneY(i)) == i);
    }
}

// --- Double ---

namespace {

constexpr std::int64_t kTwo53 = std::int64_t{1} << 53;

// Different numbers in the lanes, close to +-limit.
Double nearLimit(double limit, double step)
{
    double numbers[kLanes];
    for (int i = 0; i < kLanes; ++i) numbers[i] = (i % 2 == 0 ? 1.0 : -1.0) * (limit - step * i);
    Double d;
    std::memcpy(&d.low, numbers, sizeof d.low);
    std::memcpy(&d.high, numbers + kLanes / 2, sizeof d.high);
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
    for (int i = 0; i < kLanes; ++i) {
        const std::int64_t exact = (i % 2 == 0 ? 1 : -1) * (kTwo53 - 64 - i);
        CHECK(static_cast<std::int64_t>(up[i]) == exact + 63);
        CHECK(static_cast<std::int64_t>(down[i]) == exact - 63);
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
    _mm_setcsr(before | kFlushToZero | kDenormalsAreZero);
    volatile float tiny = kSmallestNormal;
    volatile float flushed = tiny * 0.5f;
    const unsigned callers = _mm_getcsr();
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
