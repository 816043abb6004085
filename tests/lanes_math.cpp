// exp2, log2, pow, sin and cos: the largest error over all mantissas stays below what lanes/math.h promises, values join
// where one piece of the computation gives way to the next, and the bits are the same in every build. RELIEF_SHORT_TESTS
// (slow builds) looks at every sixteenth number only.
#include "lanes/math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

#include "lane_check.h"

using namespace relief;
using namespace lane_check;

namespace {

#if defined(RELIEF_SHORT_TESTS)
constexpr std::uint32_t kStride = 16;
#else
constexpr std::uint32_t kStride = 1;
#endif

// What the engine must not exceed, whatever lanes/math.h promises: Direct3D 11.3, 22.10.
constexpr double kDirect3D = 0x1p-21;
constexpr double kDirect3DSine = 8e-4;

// Calls each(x, function(x)) for the inputs x = input(0), input(1), ..., input(count - 1), computed in lanes.
template <class Input, class Function, class Each>
void evaluate(std::uint32_t count, Input input, Function function, Each each)
{
    float x[kLanes];
    float y[kLanes];
    for (std::uint32_t begin = 0; begin < count; begin += kLanes) {
        const std::uint32_t n = std::min<std::uint32_t>(kLanes, count - begin);
        for (std::uint32_t i = 0; i < kLanes; ++i) x[i] = input(begin + std::min(i, n - 1));
        function(Float::load(x)).store(y);
        for (std::uint32_t i = 0; i < n; ++i) each(x[i], y[i]);
    }
}

// The floats of [low, high), which have the same sign; kStride apart.
struct Floats
{
    Floats(float low, float high) : first(std::bit_cast<std::uint32_t>(low))
    {
        const std::uint32_t last = std::bit_cast<std::uint32_t>(high);
        step = last > first ? kStride : 0u - kStride;
        count = (last > first ? last - first : first - last) / kStride;
    }
    float operator()(std::uint32_t i) const { return std::bit_cast<float>(first + i * step); }
    std::uint32_t first, step, count;
};

// `count` numbers from low to high, evenly spaced.
struct Range
{
    Range(double l, double h, std::uint32_t n) : low(l), step((h - l) / n), count(n) {}
    float operator()(std::uint32_t i) const { return static_cast<float>(low + step * i); }
    double low, step;
    std::uint32_t count;
};

struct Error
{
    void add(double measured, float where)
    {
        if (measured > largest || std::isnan(measured)) {
            largest = std::isnan(measured) ? std::numeric_limits<double>::infinity() : measured;
            at = where;
        }
    }
    void addRelative(float x, float y, double exact) { add(std::abs(y - exact) / std::abs(exact), x); }
    void addAbsolute(float x, float y, double exact) { add(std::abs(y - exact), x); }
    double largest = 0.0;
    float at = 0.0f;
};

const auto kExp2 = [](Float x) { return exp2(x); };
const auto kLog2 = [](Float x) { return log2(x); };
const auto kSin = [](Float x) { return sin(x); };
const auto kCos = [](Float x) { return cos(x); };

// Whether an increasing function increases (or stays) over the floats around x.
template <class Function>
bool increasesAround(Function function, float x)
{
    float before = -kInfinity;
    float at = x;
    for (int i = 0; i < 64; ++i) at = std::nextafter(at, -kInfinity);
    for (int i = 0; i < 128; ++i) {
        const float value = function(Float(at))[0];
        if (!(value >= before)) return false;
        before = value;
        at = std::nextafter(at, kInfinity);
    }
    return true;
}

}  // namespace

// --- exp2 ---

TEST_CASE("exp2: every fraction, relative error")
{
    Error error;
    const auto compare = [&](float x, float y) { error.addRelative(x, y, std::exp2(double{x})); };
    for (const Floats& octave : {Floats(0.125f, 0.25f), Floats(0.25f, 0.5f), Floats(0.5f, 1.0f), Floats(1.0f, 2.0f),
                                 Floats(-0.25f, -0.5f), Floats(-0.5f, -1.0f)}) {
        evaluate(octave.count, octave, kExp2, compare);
    }
    MESSAGE("exp2 ", error.largest, " at ", error.at);
    CHECK(error.largest < kDirect3D);
}

