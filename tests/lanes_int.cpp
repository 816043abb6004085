// Int: 32 bits that wrap around, lane by lane as the scalar ones would.
#include <doctest/doctest.h>

#include "lane_check.h"
#include "relief/lanes/int.h"

using namespace relief;
using namespace lane_check;

namespace {

std::int32_t wrap(std::int64_t a)
{
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a));
}

}  // namespace

TEST_CASE("Int: sum, difference and product wrap around")
{
    using I = std::int64_t;
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a + b; }, [](I a, I b) { return wrap(a + b); }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a - b; }, [](I a, I b) { return wrap(a - b); }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return a * b; }, [](I a, I b) { return wrap(a * b); }) == "");
    CHECK(difference(
              kInts, [](Int a) { return -a; }, [](I a) { return wrap(-a); }) == "");
}

TEST_CASE("Int: compound assignment")
{
    Int a = 3;
    CHECK((a += Int(4))[0] == 7);
    CHECK((a -= Int(10))[0] == -3);
    CHECK(a[kLanes - 1] == -3);
    CHECK(all((a *= -7) == 21));
    CHECK(all((a /= 2) == 10));
    CHECK(all((a %= 7) == 3));
    CHECK(all((a <<= 4) == 48));
    CHECK(all((a |= 3) == 51));
    CHECK(all((a &= -3) == 49));
    CHECK(all((a ^= -1) == -50));
    CHECK(all((a >>= 1) == -25));
}

TEST_CASE("Int: and, or, exclusive or")
{
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a & b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a | b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a ^ b; }) == "");
}

TEST_CASE("Int: a shift to the left is a product with a power of two")
{
    for (int bits = 0; bits < 32; ++bits) {
        CAPTURE(bits);
        const auto product = [bits](std::int64_t a) { return wrap(a * (std::int64_t{1} << bits)); };
        CHECK(difference(
                  kInts, [bits](Int a) { return a << bits; }, product) == "");
    }
}

TEST_CASE("Int: a shift to the right keeps the sign")
{
    for (int bits = 0; bits < 32; ++bits) {
        CAPTURE(bits);
        CHECK(difference(kInts, [bits](auto a) { return a >> bits; }) == "");
    }
    CHECK((Int(kIntMin) >> 31)[0] == -1);
}

TEST_CASE("Int: shiftRightLogical brings in zeros")
{
    for (int bits = 0; bits < 32; ++bits) {
        CAPTURE(bits);
        const auto reference = [bits](std::int32_t a) { return wrap(static_cast<std::uint32_t>(a) >> bits); };
        CHECK(difference(
                  kInts, [bits](Int a) { return shiftRightLogical(a, bits); }, reference) == "");
    }
    CHECK(shiftRightLogical(Int(kIntMin), 31)[0] == 1);
}

TEST_CASE("Int: comparisons")
{
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a < b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a <= b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a > b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a >= b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a == b; }) == "");
    CHECK(differenceOfPairs(kInts, [](auto a, auto b) { return a != b; }) == "");
}

TEST_CASE("Int: min, max and clamp")
{
    using I = std::int32_t;
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return min(a, b); }, [](I a, I b) { return a < b ? a : b; }) == "");
    CHECK(differenceOfPairs(
              kInts, [](Int a, Int b) { return max(a, b); }, [](I a, I b) { return a > b ? a : b; }) == "");
    const auto clamped = [](I a) { return a < -7 ? -7 : a > 255 ? 255 : a; };
    CHECK(difference(
              kInts, [](Int a) { return clamp(a, -7, 255); }, clamped) == "");
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
    // All bits at once: g++ 12 compiles a loop that compares bit i with "number i < 0" as if the number were not there.
    for (std::size_t begin = 0; begin + kLanes <= kInts.size(); ++begin) {
        unsigned expected = 0;
        for (unsigned i = 0; i < kLanes; ++i) expected |= (kInts[begin + i] < 0 ? 1u : 0u) << i;
        CHECK(signBits(Int::load(&kInts[begin])) == expected);
    }
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

TEST_CASE("Int: quotients toward zero and their rests, of any two numbers")
{
    for (const std::int32_t divisor : {1, -1, 2, -3, 7, 1000, kIntMax, kIntMin, 0}) {
        for (std::size_t begin = 0; begin + kLanes <= kInts.size(); ++begin) {
            const Int a = Int::load(&kInts[begin]), quotient = a / divisor, rest = a % divisor;
            int wrong = 0;
            for (int i = 0; i < kLanes; ++i) {
                const std::int64_t exact = divisor == 0 ? -1 : std::int64_t{a[i]} / divisor;
                wrong += quotient[i] != static_cast<std::int32_t>(exact);
                wrong += rest[i] != (divisor == 0 ? a[i] : static_cast<std::int32_t>(std::int64_t{a[i]} % divisor));
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("Int: shifts by each lane's own number, of which five bits count, and the bits turned round")
{
    std::int32_t by[kLanes];
    for (int i = 0; i < kLanes; ++i) by[i] = 5 * i - 20;
    const Int bits = Int::load(by), value(-0x12345679);
    for (int i = 0; i < kLanes; ++i) {
        const int places = by[i] & 31;
        CHECK((value << bits)[i] == static_cast<std::int32_t>(static_cast<std::uint32_t>(value[i]) << places));
        CHECK((value >> bits)[i] == value[i] >> places);
        CHECK((~value)[i] == 0x12345678);
    }
    Int product = value;
    product *= 3;
    CHECK(all(product == value * 3));
}

TEST_CASE("Int: of one number of places, too, only the lowest five bits count")
{
    for (const int places : {0, 31, 32, 33, 63, -1, -31, kIntMin}) {
        volatile int hidden = places;  // the compiler must not work it out
        const int bits = hidden;
        CAPTURE(bits);
        const Int numbers = Int::load(kInts.data());
        CHECK(all((numbers << bits) == numbers << Int(bits)));
        CHECK(all((numbers >> bits) == numbers >> Int(bits)));
        CHECK(all(shiftRightLogical(numbers, bits) == shiftRightLogical(numbers, places & 31)));
    }
}
