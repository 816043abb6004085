// exp, log, pow, sin, cos and their like: the largest error over all mantissas stays below what lanes/math.h promises,
// values join where one piece of the computation gives way to the next, and the bits are the same in every build.
// RELIEF_SHORT_TESTS (slow builds) looks at every seventeenth number only.
#include "relief/lanes/math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "lane_check.h"

using namespace relief;
using namespace lane_check;

namespace {

#if defined(RELIEF_SHORT_TESTS)
constexpr std::uint32_t kStride = 17;  // odd, so that all low bits occur
#else
constexpr std::uint32_t kStride = 1;
#endif

// Calls each(x, function(x)) for all inputs x, in order; the function is computed in lanes.
template <class Inputs, class Function, class Each>
void evaluate(const Inputs& input, Function function, Each each)
{
    float x[kLanes];
    float y[kLanes];
    for (std::uint32_t begin = 0; begin < input.count; begin += kLanes) {
        const std::uint32_t n = std::min<std::uint32_t>(kLanes, input.count - begin);
        for (std::uint32_t i = 0; i < kLanes; ++i) x[i] = input(begin + std::min(i, n - 1));
        function(Float::load(x)).store(y);
        for (std::uint32_t i = 0; i < n; ++i) each(x[i], y[i]);
    }
}

// Inputs: the floats of [low, high), which have the same sign; kStride apart.
struct Floats
{
    Floats(float low, float high)
        : first(std::bit_cast<std::uint32_t>(low)),
          step(low < 0.0f ? 0u - kStride : kStride),
          count((low < 0.0f ? first - std::bit_cast<std::uint32_t>(high) : std::bit_cast<std::uint32_t>(high) - first) /
                kStride)
    {
    }
    float operator()(std::uint32_t i) const { return std::bit_cast<float>(first + i * step); }
    std::uint32_t first, step, count;
};

// Inputs: `count` numbers of [low, high), evenly spaced.
struct Range
{
    Range(double l, double high, std::uint32_t n) : low(l), step((high - l) / n), count(n) {}
    float operator()(std::uint32_t i) const { return static_cast<float>(low + step * i); }
    double low, step;
    std::uint32_t count;
};

// Inputs: the numbers of a list.
struct List
{
    explicit List(const std::vector<float>& numbers) : list(numbers), count(static_cast<std::uint32_t>(list.size())) {}
    float operator()(std::uint32_t i) const { return list[i]; }
    const std::vector<float>& list;
    std::uint32_t count;
};

// The largest error seen, and where.
struct UlpError
{
    void add(double error, float x)
    {
        if (!(error > largest) && !std::isnan(error)) return;  // a NaN stays
        largest = error;
        at = x;
    }
    void addRelative(float x, float y, double exact) { add(std::abs(y - exact) / std::abs(exact), x); }
    void addAbsolute(float x, float y, double exact) { add(std::abs(y - exact), x); }
    double largest = 0.0;
    float at = 0.0f;
};

// Counts where a sequence falls, and remembers the deepest fall, in units in the last place.
struct Falls
{
    void add(float value)
    {
        if (!(value >= before)) {
            ++count;
            const std::int64_t fall = std::bit_cast<std::int32_t>(before);
            deepest = std::max(deepest, fall - std::bit_cast<std::int32_t>(value));
        }
        before = value;
    }
    float before = -kInfinity;
    int count = 0;
    std::int64_t deepest = 0;
};

// A hash of words, FNV-1a.
struct Fnv1a
{
    void add(std::uint32_t word)
    {
        for (int shift = 0; shift < 32; shift += 8) value = (value ^ (word >> shift & 0xffu)) * 0x100000001b3u;
    }
    std::uint64_t value = 0xcbf29ce484222325u;
};

const auto kExp2 = [](Float x) { return exp2(x); };
const auto kLog2 = [](Float x) { return log2(x); };
const auto kSin = [](Float x) { return sin(x); };
const auto kCos = [](Float x) { return cos(x); };

// Whether an increasing function does not fall from the float before x to x, nor to the float after it.
template <class Function>
bool risesAcross(Function function, float x)
{
    const float before = function(Float(std::nextafter(x, -kInfinity)))[0];
    const float at = function(Float(x))[0];
    const float after = function(Float(std::nextafter(x, kInfinity)))[0];
    return before <= at && at <= after;
}

// The largest error of x^y for x in [low, high), in units of 1 + |y log2 x|.
UlpError powError(double low, double high, float y)
{
    UlpError error;
    const Range range(low, high, 200000 / kStride);
    evaluate(
        range, [y](Float x) { return pow(x, y); },
        [&](float x, float result) {
            const double exact = std::pow(double{x}, double{y});
            error.add(std::abs(result - exact) / exact / (1.0 + std::abs(y * std::log2(double{x}))), x);
        });
    return error;
}

// The errors of sin and cos from -limit to limit, and next to the multiples of pi/4 in between.
void addSineErrors(double limit, UlpError& ofSin, UlpError& ofCos)
{
    const auto addSin = [&](float x, float y) { ofSin.addAbsolute(x, y, std::sin(double{x})); };
    const auto addCos = [&](float x, float y) { ofCos.addAbsolute(x, y, std::cos(double{x})); };
    const Range range(-limit, limit, 2000000 / kStride);
    evaluate(range, kSin, addSin);
    evaluate(range, kCos, addCos);

    std::vector<float> seams;
    const double step = std::numbers::pi / 4.0 * kStride;  // where the pieces are 0, and where they meet
    for (double x = -std::floor(limit / step) * step; x <= limit; x += step) {
        const auto seam = static_cast<float>(x);
        seams.insert(seams.end(), {seam, std::nextafter(seam, -kInfinity), std::nextafter(seam, kInfinity)});
    }
    evaluate(List{seams}, kSin, addSin);
    evaluate(List{seams}, kCos, addCos);
}

}  // namespace

