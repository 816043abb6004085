// E-20: exp2, log2 and pow by polynomials of several degrees.
#include <bit>
#include <cstdio>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/lanes/math.h"

namespace relief::experiments {

namespace {

constexpr int kDegrees = 7;
using Coefficients = double[kDegrees + 1];

// The polynomials of degree 2 to 7 with the smallest largest error: of 2^x on 0 ... 1, relative; of log2(1 + x) on
// 0 ... 1, absolute. Found by Remez's exchange in 30 digits.
constexpr Coefficients kExp2[] = {
    {1.00172476321475, 0.657636275736078, 0.337189434619687},
    {0.99992521856271, 0.695833540494824, 0.226067155427249, 0.0780245226406373},
    {1.00000259337069, 0.693003834469975, 0.241442756891508, 0.052011460610307, 0.013534167916127},
    {0.999999925063526, 0.693153073200169, 0.240153617044375, 0.0558263180532957, 0.00898934009049467,
     0.00187757667519148},
    {1.0000000018558, 0.693146983840619, 0.240229836273961, 0.0554833419845672, 0.00967884099612836,
     0.00124396878272184, 0.000217022554601337},
    {0.999999999959789, 0.693147186083888, 0.240226384618011, 0.0555051268595021, 0.00961401701198981,
     0.00134226348230188, 0.000143523140402616, 2.14987636931779e-5},
};
constexpr Coefficients kLog2[] = {
    {0.00493975997629427, 1.33496891304743, -0.344848433000019},
    {0.000637117292105098, 1.41888021128418, -0.577128913892548, 0.158248702608365},
    {8.75919241953424e-5, 1.43770438639434, -0.674942891339839, 0.318679129595231, -0.0816158084981224},
    {1.25387449490089e-5, 1.44168455702716, -0.707992651176247, 0.413630119501642, -0.192195635546691,
     0.0448736101941317},
    {1.84568668708188e-6, 1.44249531593952, -0.7177910762074, 0.45652166011866, -0.276540739861798, 0.12100223745349,
     -0.0256910888158464},
    {2.77289502407883e-7, 1.4426562643123, -0.720453033954975, 0.472897923478781, -0.324253922262242, 0.192089537404403,
     -0.078062128146272, 0.0151253591680084},
};

template <int degree, class T>
T polynomial(const Coefficients& c, T x)
{
    T p = c[degree];
    for (int i = degree - 1; i >= 0; --i) p = p * x + T(c[i]);
    return p;
}

template <int degree>
Float exp2ByPolynomial(Float x)
{
    const Float whole = floor(x);
    return polynomial<degree>(kExp2[degree - 2], x - whole) * asFloat((roundToInt(whole) + 127) << 23);
}

template <int degree>
Float log2ByPolynomial(Float x)
{
    const Int bits = asInt(x);
    const Float mantissa = asFloat((bits & 0x007fffff) | 0x3f800000);
    return Float((bits >> 23) - 127) + polynomial<degree>(kLog2[degree - 2], mantissa - 1.0f);
}

// The exponent's bits are log2's whole part, and the mantissa's a fraction that comes close.
constexpr auto log2FromBits = [](Float x) { return Float(asInt(x) - 0x3f800000) * 0x1p-23f; };

template <class Function>
auto laneByLane(Function f)
{
    return [f](Float x) {
        float numbers[kLanes];
        x.store(numbers);
        for (float& number : numbers) number = f(number);
        return Float::load(numbers);
    };
}

constexpr float kExponent = 32.0f;
constexpr auto bySquaring = [](Float x) {
    for (int i = 0; i < 5; ++i) x = x * x;
    return x;
};

// What is approximated: over which range, how errors count, and where an approximation changes its piece.
struct Truth
{
    const char* name;
    double low, high;
    double (*exact)(double);
    bool relative;
    std::vector<double> seams;