TEST_CASE("exp2: every integer part that gives a normal number, relative error")
{
    Error error;
    for (int k = -126; k < 128; ++k) {
        const Range range(k, k + 1, 8192 / kStride);
        evaluate(range.count, range, kExp2, [&](float x, float y) {
            if (x < 128.0f) error.addRelative(x, y, std::exp2(double{x}));
        });
    }
    MESSAGE("exp2 ", error.largest, " at ", error.at);
    CHECK(error.largest < kDirect3D);
}

TEST_CASE("exp2: subnormal results, in units of the last place")
{
    Error error;
    const Range range(-152.0, -126.0, 1048576 / kStride);
    evaluate(range.count, range, kExp2,
             [&](float x, float y) { error.add(std::abs(y - std::exp2(double{x})) * 0x1p149, x); });
    MESSAGE("exp2 ulp ", error.largest, " at ", error.at);
}

TEST_CASE("exp2 monotonic")
{
    long bad = 0;
    for (const Floats& octave : {Floats(0.125f, 0.25f), Floats(0.25f, 0.5f), Floats(0.5f, 1.0f), Floats(1.0f, 2.0f)}) {
        float before = 0;
        evaluate(octave.count, octave, kExp2, [&](float, float y) { bad += y < before; before = y; });
    }
    MESSAGE("nonmono exp2 ", bad);
    long badL = 0;
    for (const Floats& octave : {Floats(0.5f, 1.0f), Floats(1.0f, 2.0f), Floats(2.0f, 4.0f)}) {
        float before = -kInfinity;
        evaluate(octave.count, octave, kLog2, [&](float, float y) { badL += y < before; before = y; });
    }
    MESSAGE("nonmono log2 ", badL);
    int bs = 0, bl = 0;
    for (int k = -250; k < 250; ++k) { bs += !increasesAround(kExp2, k * 0.5f); }
    for (int k = -126; k < 127; ++k) { bl += !increasesAround(kLog2, std::ldexp(1.0f, k)) ; bl += !increasesAround(kLog2, std::ldexp(0.70710677f, k)); }
    MESSAGE("seams ", bs, " ", bl);
}
TEST_CASE("log2")
{
    for (const Floats& octave : {Floats(0.5f, 0.70710677f), Floats(0.70710677f, 1.0f), Floats(std::nextafter(1.0f,2.0f), 1.41421354f), Floats(1.41421354f, 2.0f), Floats(2.0f, 4.0f), Floats(0.25f, 0.5f), Floats(0x1p60f,0x1p61f), Floats(0x1p-126f,0x1p-125f), Floats(0x1p127f, kLargest), Floats(1e-43f, 0x1p-126f)}) {
        Error a, r;
        evaluate(octave.count, octave, kLog2, [&](float x, float y) { const double e = std::log2(double{x}); a.addAbsolute(x, y, e); r.addRelative(x, y, e); });
        MESSAGE("log2 from ", octave(0), " abs ", a.largest, " rel ", r.largest, " at ", r.at);
    }
}
TEST_CASE("pow")
{
    for (double n : {1.0, 2.0, 3.3, 10.0, 50.0, 100.0, 1000.0, 1e4}) {
        Error r, s;
        const double low = std::max(0x1p-20, std::exp2(-125.0 / n));
        const Range range(low, 1.0 - 0x1p-24, 1000000/kStride);
        evaluate(range.count, range, [&](Float x) { return pow(x, Float(n)); }, [&](float x, float y) { const double e = std::pow(double{x}, double(float(n))); r.addRelative(x, y, e);
            const double ex = std::abs(double(float(n)) * std::log2(double{x})); if (ex > 1) s.add(std::abs(y - e)/e / ex, x); });
        MESSAGE("pow ", n, " rel ", r.largest, " at ", r.at, "; per |y log2 x| ", s.largest, " at ", s.at);
    }
}
TEST_CASE("sincos")
{
    for (double limit : {1.0, 4.0, 100 * std::numbers::pi, 1024.0, 4096.0, 8192.0, 1e5, 1e6}) {
        Error s, c;
        const Range range(-limit, limit, 2000000/kStride);
        evaluate(range.count, range, kSin, [&](float x, float y) { s.addAbsolute(x, y, std::sin(double{x})); });
        evaluate(range.count, range, kCos, [&](float x, float y) { c.addAbsolute(x, y, std::cos(double{x})); });
        MESSAGE("sincos ", limit, " ", s.largest, " at ", s.at, " ", c.largest, " at ", c.at);
    }
}