// --- exp2 ---

TEST_CASE("exp2: the relative error over all fractions is below 1.1e-7")
{
    UlpError error;
    for (const Floats& octave :
         {Floats(0x1p-3f, 0x1p-2f), Floats(0x1p-2f, 0.5f), Floats(0.5f, 1.0f), Floats(1.0f, 2.0f), Floats(-1.0f, -0.5f),
          Floats(-0.5f, -0x1p-2f), Floats(-0x1p-20f, -0x1p-21f)}) {
        evaluate(octave, kExp2, [&](float x, float y) { error.addRelative(x, y, std::exp2(double{x})); });
    }
    CAPTURE(error.at);
    CHECK(error.largest < 1.1e-7);
}

TEST_CASE("exp2: the relative error over the whole range of normal results is below 1.1e-7")
{
    UlpError error;
    const Range range(-126.0, 127.9999, 2000000 / kStride);
    evaluate(range, kExp2, [&](float x, float y) { error.addRelative(x, y, std::exp2(double{x})); });
    CAPTURE(error.at);
    CHECK(error.largest < 1.1e-7);
}

TEST_CASE("exp2: a subnormal result is less than one step away")
{
    UlpError error;
    const Range range(-152.0, -126.0, 1000000 / kStride);
    evaluate(range, kExp2, [&](float x, float y) { error.addAbsolute(x, y, std::exp2(double{x})); });
    CAPTURE(error.at);
    CHECK(error.largest < kSmallest);
}

TEST_CASE("exp2: integers give exact powers of two")
{
    for (int k = -149; k < 128; ++k) CHECK(exp2(static_cast<float>(k)) == std::ldexp(1.0f, k));
}

TEST_CASE("exp2: rises across the seams of its pieces, which are the halves")
{
    for (int k = -252; k < 256; ++k) {
        CAPTURE(k);
        CHECK(risesAcross(kExp2, static_cast<float>(k) * 0.5f));
    }
}

TEST_CASE("exp2: never falls by more than one unit in the last place")
{
    Falls falls;
    for (const Floats& octave : {Floats(-1.0f, -0.5f), Floats(-0.5f, -0x1p-2f), Floats(0x1p-2f, 0.5f),
                                 Floats(0.5f, 1.0f), Floats(1.0f, 2.0f)}) {
        evaluate(octave, kExp2, [&](float, float y) { falls.add(y); });
    }
    CHECK(falls.deepest <= 1);
}