    double errorOf(double x, double y) const { return relative ? y / exact(x) - 1.0 : y - exact(x); }
};

template <class Function>
Error errorOf(const Truth& truth, Function f, int samples)
{
    Columns in(1);
    for (int i = 0; i < samples; ++i)
        in[0].push_back(static_cast<float>(truth.low + (truth.high - truth.low) * i / (samples - 1)));
    const Columns out = evaluate<1>(in, f);
    ErrorSum sum;
    for (std::size_t i = 0; i < in[0].size(); ++i) sum.add(truth.errorOf(in[0][i], out[0][i]));
    return sum.result();
}

// By how much the error changes from one float to the next, next to the seams.
template <class Function>
double largestJump(const Truth& truth, Function f)
{
    double largest = 0.0;
    for (const double seam : truth.seams) {
        Columns in(1);
        const std::int32_t middle = std::bit_cast<std::int32_t>(static_cast<float>(seam));
        for (std::int32_t i = middle - 8; i < middle + 8; ++i) in[0].push_back(std::bit_cast<float>(i));
        const Columns out = evaluate<1>(in, f);
        for (std::size_t i = 1; i < 16; ++i) {
            const double before = truth.errorOf(in[0][i - 1], out[0][i - 1]),
                         after = truth.errorOf(in[0][i], out[0][i]);
            largest = std::max(largest, std::abs(after - before));
        }
    }
    return largest;
}

struct Family
{
    Experiment& e;
    Effort effort;
    Truth truth;
    std::shared_ptr<const Columns> in;

