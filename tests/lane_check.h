// Compares operations on lanes with the same operation on plain numbers, lane by lane and bit by bit. Any NaN counts as
// equal to any other, since nothing depends on which one it is.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "relief/lanes/float.h"

#include "numbers.h"

namespace lane_check {

inline constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
inline constexpr float kSmallestNormal = std::numeric_limits<float>::min();
inline constexpr float kLargest = std::numeric_limits<float>::max();
inline constexpr std::int32_t kIntMin = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t kIntMax = std::numeric_limits<std::int32_t>::max();

// What is easily got wrong. Few, because tests take all pairs of them.
inline const std::vector<float> kFloats = {
    0.0f, -0.0f, 0.5f, -0.5f, 1.0f, -1.0f, 1.5f, -1.5f, 2.5f, -2.5f, 3.0f, 0.75f, 0.1f, -0.1f, 1e6f, 16777217.0f,
    // where floats stop having fractions, and where they leave the range of integers
    8388607.5f, -8388607.5f, 8388608.0f, -8388608.0f, 2147483520.0f, -2147483520.0f, 2147483648.0f, -2147483648.0f,
    3e9f,
    // the ends of the range
    kSmallest, -kSmallest, 1e-40f, -1e-40f, 1e-20f, kSmallestNormal, -kSmallestNormal, 1e20f, kLargest, -kLargest,
    kInfinity, -kInfinity, kNan, -kNan};

inline const std::vector<std::int32_t> kInts = {
    0,     1,       -1,         2,          -2,      3,           7,       -7,         31,
    255,   -256,    65535,      65536,      -65537,  1000000,     46341,   -46341,     33333,
    -3333, 1 << 30, -(1 << 30), 0x55555555, kIntMin, kIntMin + 1, kIntMax, kIntMax - 1};

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

// kFloats; many more, of all exponents; and the multiples of a half near zero with their neighbours.
inline std::vector<float> manyFloats()
{
    std::vector<float> floats = kFloats;
    RandomBits random;
    for (int i = 0; i < 20000; ++i) floats.push_back(std::bit_cast<float>(random()));
    for (int i = -2000; i <= 2000; ++i) {
        const float half = static_cast<float>(i) * 0.5f;
        floats.insert(floats.end(), {half, std::nextafter(half, kInfinity), std::nextafter(half, -kInfinity)});
    }
    return floats;
}

inline bool same(float a, float b)
{
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}
inline bool same(std::int32_t a, std::int32_t b)
{
    return a == b;
}
inline bool same(bool a, bool b)
{
    return a == b;
}

template <class T>
std::string show(T a)
{
    std::ostringstream text;
    text << std::hexfloat << a;
    return text.str();
}

inline relief::Float load(const float* lanes)
{
    return relief::Float::load(lanes);
}
inline relief::Int load(const std::int32_t* lanes)
{
    return relief::Int::load(lanes);
}

// Where lanes(values) differs from scalar(value) of each: the first such value, or nothing. Every value is used in
// every lane.
template <class T, class Lanes, class Scalar>
std::string difference(const std::vector<T>& values, Lanes lanes, Scalar scalar)
{
    T in[relief::kLanes];
    for (std::size_t begin = 0; begin < values.size(); ++begin) {
        for (int i = 0; i < relief::kLanes; ++i) in[i] = values[(begin + static_cast<std::size_t>(i)) % values.size()];
        const auto result = lanes(load(in));
        for (int i = 0; i < relief::kLanes; ++i) {
            if (!same(result[i], scalar(in[i]))) return "lane " + std::to_string(i) + " for " + show(in[i]);
        }
    }
    return "";
}

// The same for all pairs of values.
template <class T, class Lanes, class Scalar>
std::string differenceOfPairs(const std::vector<T>& values, Lanes lanes, Scalar scalar)
{
    for (const T b : values) {
        const auto lanesOfA = [&](auto a) { return lanes(a, decltype(a)(b)); };
        const std::string found = difference(values, lanesOfA, [&](T a) { return scalar(a, b); });
        if (!found.empty()) return found + " and " + show(b);
    }
    return "";
}

// The same where one generic function does for both.
template <class T, class Function>
std::string difference(const std::vector<T>& values, Function function)
{
    return difference(values, function, function);
}
template <class T, class Function>
std::string differenceOfPairs(const std::vector<T>& values, Function function)
{
    return differenceOfPairs(values, function, function);
}

}  // namespace lane_check