TEST_CASE("exp2: special values")
{
    CHECK(exp2(0.0f) == 1.0f);
    CHECK(exp2(-0.0f) == 1.0f);
    CHECK(exp2(kSmallest) == 1.0f);
    CHECK(exp2(128.0f) == kInfinity);
    CHECK(exp2(kLargest) == kInfinity);
    CHECK(exp2(kInfinity) == kInfinity);
    CHECK(exp2(-150.0f) == 0.0f);
    CHECK(exp2(-kLargest) == 0.0f);
    CHECK(exp2(-kInfinity) == 0.0f);
    CHECK(std::isnan(exp2(kNan)));
}

// --- log2 ---

TEST_CASE("log2: the absolute error over all mantissas of 0.5 to 2 is below 1.2e-7")
{
    UlpError error;
    for (const Floats& octave : {Floats(0.5f, 1.0f), Floats(1.0f, 2.0f)}) {
        evaluate(octave, kLog2, [&](float x, float y) { error.addAbsolute(x, y, std::log2(double{x})); });
    }
    CAPTURE(error.at);
    CHECK(error.largest < 1.2e-7);
}

TEST_CASE("log2: the relative error on 0.5 to 2, next to 1 too, is below 2.3e-7")
{
    UlpError error;
    for (const Floats& octave : {Floats(0.5f, 1.0f), Floats(std::nextafter(1.0f, 2.0f), 2.0f)}) {
        evaluate(octave, kLog2, [&](float x, float y) { error.addRelative(x, y, std::log2(double{x})); });
    }
    CAPTURE(error.at);
    CHECK(error.largest < 2.3e-7);
}

TEST_CASE("log2: the relative error over all mantissas of other octaves is below 1e-7")
{
    UlpError error;
    for (const Floats& octave : {Floats(0x1p-2f, 0.5f), Floats(2.0f, 4.0f), Floats(0x1p-126f, 0x1p-125f),
                                 Floats(0x1p64f, 0x1p65f), Floats(0x1p127f, kInfinity)}) {
        evaluate(octave, kLog2, [&](float x, float y) { error.addRelative(x, y, std::log2(double{x})); });
    }
    CAPTURE(error.at);
    CHECK(error.largest < 1e-7);
}

TEST_CASE("log2: subnormal numbers have a relative error below 1e-7 too")
{
    UlpError error;
    const Floats subnormal(kSmallest, kSmallestNormal);
    evaluate(subnormal, kLog2, [&](float x, float y) { error.addRelative(x, y, std::log2(double{x})); });
    CAPTURE(error.at);
    CHECK(error.largest < 1e-7);
}

TEST_CASE("log2: powers of two give exact integers")
{
    for (int k = -149; k < 128; ++k) CHECK(log2(std::ldexp(1.0f, k)) == static_cast<float>(k));
}

TEST_CASE("log2: never falls, over all mantissas of three octaves")
{
    Falls falls;
    const Floats octaves(0.5f, 4.0f);
    evaluate(octaves, kLog2, [&](float, float y) { falls.add(y); });
    CHECK(falls.count == 0);
}

TEST_CASE("log2: rises across the seams of its pieces, which are the halved odd powers of the root of two")
{
    for (int k = -148; k < 128; ++k) {
        CAPTURE(k);
        CHECK(risesAcross(kLog2, std::ldexp(1.0f, k)));
        CHECK(risesAcross(kLog2, std::ldexp(std::bit_cast<float>(0x3f3504f3), k)));
    }
}

TEST_CASE("log2: special values")
{
    CHECK(log2(0.0f) == -kInfinity);
    CHECK(log2(-0.0f) == -kInfinity);
    CHECK(log2(kInfinity) == kInfinity);
    CHECK(std::isnan(log2(-kSmallest)));
    CHECK(std::isnan(log2(-1.0f)));
    CHECK(std::isnan(log2(-kInfinity)));
    CHECK(std::isnan(log2(kNan)));
}

