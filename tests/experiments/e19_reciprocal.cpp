// E-19: 1/x and 1/sqrt(x), divided out and from the processor's estimates. The estimates live here only: the engine
// does not use them, because their last bits differ between processors.
#include <bit>
#include <limits>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace relief::experiments {

namespace {

[[maybe_unused]] constexpr double kEstimateLimit = 1.5 / 4096.0, kFinerLimit = 1.0 / 16384.0,
                                  kShaderLimit = 1.0 / 2097152.0;

#if defined(__SSE2__)
// rcpps and rsqrtps: 12 bits; of at most 8 lanes at a time.
#if RELIEF_LANES == 16
template <class Half>
Float byHalves(Float x, Half half)
{
    const __m512 all = (__m512)x.value;
    const __m256 low = half(_mm512_castps512_ps256(all)), high = half(_mm512_extractf32x8_ps(all, 1));
    return Float((native::FloatVector)_mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1));
}
constexpr auto estimateRcp = [](Float x) { return byHalves(x, [](__m256 half) { return _mm256_rcp_ps(half); }); };
constexpr auto estimateRsqrt = [](Float x) { return byHalves(x, [](__m256 half) { return _mm256_rsqrt_ps(half); }); };
#elif RELIEF_LANES == 8
constexpr auto estimateRcp = [](Float x) { return Float((native::FloatVector)_mm256_rcp_ps((__m256)x.value)); };
constexpr auto estimateRsqrt = [](Float x) { return Float((native::FloatVector)_mm256_rsqrt_ps((__m256)x.value)); };
#else
constexpr auto estimateRcp = [](Float x) { return Float((native::FloatVector)_mm_rcp_ps((__m128)x.value)); };
constexpr auto estimateRsqrt = [](Float x) { return Float((native::FloatVector)_mm_rsqrt_ps((__m128)x.value)); };
#endif
#if RELIEF_LANES == 16  // 14 bits, of all lanes
constexpr auto finerRcp = [](Float x) { return Float((native::FloatVector)_mm512_rcp14_ps((__m512)x.value)); };
constexpr auto finerRsqrt = [](Float x) { return Float((native::FloatVector)_mm512_rsqrt14_ps((__m512)x.value)); };
// The step with multiplications and additions in one rounding.
constexpr auto fusedRcp = [](Float x) {
    const __m512 v = (__m512)x.value, y = _mm512_rcp14_ps(v);
    return Float((native::FloatVector)_mm512_fmadd_ps(y, _mm512_fnmadd_ps(v, y, _mm512_set1_ps(1.0f)), y));
};
#endif

// One step of Newton's method doubles the number of right bits.
template <class Estimate>
auto newtonRcp(Estimate estimate)
{
    return [estimate](Float x) {
        const Float y = estimate(x);
        return y * (2.0f - x * y);
    };
}
template <class Estimate>
auto newtonRsqrt(Estimate estimate)
{
    return [estimate](Float x) {
        const Float y = estimate(x);
        return y * (1.5f - 0.5f * x * y * y);
    };
}
#endif

// Over every float in 1 ... 2, or 1 ... 4 for the root, where mantissas repeat after two exponents; or every so many.
template <class Function>
Error errorOf(Function f, bool root, int stride)
{
    constexpr std::uint32_t first = 0x3f800000u, chunk = 1u << 16;  // 1.0f
    const std::uint32_t count = (root ? 1u << 24 : 1u << 23) / static_cast<std::uint32_t>(stride);
    ErrorSum sum;
    Columns in(1, std::vector<float>(chunk));
    for (std::uint32_t begin = 0; begin < count; begin += chunk) {
        for (std::uint32_t i = 0; i < chunk; ++i) {
            const std::uint32_t n = std::min(begin + i, count - 1) * static_cast<std::uint32_t>(stride);
            in[0][i] = std::bit_cast<float>(first + n);
        }
        const Columns out = evaluate<1>(in, f);
        for (std::uint32_t i = 0; i < std::min(chunk, count - begin); ++i) {
            const double x = in[0][i], exact = root ? 1.0 / std::sqrt(x) : 1.0 / x;
            sum.add(out[0][i] / exact - 1.0);
        }
    }
    return sum.result();
}