    template <class Function>
    void add(const std::string& name, Function f) const
    {
        e.variants.push_back(
            laneVariant<1>(truth.name, name, in, f, [f, t = truth, n = effort.samples(1 << 20, 1 << 14)] {
                return Outcome(errorOf(t, f, n), {{"jump at a seam", largestJump(t, f)}});
            }));
    }
};

template <int degree>
void addDegree(const Family& exp2Family, const Family& log2Family)
{
    const std::string name = "degree " + std::to_string(degree);
    exp2Family.add(name, [](Float x) { return exp2ByPolynomial<degree>(x); });
    log2Family.add(name, [](Float x) { return log2ByPolynomial<degree>(x); });
}

// The polynomial alone, in doubles: its error is that of the degree, not of floats.
template <int degree>
double errorOfDegree(bool ofExp2)
{
    double largest = 0.0;
    for (int i = 0; i <= 4096; ++i) {
        const double x = i / 4096.0;
        const double error = ofExp2 ? polynomial<degree>(kExp2[degree - 2], x) / std::exp2(x) - 1.0
                                    : polynomial<degree>(kLog2[degree - 2], x) - std::log2(1.0 + x);
        largest = std::max(largest, std::abs(error));
    }
    return largest;
}

template <int degree>
void checkDegree(Experiment& e, double exp2Error, double log2Error)
{
    const std::string name = ", degree " + std::to_string(degree) + ", in doubles";
    e.checks.push_back({"exp2" + name, exp2Error, [] { return errorOfDegree<degree>(true); }, 1e-4 * exp2Error});
    e.checks.push_back({"log2" + name, log2Error, [] { return errorOfDegree<degree>(false); }, 1e-4 * log2Error});
}

double power(double x, double n)
{
    const Columns in(1, std::vector<float>(16, static_cast<float>(x)));
    return evaluate<1>(in, [n](Float f) { return pow(f, Float(n)); })[0][0];
}

// The largest error of the engine's pow() at this exponent, from 0.5 or where the result is no subnormal number.
double powError(double n)
{
    const double low = std::max(0.5, std::exp2(-120.0 / n));
    Columns in(1);
    for (int i = 0; i < 4096; ++i) in[0].push_back(static_cast<float>(low + (1.0 - low) * i / 4095.0));
    const Columns out = evaluate<1>(in, [n](Float f) { return pow(f, Float(n)); });
    double largest = 0.0;
    for (std::size_t i = 0; i < 4096; ++i)
        largest = std::max(largest, std::abs(out[0][i] / std::pow(static_cast<double>(in[0][i]), n) - 1.0));
    return largest;
}

}  // namespace

Experiment exponentials(Effort effort)
{
    Experiment e;
    e.id = "E-20";
    e.title = "exp2, log2 and pow";
    e.question =
        "pow(x, y) is exp2(y log2 x), and both are a polynomial for the fraction and a shift for the whole part. "
        "Which degree is enough, and what does it save? Errors of exp2 and pow are relative, of log2 absolute. A "
        "second number is the jump where one piece ends and the next begins: it draws a line into a highlight.";
    e.item = "value";
    e.unit = "relative (log2: absolute) error";
    e.rivals = Rivals::ofOneName;
    Truth exp2Truth = {"exp2", -4.0, 4.0, [](double x) { return std::exp2(x); }, true, {}};
    for (const double seam : {1.0, 2.0, 3.0}) exp2Truth.seams.push_back(seam);
    Truth log2Truth = {"log2", 0.5, 2.0, [](double x) { return std::log2(x); }, false, {}};
    for (const double seam : {1.0, 2.0}) log2Truth.seams.push_back(seam);
    Truth powTruth = {"pow 32", 0.5, 1.0, [](double x) { return std::pow(x, 32.0); }, true, {}};
    for (int i = 1; i < 32; ++i) powTruth.seams.push_back(std::exp2(-i / 32.0));
    const Family exp2Family = {e, effort, exp2Truth, randomColumns({{-8.0, 8.0}})};
    const Family log2Family = {e, effort, log2Truth, randomColumns({{0.01, 4.0}})};
    const Family powFamily = {e, effort, powTruth, randomColumns({{0.5, 1.0}})};

    exp2Family.add("engine", [](Float x) { return exp2(x); });
    exp2Family.add("C library", laneByLane([](float x) { return std::exp2(x); }));
    log2Family.add("engine", [](Float x) { return log2(x); });
    log2Family.add("C library", laneByLane([](float x) { return std::log2(x); }));
    log2Family.add("bits alone", log2FromBits);
    addDegree<2>(exp2Family, log2Family);
    addDegree<3>(exp2Family, log2Family);
    addDegree<4>(exp2Family, log2Family);
    addDegree<5>(exp2Family, log2Family);
    addDegree<6>(exp2Family, log2Family);
    addDegree<7>(exp2Family, log2Family);
    powFamily.add("engine", [](Float x) { return pow(x, Float(kExponent)); });
    powFamily.add("C library", laneByLane([](float x) { return std::pow(x, kExponent); }));
    powFamily.add("5 squarings", bySquaring);
    powFamily.add("degrees 3", [](Float x) { return exp2ByPolynomial<3>(log2ByPolynomial<3>(x) * kExponent); });
    powFamily.add("degrees 5", [](Float x) { return exp2ByPolynomial<5>(log2ByPolynomial<5>(x) * kExponent); });
    powFamily.add("degrees 5 and 7", [](Float x) { return exp2ByPolynomial<5>(log2ByPolynomial<7>(x) * kExponent); });

    checkDegree<2>(e, .00172476, .00493975);
    checkDegree<3>(e, 7.47811e-5, 6.37114e-4);
    checkDegree<4>(e, 2.59334e-6, 8.75916e-5);
    checkDegree<5>(e, 7.49363e-8, 1.25386e-5);
    checkDegree<6>(e, 1.85577e-9, 1.84567e-6);
    checkDegree<7>(e, 4.02103e-11, 2.77285e-7);
    e.checks.push_back({"log2, bits alone", .0860713,
                        [truth = log2Family.truth] { return errorOf(truth, log2FromBits, 1 << 14).max; }, 8.6e-6});
    // What log2's error of 2^-21, Direct3D's limit, makes of a power.
    struct Limit
    {
        double exponent, error;
    };
    for (const Limit& limit : {Limit{10, 3.30519e-6}, {100, 3.30524e-5}, {1000, 3.30573e-4}, {1e4, 3.31065e-3}}) {
        Check check = {"pow " + number(limit.exponent, 0), limit.error, [=] { return powError(limit.exponent); }, 0.0};
        check.isBound = true;
        e.checks.push_back(check);
    }
    e.checks.push_back({"pow 10000, half the step from 1 to the float below", 2.98023e-4,
                        [] { return (1.0 - power(1.0 - 0x1p-24, 1e4)) / 2.0; }, 3e-7});

    e.finding = [](const Rows& rows) {
        const auto scientific = [](double v) {
            char buffer[32];
            std::snprintf(buffer, sizeof buffer, "%.1e", v);
            return std::string(buffer);
        };
        const Row &engine = rows("pow 32", "engine"), &squarings = rows("pow 32", "5 squarings"),
                  &library = rows("pow 32", "C library"), &third = rows("pow 32", "degrees 3"),
                  &second = rows("exp2", "degree 2"), &cubic = rows("exp2", "degree 3");
        return "A power of 32 by polynomials of degree 3 takes " + number(third.fastest, 3) +
               " ns instead of the engine's " + number(engine.fastest, 3) + ", and is wrong by up to " +
               number(100.0 * third.outcome.error.max, 1) +
               " %: the exponent multiplies log2's error. Where the exponent is known, five multiplications take " +
               number(squarings.fastest, 3) + " ns at an error of " + scientific(squarings.outcome.error.max) +
               "; the C library, one lane at a time, takes " + number(library.fastest, 2) +
               ". Odd degrees join without a jump (" + scientific(cubic.fact("jump at a seam")) +
               " at degree 3), because the error is the same at both ends of a piece; even ones do not (" +
               scientific(second.fact("jump at a seam")) + " at degree 2).";
    };
    return e;
}

}  // namespace relief::experiments
