#include "relief/decimal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

namespace relief {
namespace {

std::size_t skipDigits(std::string_view word, std::size_t at)
{
    while (at < word.size() && word[at] >= '0' && word[at] <= '9') ++at;
    return at;
}

bool hasSign(std::string_view word, std::size_t at)
{
    return at < word.size() && (word[at] == '+' || word[at] == '-');
}

bool isDecimal(std::string_view word)
{
    std::size_t at = hasSign(word, 0) ? 1 : 0;
    const std::size_t whole = skipDigits(word, at);
    std::size_t digits = whole - at;
    at = whole;
    if (at < word.size() && word[at] == '.') {
        const std::size_t fraction = skipDigits(word, at + 1);
        digits += fraction - (at + 1);
        at = fraction;
    }
    if (digits == 0 || at == word.size()) return digits > 0;
    if (word[at] != 'e' && word[at] != 'E') return false;
    at += hasSign(word, at + 1) ? 2 : 1;
    return at < word.size() && skipDigits(word, at) == word.size();
}

#if defined(__cpp_lib_to_chars)

// Of a number outside of the floats' range: whether it is a large one. Its first digit above 0 stands `place` digits
// before the point, exponent not counted.
bool isLarge(std::string_view word)
{
    const std::size_t mantissa = std::min(word.find_first_of("eE"), word.size());
    const std::string_view digits = word.substr(0, mantissa);
    const std::size_t point = std::min(digits.find('.'), mantissa), first = digits.find_first_of("123456789");
    const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(point) - static_cast<std::ptrdiff_t>(first);
    if (mantissa == word.size()) return place > 0;
    const std::size_t sign = hasSign(word, mantissa + 1) && word[mantissa + 1] == '+' ? 1 : 0;
    std::int64_t exponent = 0;
    const char* const begin = word.data() + mantissa + 1 + sign;
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), exponent);
    return error == std::errc() ? exponent > -place : *begin != '-';
}

float toFloat(std::string_view word)
{
    if (word.starts_with('+')) word.remove_prefix(1);
    float value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc()) return value;
    const float size = isLarge(word) ? std::numeric_limits<float>::infinity() : 0.0f;
    return word.starts_with('-') ? -size : size;
}

#else

// LLVM's C++ library has from_chars for integers only. There is one locale where it is used without a C library's own
// (emscripten): the point is a point.
float toFloat(std::string_view word)
{
    return std::strtof(std::string(word).c_str(), nullptr);
}

#endif

}  // namespace

std::optional<float> parseDecimal(std::string_view word)
{
    if (!isDecimal(word)) return std::nullopt;
    const float value = toFloat(word);
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace relief