// Of 0, -0 and infinity, of which 1/x and 1/sqrt(x) are no NaN, how many become one. (Subnormal numbers differ between
// processors: rcpps + Newton of 5e-39 is NaN on Intel's, and 2e38, right, on the AMD one at hand.)
template <class Function>
double nansAtEnds(Function f)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const float ends[] = {0.0f, -0.0f, infinity};
    double nans = 0.0;
    for (const float x : ends) nans += std::isnan(evaluate<1>(Columns(1, std::vector<float>(16, x)), f)[0][0]);
    return nans;
}

struct Kind
{
    Experiment& e;
    Effort effort;
    std::shared_ptr<const Columns> in;
    const char* function;
    bool root;

    template <class Function>
    void add(const std::string& name, Function f, double limit)
    {
        const int stride = effort.samples(1, 64);
        const bool isRoot = root;
        Variant v = laneVariant<1>(function, name, in, f, [=] {
            const Error error = errorOf(f, isRoot, stride);
            const double highlight = 100.0 * (std::pow(1.0 + error.max, 1000.0) - 1.0);
            return Outcome(error, {{"NaN at 0, -0, inf", nansAtEnds(f)}, {"x^1000 off by %", highlight}});
        });
        v.isCounted = name.find("14") == std::string::npos;  // the counted program has no AVX-512
        e.variants.push_back(v);
        Check check = {std::string(function) + ", " + name, limit, [=] { return errorOf(f, isRoot, stride).max; }, 0.0};
        check.isBound = true;
        e.checks.push_back(check);
    }
};

}  // namespace