// --- pow ---

TEST_CASE("pow: the relative error of a number in 0 to 1 is below 2e-7 * (1 + |y log2 x|), for exponents of highlights")
{
    for (const float y : {1.0f, 1.5f, 2.0f, 5.0f, 10.0f, 50.0f, 100.0f, 1000.0f, 10000.0f}) {
        const double low = std::exp2(-125.0 / double{y});  // where the result is still a normal number
        const UlpError error = powError(std::max(low, 1e-30), 1.0, y);
        CAPTURE(y);
        CAPTURE(error.at);
        CHECK(error.largest < 2e-7);
    }
}

TEST_CASE("pow: the relative error of x > 1 and of roots is below 2e-7 * (1 + |y log2 x|)")
{
    for (const float y : {-3.0f, -0.5f, 0.4166667f, 0.5f, 2.2f, 2.4f, 7.0f}) {
        const UlpError error = powError(0.001, 1000.0, y);
        CAPTURE(y);
        CAPTURE(error.at);
        CHECK(error.largest < 2e-7);
    }
}

TEST_CASE("pow: integer powers of powers of two are exact")
{
    CHECK(pow(2.0f, 10.0f) == 1024.0f);
    CHECK(pow(0.5f, 3.0f) == 0.125f);
    CHECK(pow(4.0f, -2.0f) == 0.0625f);
    CHECK(pow(2.0f, 127.0f) == 0x1p127f);
    CHECK(pow(2.0f, -149.0f) == kSmallest);
}

TEST_CASE("pow: whatever it is, to the power of 0 is 1")
{
    for (const float x : {0.0f, -0.0f, 1.0f, -1.0f, 0.3f, kInfinity, -kInfinity, kNan}) {
        CAPTURE(x);
        CHECK(pow(x, 0.0f) == 1.0f);
        CHECK(pow(x, -0.0f) == 1.0f);
    }
}

TEST_CASE("pow: special values")
{
    CHECK(pow(0.0f, 1e4f) == 0.0f);
    CHECK(pow(-0.0f, 2.0f) == 0.0f);
    CHECK(pow(0.0f, -1.0f) == kInfinity);
    CHECK(pow(1.0f, 1e30f) == 1.0f);
    CHECK(pow(kInfinity, 2.0f) == kInfinity);
    CHECK(pow(kInfinity, -2.0f) == 0.0f);
    CHECK(pow(2.0f, kInfinity) == kInfinity);
    CHECK(pow(0.5f, kInfinity) == 0.0f);
    CHECK(pow(0.999f, 1e6f) == 0.0f);
}

TEST_CASE("pow: of negative numbers and of NaN is NaN, as in HLSL")
{
    CHECK(std::isnan(pow(-1.0f, 2.0f)));
    CHECK(std::isnan(pow(-kSmallest, 1.0f)));
    CHECK(std::isnan(pow(kNan, 1.0f)));
    CHECK(std::isnan(pow(1.0f, kNan)));
    CHECK(std::isnan(pow(0.0f, kNan)));
}

// --- sin and cos ---

TEST_CASE("sin and cos: the absolute error on +-100 pi is below 1e-7")
{
    UlpError ofSin;
    UlpError ofCos;
    addSineErrors(100.0 * std::numbers::pi, ofSin, ofCos);
    CAPTURE(ofSin.at);
    CAPTURE(ofCos.at);
    CHECK(ofSin.largest < 1e-7);
    CHECK(ofCos.largest < 1e-7);
}

TEST_CASE("sin and cos: the absolute error on +-8192 is below 1e-7")
{
    UlpError ofSin;
    UlpError ofCos;
    addSineErrors(8192.0, ofSin, ofCos);
    CAPTURE(ofSin.at);
    CAPTURE(ofCos.at);
    CHECK(ofSin.largest < 1e-7);
    CHECK(ofCos.largest < 1e-7);
}

