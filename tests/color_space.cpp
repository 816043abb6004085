// sRGB both ways against the C library's pow in long double, over all codes and over the floats of 0..1.
#include "relief/texture/color_space.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include "stability.h"

using namespace relief;
using stability::measured;

namespace {

long double referenceDecode(long double encoded)
{
    return encoded <= 0.04045L ? encoded / 12.92L : std::pow((encoded + 0.055L) / 1.055L, 2.4L);
}

double referenceEncode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

int toCode(float encoded)
{
    return static_cast<int>(encoded * 255.0f + 0.5f);
}

int encodedCode(float linear)
{
    return toCode(linearToSrgb(Float(linear))[0]);
}

// What a sweep over increasing floats found.
struct Sweep
{
    double worstError = 0.0;  // of the 8-bit code against the exact curve, in codes
    int codesThatFell = 0;    // a larger float with a smaller code
    int lastCode = 0;
    float largestStepDown = 0.0f;  // of the encoded float
    float last = 0.0f;

    void take(const float* linear, bool withReference)
    {
        float encoded[kLanes];
        linearToSrgb(Float::load(linear)).store(encoded);
        for (int i = 0; i < kLanes; ++i) {
            const int code = toCode(encoded[i]);
            codesThatFell += code < lastCode ? 1 : 0;
            largestStepDown = std::fmax(largestStepDown, last - encoded[i]);
            lastCode = code;
            last = encoded[i];
        }
        if (withReference)
            worstError = std::fmax(worstError, std::abs(lastCode - 255.0 * referenceEncode(linear[kLanes - 1])));
    }
};

}  // namespace

TEST_CASE("color_space: decoding 8-bit codes is correctly rounded (A-32)")
{
    for (int code = 0; code < 256; ++code) {
        const auto reference = static_cast<float>(referenceDecode(static_cast<long double>(code) / 255.0L));
        REQUIRE_MESSAGE(srgbToLinear(static_cast<std::uint8_t>(code)) == reference, "code ", code);
    }
    CHECK(srgbToLinear(std::uint8_t{0}) == 0.0f);
    CHECK(srgbToLinear(std::uint8_t{255}) == 1.0f);
}

TEST_CASE("color_space: decoding in doubles is exact to 1e-15 over all 16-bit codes")
{
    double worst = 0.0;
    for (int code = 1; code < 65536; ++code) {
        const long double reference = referenceDecode(static_cast<long double>(code) / 65535.0L);
        worst = std::fmax(worst, std::abs(static_cast<double>(decodeSrgb(code / 65535.0) / reference - 1.0L)));
    }
    CHECK(worst < 1e-15);
    CHECK(decodeSrgb(0.0) == 0.0);
    CHECK(decodeSrgb(1.0) == 1.0);
}

TEST_CASE("color_space: decoding to 16 bits rounds to nearest and costs at most 0.025 of an 8-bit code")
{
    double worst = 0.0;
    for (int code = 0; code < 256; ++code) {
        const auto linear = srgbToLinear16(static_cast<std::uint8_t>(code));
        const long double exact = 65535.0L * referenceDecode(static_cast<long double>(code) / 255.0L);
        REQUIRE(std::abs(static_cast<double>(linear - exact)) <= 0.5);
        REQUIRE(linear == srgbToLinear16(static_cast<std::uint16_t>(code * 257)));
        worst = std::fmax(worst, std::abs(255.0 * referenceEncode(linear / 65535.0) - code));
    }
    CHECK(worst < 0.025);
    CHECK(worst > 0.015);  // or else this test measures nothing
    for (int code = 0; code < 65536; code += 7) {
        const long double exact = 65535.0L * referenceDecode(static_cast<long double>(code) / 65535.0L);
        REQUIRE(std::abs(static_cast<double>(srgbToLinear16(static_cast<std::uint16_t>(code)) - exact)) <= 0.5);
    }
}

TEST_CASE("color_space: all 256 codes survive decoding and encoding, in float and in 16 bits (S-953)")
{
    for (int code = 0; code < 256; ++code) {
        const auto byte = static_cast<std::uint8_t>(code);
        REQUIRE(encodedCode(srgbToLinear(byte)) == code);
        REQUIRE(encodedCode(static_cast<float>(srgbToLinear16(byte)) / 65535.0f) == code);
    }
}

TEST_CASE("color_space: encoding 2^24 evenly spaced floats never falls and stays within 0.51 of a code (S-953, A-32)")
{
    Sweep sweep;
    float linear[kLanes];
    for (int k = 0; k <= (1 << 24) - kLanes; k += kLanes) {
        for (int i = 0; i < kLanes; ++i) linear[i] = static_cast<float>(k + 1 + i) / 16777216.0f;
        sweep.take(linear, k % 1024 == 0);
    }
    CHECK(sweep.lastCode == 255);
    measured("codes that fell", sweep.codesThatFell, 0);
    measured("error in codes", sweep.worstError, 0.51);
    CHECK(sweep.worstError > 0.49);
    // The polynomial's rounding noise: nowhere near the 1/255 of a code.
    measured("largest step down, of 1", sweep.largestStepDown, 2e-7f);
}

TEST_CASE("color_space: encoding floats of every exponent never falls (S-953)")
{
    Sweep sweep;
    float linear[kLanes];
    for (std::uint32_t bits = 0; bits + 61 * kLanes < 0x3f800000u; bits += 61 * kLanes) {
        for (std::uint32_t i = 0; i < kLanes; ++i) {
            const std::uint32_t b = bits + 61 * i;
            std::memcpy(&linear[i], &b, 4);
        }
        sweep.take(linear, bits % 4096 == 0);
    }
    measured("codes that fell", sweep.codesThatFell, 0);
    measured("error in codes", sweep.worstError, 0.51);
    measured("largest step down, of 1", sweep.largestStepDown, 2e-7f);
}

TEST_CASE("color_space: encoding clamps what is outside 0..1, and NaN to 0")
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    CHECK(encodedCode(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(encodedCode(-1.0f) == 0);
    CHECK(encodedCode(-infinity) == 0);
    CHECK(encodedCode(1e-42f) == 0);
    CHECK(encodedCode(1.0000001f) == 255);
    CHECK(encodedCode(infinity) == 255);
    CHECK(linearToSrgb(Float(0.0f))[0] == 0.0f);
    CHECK(linearToSrgb(Float(1.0f))[0] == 1.0f);
}