Experiment reciprocal(Effort effort)
{
    Experiment e;
    e.id = "E-19";
    e.title = "1/x and 1/sqrt(x)";
    e.question =
        "Processors offer estimates of 1/x and 1/sqrt(x) that are good to 12 or 14 bits, and one step of Newton's "
        "method doubles that. How wrong are they, over every mantissa, and are they still faster than the exact "
        "division and root, which give the same bits everywhere?";
    e.item = "value";
    e.unit = "relative error";
    e.rivals = Rivals::ofOneName;
    const auto in = randomColumns({{0.5, 4.0}});
    Kind rcpKind = {e, effort, in, "1/x", false}, rsqrtKind = {e, effort, in, "1/sqrt", true};
    rcpKind.add(
        "exact", [](Float x) { return rcp(x); }, 0x1p-24);
    rsqrtKind.add(
        "exact", [](Float x) { return rsqrt(x); }, 1.5 * 0x1p-24);
#if defined(__SSE2__)
    rcpKind.add("rcpps", estimateRcp, kEstimateLimit);
    rcpKind.add("rcpps + Newton", newtonRcp(estimateRcp), kShaderLimit);
    rsqrtKind.add("rsqrtps", estimateRsqrt, kEstimateLimit);
    rsqrtKind.add("rsqrtps + Newton", newtonRsqrt(estimateRsqrt), kShaderLimit);
    e.checks.push_back(
        {"NaN of rcpps + Newton at 0, -0, inf", 3.0, [] { return nansAtEnds(newtonRcp(estimateRcp)); }, 0.0});
    e.checks.push_back(
        {"NaN of rsqrtps + Newton at 0, -0, inf", 3.0, [] { return nansAtEnds(newtonRsqrt(estimateRsqrt)); }, 0.0});
#if RELIEF_LANES == 16
    rcpKind.add("rcp14", finerRcp, kFinerLimit);
    rcpKind.add("rcp14 + Newton", newtonRcp(finerRcp), kShaderLimit);
    rcpKind.add("rcp14 + fused Newton", fusedRcp, kShaderLimit);
    rsqrtKind.add("rsqrt14", finerRsqrt, kFinerLimit);
    rsqrtKind.add("rsqrt14 + Newton", newtonRsqrt(finerRsqrt), kShaderLimit);
#endif
#endif
    const auto checkAll = [&e](const std::string& what, double expected, auto f, bool root) {
        e.checks.push_back({what + ", the largest of all mantissas", expected, [=] { return errorOf(f, root, 1).max; },
                            1e-4 * expected});
    };
    if (effort.full) {  // the exact ones are IEEE 754's, the finer estimates Intel's to the bit
        checkAll(
            "1/x", 5.96046e-8, [](Float x) { return rcp(x); }, false);
        checkAll(
            "1/sqrt", 8.94070e-8, [](Float x) { return rsqrt(x); }, true);
#if RELIEF_LANES == 16
        checkAll("rcp14", 5.43866e-5, finerRcp, false);
        checkAll("rcp14 + fused Newton", 6.09958e-8, fusedRcp, false);
        checkAll("rsqrt14", 5.99974e-5, finerRsqrt, true);
#endif
    }
    // A cosine that is too large by rsqrtps's error on an Intel processor, in a highlight.
    struct Highlight
    {
        double exponent, factor;
    };
    constexpr Highlight kHighlights[] = {{10, 1.00326607}, {100, 1.0331449}, {1000, 1.385519}, {1e4, 26.069}};
    for (const Highlight& h : kHighlights) {
        const auto highlight = [h] {
            const auto power = [h](Float x) { return pow(x, Float(h.exponent)); };
            return static_cast<double>(evaluate<1>(Columns(1, std::vector<float>(16, 1.000326128f)), power)[0][0]);
        };
        e.checks.push_back({"(1 + 3.26128e-4)^" + number(h.exponent, 0), h.factor, highlight, 1e-3 * h.factor});
    }
    e.finding = [](const Rows& rows) {
        std::string text = "Exact, 1/x takes " + number(rows("1/x", "exact").fastest, 3) + " ns and 1/sqrt " +
                           number(rows("1/sqrt", "exact").fastest, 3) + ".";
#if defined(__SSE2__)
        const Row &root = rows("1/sqrt", "exact"), &estimate = rows("1/sqrt", "rsqrtps"),
                  &newton = rows("1/sqrt", "rsqrtps + Newton");
        const auto compared = [](const Row& a, const Row& b) {
            return a.fastest < 0.97 * b.fastest ? "faster than" : "no faster than";
        };
        const auto inMillionths = [](const Row& row) { return number(row.outcome.error.max * 1e6, 1); };
        text +=
            " rsqrtps alone is " + std::string(compared(estimate, root)) + " that (" + number(estimate.fastest, 3) +
            " ns), but makes a highlight of exponent 1000 wrong by up to " +
            number(estimate.fact("x^1000 off by %"), 1) + " %. With a Newton step (" + number(newton.fastest, 3) +
            " ns, " + number(newton.fact("x^1000 off by %"), 3) + " %) it is " + compared(newton, root) +
            " the exact root, and turns 0 and infinity into NaN. From data beyond the first-level cache the three "
            "take " +
            number(root.streaming.value_or(NAN), 3) + ", " + number(estimate.streaming.value_or(NAN), 3) + " and " +
            number(newton.streaming.value_or(NAN), 3) +
            " ns. The estimates' last bits differ between processors: the largest errors of rcpps and rsqrtps are " +
            inMillionths(rows("1/x", "rcpps")) + " and " + inMillionths(estimate) +
            " millionths here, 300.2 and 326.1 on an Intel Xeon. Nothing that has to be the same everywhere may use "
            "them.";
#endif
        return text;
    };
    return e;
}

}  // namespace relief::experiments