TEST_CASE("sin and cos: the absolute error on +-100000 is below 1e-6")
{
    UlpError ofSin;
    UlpError ofCos;
    addSineErrors(100000.0, ofSin, ofCos);
    CAPTURE(ofSin.at);
    CAPTURE(ofCos.at);
    CHECK(ofSin.largest < 1e-6);
    CHECK(ofCos.largest < 1e-6);
}

TEST_CASE("sin: every float of 0.25 to 2, and cos of the same, is below 1e-7 away")
{
    UlpError ofSin;
    UlpError ofCos;
    const Floats octaves(0.25f, 2.0f);
    evaluate(octaves, kSin, [&](float x, float y) { ofSin.addAbsolute(x, y, std::sin(double{x})); });
    evaluate(octaves, kCos, [&](float x, float y) { ofCos.addAbsolute(x, y, std::cos(double{x})); });
    CHECK(ofSin.largest < 1e-7);
    CHECK(ofCos.largest < 1e-7);
}

TEST_CASE("sin and cos: special values")
{
    CHECK(sin(0.0f) == 0.0f);
    CHECK(cos(0.0f) == 1.0f);
    CHECK(sin(kSmallest) == kSmallest);
    CHECK(sin(-1e-30f) == -1e-30f);
    CHECK(cos(1e-30f) == 1.0f);
    for (const float x : {1000001.0f, -1000001.0f, kLargest, kInfinity, -kInfinity, kNan}) {
        CAPTURE(x);
        CHECK(std::isnan(sin(x)));
        CHECK(std::isnan(cos(x)));
    }
    CHECK_FALSE(std::isnan(sin(1e6f)));
    CHECK_FALSE(std::isnan(cos(-1e6f)));
}

// --- atan2 ---

TEST_CASE("atan2: the relative error of all eight octants, over all mantissas, is below 1.2e-7")
{
    for (const float longer : {1.0f, -1.0f}) {
        for (const float sign : {1.0f, -1.0f}) {
            UlpError error;
            for (const Floats& octave : {Floats(0x1p-20f, 0x1.1p-20f), Floats(0x1p-3f, 0x1p-2f), Floats(0x1p-2f, 0.5f),
                                         Floats(0.5f, std::nextafter(1.0f, 2.0f))}) {
                evaluate(
                    octave, [&](Float r) { return atan2(r * sign, longer); },
                    [&](float r, float angle) { error.addRelative(r, angle, std::atan2(double{r * sign}, longer)); });
                evaluate(
                    octave, [&](Float r) { return atan2(longer, r * sign); },
                    [&](float r, float angle) { error.addRelative(r, angle, std::atan2(longer, double{r * sign})); });
            }
            CAPTURE(longer);
            CAPTURE(sign);
            CAPTURE(error.at);
            CHECK(error.largest < 1.2e-7);
        }
    }
}

TEST_CASE("atan2: the absolute error all around the circle is below 2.1e-7, for lengths of every size")
{
    for (const float length : {1.0f, 0.3f, 1e-30f, 1e-37f, 1e30f, 3e38f}) {
        UlpError error;
        const std::uint32_t count = 200000 / kStride;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / count;
            const auto x = static_cast<float>(length * std::cos(turn));
            const auto y = static_cast<float>(length * std::sin(turn));
            error.addAbsolute(static_cast<float>(turn), atan2(y, x), std::atan2(double{y}, double{x}));
        }
        CAPTURE(length);
        CAPTURE(error.at);
        CHECK(error.largest < 2.1e-7);
    }
}

