// Numbers of OBJ files: what is one, and which float it is.
#include "relief/decimal.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <doctest/doctest.h>

#include "relief/lanes/environment.h"

using relief::parseDecimal;

namespace {

std::uint32_t bitsOf(float value)
{
    return std::bit_cast<std::uint32_t>(value);
}

}  // namespace

TEST_CASE("obj number: plain decimal numbers and nothing else")
{
    CHECK(parseDecimal("1") == 1.0f);
    CHECK(parseDecimal("+1.") == 1.0f);
    CHECK(parseDecimal("-.5e+2") == -50.0f);
    CHECK(parseDecimal("12.5E-1") == 1.25f);
    CHECK(parseDecimal("00000000000000000000001") == 1.0f);
    for (const char* word : {"",    "+",   "-",    ".",    "e1",  "1e", "1e+", "1e5.", "1.2.3", "1,5",
                             "nan", "inf", "-inf", "0x10", "1d5", " 1", "1 ",  "--1",  "+-1",   "1f"}) {
        CAPTURE(word);
        CHECK_FALSE(parseDecimal(word).has_value());
    }
}

TEST_CASE("obj number: too large for a float is no number, too small is 0 of its sign")
{
    const std::string zeros(400, '0');
    for (const std::string& word :
         {std::string("3.5e38"), std::string("-1e39"), std::string("1e999"), std::string("1e1234567890123"),
          "1" + zeros, std::string("0.1e99999999999999999999"), std::string("1e9223372036854775807"),
          std::string("5000e9223372036854775806"), "1" + zeros + "e-5"}) {
        CAPTURE(word);
        CHECK_FALSE(parseDecimal(word).has_value());
    }
    for (const std::string& word : {std::string("1e-46"), std::string("1e-999"), std::string("1e-99999999999999999999"),
                                    "0." + zeros + "1", "1e-4" + zeros, "0." + zeros + "1e300", std::string("0e999")}) {
        CAPTURE(word);
        REQUIRE(parseDecimal(word).has_value());
        CHECK(bitsOf(*parseDecimal(word)) == 0u);
        CHECK(bitsOf(*parseDecimal("-" + word)) == 0x80000000u);
    }
    CHECK(parseDecimal("3.4028235e38") == 0x1.fffffep127f);
    CHECK(parseDecimal("1e-45") == 0x1p-149f);
    CHECK(parseDecimal("0.000001" + zeros + "e6") == 1.0f);
}

TEST_CASE("obj number: the nearest float, as the C library finds it")
{
    std::uint64_t state = 11;
    const auto next = [&] { return (state = state * 6364136223846793005u + 1442695040888963407u) >> 33; };
    for (int i = 0; i < 20000; ++i) {
        std::string word = next() % 2 ? "-" : "";
        for (std::uint64_t digits = 1 + next() % 12; digits > 0; --digits) word += static_cast<char>('0' + next() % 10);
        word += '.';
        for (std::uint64_t digits = next() % 24; digits > 0; --digits) word += static_cast<char>('0' + next() % 10);
        if (next() % 2) word += "e" + std::to_string(static_cast<int>(next() % 60) - 42);
        const float expected = std::strtof(word.c_str(), nullptr);
        CAPTURE(word);
        if (!std::isfinite(expected)) {
            CHECK_FALSE(parseDecimal(word).has_value());
        } else {
            CHECK(bitsOf(parseDecimal(word).value_or(NAN)) == bitsOf(expected));
        }
    }
    // Halfway between two floats, and a little above.
    CHECK(parseDecimal("16777217") == 16777216.0f);
    CHECK(parseDecimal("16777217.0000000000000000000000000000001") == 16777218.0f);
}