TEST_CASE("atan2: axes and diagonals give the nearest floats, for lengths of every size and for infinities")
{
    constexpr auto pi = static_cast<float>(std::numbers::pi);
    constexpr auto kHalfPi = static_cast<float>(std::numbers::pi / 2.0);
    constexpr auto kQuarterPi = static_cast<float>(std::numbers::pi / 4.0);
    constexpr auto kThreeQuarterPi = static_cast<float>(std::numbers::pi * 0.75);
    for (const float a : {kSmallest, 1e-40f, 1e-20f, 1.0f, 3.0f, kLargest, kInfinity}) {
        CAPTURE(a);
        for (const float zero : {0.0f, -0.0f}) {
            CHECK(atan2(a, zero) == kHalfPi);
            CHECK(atan2(-a, zero) == -kHalfPi);
            CHECK(same(atan2(zero, a), zero));
            CHECK(atan2(zero, -a) == std::copysign(pi, zero));
        }
        CHECK(atan2(a, a) == kQuarterPi);
        CHECK(atan2(-a, a) == -kQuarterPi);
        CHECK(atan2(a, -a) == kThreeQuarterPi);
        CHECK(atan2(-a, -a) == -kThreeQuarterPi);
    }
    CHECK(same(atan2(0.0f, 0.0f), 0.0f));
    CHECK(same(atan2(-0.0f, 0.0f), -0.0f));
    CHECK(atan2(0.0f, -0.0f) == pi);
    CHECK(atan2(-0.0f, -0.0f) == -pi);
    CHECK(atan2(kInfinity, 1.0f) == kHalfPi);
    CHECK(atan2(1.0f, kInfinity) == 0.0f);
    CHECK(atan2(-1.0f, -kInfinity) == -pi);
}

TEST_CASE("atan2: of NaN is NaN")
{
    for (const float a : {0.0f, 1.0f, -1.0f, kInfinity, kNan}) {
        CHECK(std::isnan(atan2(kNan, a)));
        CHECK(std::isnan(atan2(a, kNan)));
    }
}

TEST_CASE("atan2: rises by at most one unit in the last place too little, all around the circle")
{
    Falls falls;
    for (const float x : {1.0f, -1.0f}) {
        falls = {};
        evaluate(
            Range(0.25, 4.0, 2000000 / kStride), [x](Float y) { return atan2(y, x); },
            [&](float, float angle) { falls.add(x * angle); });
        CHECK(falls.deepest <= 1);
    }
}

// --- what is made of these ---

namespace {

// The largest relative error over numbers of [low, high), evenly spaced, and over all kinds of numbers within. Results
// below the normal numbers and beyond the range are left out.
template <class Function, class Exact>
double relativeError(double low, double high, Function function, Exact exact)
{
    UlpError error;
    const auto add = [&](float x, float y) {
        const double e = exact(double{x});
        if (std::abs(e) >= 1.17549435e-38 && std::abs(e) < 3.4e38) error.addRelative(x, y, e);
    };
    evaluate(Range(low, high, 1000000 / kStride), function, add);
    std::vector<float> within;
    for (const float x : manyFloats()) {
        if (x >= low && x < high) within.push_back(x);
    }
    evaluate(List{within}, function, add);
    CAPTURE(error.at);
    return error.largest;
}

}  // namespace

TEST_CASE("exp: relative error below 1.2e-7")
{
    const auto function = [](Float x) { return exp(x); };
    const auto exact = [](double x) { return std::exp(x); };
    CHECK(relativeError(-87.3, 88.7, function, exact) < 1.2e-7);
    CHECK(relativeError(-1.0, 1.0, function, exact) < 1.2e-7);
    CHECK(same(exp(Float(0.0f))[0], 1.0f));
    CHECK(same(exp(Float(-kInfinity))[0], 0.0f));
    CHECK(same(exp(Float(-200.0f))[0], 0.0f));
    CHECK(same(exp(Float(kInfinity))[0], kInfinity));
    CHECK(same(exp(Float(89.0f))[0], kInfinity));
    CHECK(std::abs(double{exp(Float(-100.0f))[0]} - std::exp(-100.0)) < 0x1p-149);  // subnormal
}

TEST_CASE("log and log10: relative errors below 2.7e-7 and 3.1e-7")
{
    const auto natural = [](Float x) { return log(x); };
    const auto decimal = [](Float x) { return log10(x); };
    for (const double high : {2.0, 1e30}) {
        CHECK(relativeError(high * 1e-30, high, natural, [](double x) { return std::log(x); }) < 2.7e-7);
        CHECK(relativeError(high * 1e-30, high, decimal, [](double x) { return std::log10(x); }) < 3.1e-7);
    }
    CHECK(same(log(Float(1.0f))[0], 0.0f));
    CHECK(same(log(Float(0.0f))[0], -kInfinity));
    CHECK(same(log10(Float(kInfinity))[0], kInfinity));
}

TEST_CASE("sinh, cosh and tanh: relative errors below 2e-7, 1.6e-7 and 2e-7, odd, even, odd")
{
    const auto ofSinh = [](Float x) { return sinh(x); };
    const auto ofCosh = [](Float x) { return cosh(x); };
    const auto ofTanh = [](Float x) { return tanh(x); };
    for (const double end : {1.5, 88.0}) {
        CHECK(relativeError(-end, end, ofSinh, [](double x) { return std::sinh(x); }) < 2e-7);
        CHECK(relativeError(-end, end, ofCosh, [](double x) { return std::cosh(x); }) < 1.6e-7);
        CHECK(relativeError(-end, end, ofTanh, [](double x) { return std::tanh(x); }) < 2e-7);
    }
    CHECK(same(sinh(Float(-0.0f))[0], -0.0f));
    CHECK(same(tanh(Float(-0.0f))[0], -0.0f));
    CHECK(same(tanh(Float(-kInfinity))[0], -1.0f));
    CHECK(same(sinh(Float(-kInfinity))[0], -kInfinity));
    CHECK(same(cosh(Float(-kInfinity))[0], kInfinity));
    for (const float x : {88.72f, -88.72f}) CHECK(all(isfinite(cosh(Float(x))) & isfinite(sinh(Float(x)))));
    for (const float x : {88.73f, -88.73f}) CHECK(all(isinf(cosh(Float(x))) & isinf(sinh(Float(x)))));
}

TEST_CASE("tan: error below 2e-7 (1 + tan^2)")
{
    UlpError error;
    for (const double end : {1.0, 20.0, 8192.0}) {
        evaluate(
            Range(-end, end, 1000000 / kStride), [](Float x) { return tan(x); },
            [&](float x, float y) {
                const double exact = std::tan(double{x});
                error.add(std::abs(y - exact) / (1.0 + exact * exact), x);
            });
    }
    CAPTURE(error.at);
    CHECK(error.largest < 2e-7);
}

TEST_CASE("asin, acos and atan: relative errors below 1.9e-7, 2.2e-7 and 1.3e-7")
{
    const auto ofAsin = [](Float x) { return asin(x); };
    const auto ofAcos = [](Float x) { return acos(x); };
    const auto ofAtan = [](Float x) { return atan(x); };
    for (const double low : {-1.0, 0.9, 0.9999}) {
        CHECK(relativeError(low, 1.0, ofAsin, [](double x) { return std::asin(x); }) < 1.9e-7);
        CHECK(relativeError(low, 1.0, ofAcos, [](double x) { return std::acos(x); }) < 2.2e-7);
    }
    for (const double end : {2.0, 1e20})
        CHECK(relativeError(-end, end, ofAtan, [](double x) { return std::atan(x); }) < 1.3e-7);
    constexpr auto pi = static_cast<float>(std::numbers::pi);
    constexpr auto kHalfPi = static_cast<float>(std::numbers::pi / 2.0);
    CHECK(acos(Float(1.0f))[0] == 0.0f);
    CHECK(acos(Float(-1.0f))[0] == pi);
    CHECK(asin(Float(-1.0f))[0] == -kHalfPi);
    CHECK(same(asin(Float(-0.0f))[0], -0.0f));
    CHECK(atan(Float(kInfinity))[0] == kHalfPi);
    CHECK(same(atan(Float(-0.0f))[0], -0.0f));
}

TEST_CASE("every NaN that a function makes is the same one, whatever came in and however it was compiled")
{
    volatile float hidden = -1.0f;  // the compiler must not work it out
    const float below = hidden, otherNan = std::bit_cast<float>(0xffc12345u);
    volatile float alsoHidden = otherNan;
    const auto isTheOne = [](Float x) { return all(asInt(x) == Int(0x7fc00000)); };
    for (const float x : {below, float{alsoHidden}}) {
        CHECK(isTheOne(log2(Float(x))));
        CHECK(isTheOne(log(Float(x))));
        CHECK(isTheOne(log10(Float(x))));
        CHECK(isTheOne(pow(Float(x), Float(0.5f))));
        CHECK(isTheOne(asin(Float(x) * 2.0f)));
        CHECK(isTheOne(acos(Float(x) * 2.0f)));
    }
    CHECK(isTheOne(log2(Float(-1.0f))));  // the compiler does
    CHECK(isTheOne(pow(Float(-1.0f), Float(0.5f))));
    const Float nan = float{alsoHidden};
    CHECK(isTheOne(exp2(nan)));
    CHECK(isTheOne(exp(nan)));
    CHECK(isTheOne(pow(nan, Float(2.0f))));
    CHECK(isTheOne(pow(Float(2.0f), nan)));
    CHECK(isTheOne(sin(nan)));
    CHECK(isTheOne(cos(Float(2e6f))));
    CHECK(isTheOne(tan(nan)));
    CHECK(isTheOne(atan2(nan, Float(1.0f))));
    CHECK(isTheOne(atan2(Float(-1.0f), nan)));
    CHECK(isTheOne(atan(nan)));
    CHECK(isTheOne(sinh(nan)));
    CHECK(isTheOne(cosh(nan)));
    CHECK(isTheOne(tanh(nan)));
    CHECK(all(asint(nan) == Int(0x7fc00000)));
}

// --- the same bits everywhere ---

TEST_CASE("the functions of one number give the bits of the lanes")
{
    CHECK(difference(kFloats, kExp2, [](float x) { return exp2(x); }) == "");
    CHECK(difference(kFloats, kLog2, [](float x) { return log2(x); }) == "");
    CHECK(difference(kFloats, kSin, [](float x) { return sin(x); }) == "");
    CHECK(difference(kFloats, kCos, [](float x) { return cos(x); }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto x, auto y) { return pow(x, y); }) == "");
    CHECK(differenceOfPairs(kFloats, [](auto x, auto y) { return atan2(x, y); }) == "");
}

TEST_CASE("the results have the bits that they have in every other build")
{
    // Fixed inputs: numbers of all kinds, and those that shaders use. A NaN is hashed as one and the same.
    std::vector<float> inputs = manyFloats();
    for (int i = -20000; i < 20000; ++i) inputs.push_back(static_cast<float>(i) * 0x1p-9f);
    Fnv1a hash;
    const auto add = [&](float, float y) { hash.add(std::isnan(y) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(y)); };
    evaluate(List{inputs}, kExp2, add);
    evaluate(List{inputs}, kLog2, add);
    evaluate(List{inputs}, kSin, add);
    evaluate(List{inputs}, kCos, add);
    for (const float y : {-1.0f, 0.3f, 2.0f, 37.0f, 1000.0f}) {
        evaluate(
            List{inputs}, [y](Float x) { return pow(x, y); }, add);
    }
    CHECK(hash.value == 0x22b2c074169dc609u);
}

TEST_CASE("atan2 has the bits that it has in every other build")
{
    const std::vector<float> inputs = manyFloats();
    Fnv1a hash;
    for (const float x : {1.0f, -1.0f, 0.0f, -0.0f, 0.3f, -1e20f, 1e-40f, kInfinity}) {
        evaluate(
            List{inputs}, [x](Float y) { return atan2(y, x); },
            [&](float, float y) { hash.add(std::isnan(y) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(y)); });
    }
    CHECK(hash.value == 0x3c48e9b222a2615au);
}

TEST_CASE("exp, log, tan and their like have the bits that they have in every other build")
{
    const std::vector<float> inputs = manyFloats();
    Fnv1a hash;
    const auto add = [&](float, float y) { hash.add(std::bit_cast<std::uint32_t>(y)); };
    evaluate(
        List{inputs}, [](Float x) { return exp(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return log(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return log10(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return tan(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return asin(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return acos(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return atan(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return sinh(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return cosh(x); }, add);
    evaluate(
        List{inputs}, [](Float x) { return tanh(x); }, add);
    CHECK(hash.value == 0x3b4f776150ebd92bu);
}
