// E-11: the level of detail of a pixel's footprint.
#include <array>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/texture/level_of_detail.h"

namespace relief::experiments {

namespace {

// --- forms: the square of how many texels a pixel covers; dX and dY are what u and v change, in texels ---

// The longer axis of the ellipse that a round pixel becomes (Heckbert 1989; D3D 11.3, 7.18.11).
constexpr auto ellipse = [](const float2& dX, const float2& dY) {
    const Float a = dX.y * dX.y + dY.y * dY.y, b = -2.0f * (dX.x * dX.y + dY.x * dY.y), c = dX.x * dX.x + dY.x * dY.x;
    const Float p = a - c;
    return 0.5f * (a + c + sqrt(p * p + b * b));
};
constexpr auto longest = [](const float2& dX, const float2& dY) { return longestSquare(dX, dY); };
constexpr auto squared = [](Float a) { return a * a; };
constexpr auto component = [](const float2& dX, const float2& dY) {
    return squared(max(max(abs(dX.x), abs(dX.y)), max(abs(dY.x), abs(dY.y))));
};
constexpr auto axisSum = [](const float2& dX, const float2& dY) {
    return squared(max(abs(dX.x) + abs(dX.y), abs(dY.x) + abs(dY.y)));
};
constexpr auto upperBound = [](const float2& dX, const float2& dY) {  // the largest that OpenGL allows (4.6, 8.14.1)
    return squared(max(abs(dX.x), abs(dY.x)) + max(abs(dX.y), abs(dY.y)));
};

// --- logarithms: of positive normal numbers ---

constexpr auto engineLog2 = [](Float x) { return log2(x); };
// A float's bits, read as a number, are a logarithm already: the mantissa stands for its own.
constexpr auto bitsLog2 = [](Float x) { return Float(asInt(x) - 0x3f800000) * 0x1p-23f; };

template <std::size_t size>
constexpr auto polynomialLog2(std::array<float, size> highestFirst)
{
    return [=](Float x) {
        const Int bits = asInt(x) - 0x3f800000;
        const Float t = asFloat((bits & 0x7fffff) | 0x3f800000) - 1.0f;
        Float p = highestFirst[0];
        for (std::size_t i = 1; i < size; ++i) p = p * t + highestFirst[i];
        return Float(bits >> 23) + p;
    };
}
// Smallest largest error on [1, 2], by Remez's exchange.
constexpr auto log2Degree2 = polynomialLog2(std::array{-0.344848433f, 1.33496891f, 0.00493975995f});
constexpr auto log2Degree3 = polynomialLog2(std::array{0.158248703f, -0.577128914f, 1.41888021f, 0.000637117285f});
constexpr auto log2Degree4 =
    polynomialLog2(std::array{-0.0816158087f, 0.31867913f, -0.674942892f, 1.43770439f, 8.75919222e-05f});
constexpr auto log2Degree5 =
    polynomialLog2(std::array{0.0448736103f, -0.192195636f, 0.41363012f, -0.707992651f, 1.44168456f, 1.25387446e-05f});

template <class Form, class Log>
constexpr auto levelBy(Form form, Log log)
{
    return [=](Float ux, Float vx, Float uy, Float vy) { return 0.5f * log(form(float2(ux, vx), float2(uy, vy))); };
}

// --- references ---

double exactLevel(double ux, double vx, double uy, double vy)
{
    const double a = vx * vx + vy * vy, b = -2.0 * (ux * vx + uy * vy), c = ux * ux + uy * uy;
    return 0.5 * std::log2(0.5 * (a + c + std::hypot(a - c, b)));
}

// Footprints of all shapes and sizes: the second axis is up to 16 times the shorter.
std::shared_ptr<const Columns> footprints(std::size_t count)
{
    const auto random = randomColumns({{-1, 1}, {-1, 1}, {-1, 1}, {-1, 1}, {-2, 6}, {-4, 0}}, count, 11);
    auto all = std::make_shared<Columns>(random->begin(), random->begin() + 4);
    for (std::size_t i = 0; i < count; ++i) {
        const float size = std::exp2((*random)[4][i]), shape = std::exp2((*random)[5][i]);
        for (std::size_t c = 0; c < 4; ++c) (*all)[c][i] *= c < 2 ? size : size * shape;
    }
    return all;
}

template <class Log>
double worstLogarithm(Log log, std::size_t mantissas)
{
    Columns x(1);
    for (std::size_t i = 0; i < mantissas; ++i)
        x[0].push_back(1.0f + static_cast<float>(i) / static_cast<float>(mantissas));
    const Columns measured = evaluate<1>(x, log);
    double worst = 0.0;
    for (std::size_t i = 0; i < mantissas; ++i)
        worst = std::fmax(worst, std::abs(measured[0][i] - std::log2(static_cast<double>(x[0][i]))));
    return worst;
}

template <class Form>
double levelOf(Form form, double ux, double vx, double uy, double vy)
{
    Columns rows(4);
    const double changes[4] = {ux, vx, uy, vy};
    for (std::size_t c = 0; c < 4; ++c) rows[c].assign(16, static_cast<float>(changes[c]));
    return evaluate<4>(rows, levelBy(form, engineLog2))[0][0];
}

template <class Form, class Log>
Outcome outcomeOf(Form form, Log log, const Columns& all)
{
    const Columns levels = evaluate<4>(all, levelBy(form, log));
    ErrorSum sum;
    double below = 0.0, above = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < all[0].size(); ++i) {
        const double ux = all[0][i], vx = all[1][i], uy = all[2][i], vy = all[3][i], level = levels[0][i];
        const double error = level - exactLevel(ux, vx, uy, vy);
        sum.add(error);
        below = std::fmax(below, -error);
        above = std::fmax(above, error);
        const double mu = std::fmax(std::abs(ux), std::abs(uy)), mv = std::fmax(std::abs(vx), std::abs(vy));
        constexpr double tolerance = 1.0 / 256.0;
        outside += level < std::log2(std::fmax(mu, mv)) - tolerance || level > std::log2(mu + mv) + tolerance;
    }
    return {sum.result(),
            {{"worst too sharp", below},
             {"worst too blurred", above},
             {"outside OpenGL's bounds, %", 100.0 * outside / static_cast<double>(all[0].size())},
             {"of it the logarithm, worst", 0.5 * worstLogarithm(log, 1 << 12)}}};
}

}  // namespace

Experiment levelForms(Effort effort)
{
    Experiment e;
    e.id = "E-11";
    e.title = "Level of detail: forms and logarithms";
    e.question =
        "A round pixel covers an ellipse of texels, and its longer axis says which mip level is wanted. The engine "
        "takes the longer of the two derivatives instead, as Direct3D does; OpenGL allows anything between the "
        "largest component and the sum of the largest in u and v. How many levels do these lie apart, and how exact "
        "has the logarithm to be that turns a length into a level?";
    e.item = "pixel";
    e.unit = "levels";
    const auto timed = footprints(kStreamedItems);
    const auto add = [&](const std::string& form, const std::string& log, auto f, auto l) {
        e.variants.push_back(laneVariant<4>(form, log, timed, levelBy(f, l), [=] {
            return outcomeOf(f, l, *footprints(static_cast<std::size_t>(effort.samples(1 << 20, 1 << 12))));
        }));
    };
    add("ellipse", "log2", ellipse, engineLog2);
    add("length", "log2", longest, engineLog2);
    add("component", "log2", component, engineLog2);
    add("sum per axis", "log2", axisSum, engineLog2);
    add("GL maximum", "log2", upperBound, engineLog2);
    add("length", "bits", longest, bitsLog2);
    add("length", "degree 2", longest, log2Degree2);
    add("length", "degree 3", longest, log2Degree3);
    add("length", "degree 4", longest, log2Degree4);
    add("length", "degree 5", longest, log2Degree5);
    add("ellipse", "degree 3", ellipse, log2Degree3);

    constexpr double kLevel = 1.0 / 256.0, kExact = 1e-4;
    struct Reference
    {
        double ux, vx, uy, vy, length, lower, upper, vulkan, major, ratio, anisotropic;
    };
    constexpr Reference kReferences[] = {{1, 0, 0, 1, 0, 0, 1, 0.5, 0, 1, 0},
                                         {4, 0, 0, 1, 2, 2, 2.32193, 2.5, 2, 4, 0},
                                         {3, 4, -4, 3, 2.32193, 2, 3, 3.30735, 2.32193, 1, 2.32193},
                                         {2, 2, 2, 2, 1.5, 1, 2, 2.5, 2, 2.82843, -2.5},
                                         {1, 0, .8, .6, 0, 0, .678072, 0.985427, .423998, 1, -.736966},
                                         {16, 0, 0, .25, 4, 4, 4.02237, 4.5, 4, 16, 0},
                                         {64, 0, 0, 1, 6, 6, 6.02237, 6.5, 6, 16, 2},
                                         {.5, 0, 0, .5, -1, -1, 0, -0.5, -1, 1, -1}};
    for (const Reference& r : kReferences) {
        const std::string of = " of (" + number(r.ux, 1) + ", " + number(r.vx, 1) + "), (" + number(r.uy, 1) + ", " +
                               number(r.vy, 1) + ")";
        const auto check = [&](const std::string& what, double expected, auto form) {
            e.checks.push_back({what + of, expected, [=] { return levelOf(form, r.ux, r.vx, r.uy, r.vy); }, kLevel});
        };
        check("length", r.length, longest);
        check("component", r.lower, component);
        check("upper bound", r.upper, upperBound);
        e.checks.push_back({"Vulkan's bound, sqrt(2) times the sum per axis" + of, r.vulkan,
                            [=] { return levelOf(axisSum, r.ux, r.vx, r.uy, r.vy) + 0.5; }, kLevel});
        check("ellipse", r.major, ellipse);
        const auto footprint = [r] { return anisotropicFootprint(float2(r.ux, r.vx), float2(r.uy, r.vy), 16.0f); };
        e.checks.push_back({"16 times anisotropic, ratio" + of, r.ratio, [=] { return footprint().ratio[0]; }, kExact});
        e.checks.push_back(
            {"16 times anisotropic, level" + of, r.anisotropic, [=] { return footprint().lod[0]; }, kLevel});
    }
    e.checks.push_back({"16 times anisotropic, ratio where nothing changes", 1.0,
                        [] { return anisotropicFootprint(float2(0.0f), float2(0.0f), 16.0f).ratio[0]; }, 0.0});
    e.checks.push_back({"level is -infinity where nothing changes: 1", 1.0,
                        [] { return levelOf(longest, 0, 0, 0, 0) == -HUGE_VAL ? 1.0 : 0.0; }, 0.0});
    // Two derivatives of one length at an angle: how far the ellipse reaches beyond them.
    constexpr double kAngles[][2] = {{0, .5}, {15, .487604}, {30, .449984}, {45, .385777}, {60, .292481}, {90, 0}};
    for (const auto& row : kAngles) {
        const double angle = row[0], c = std::cos(angle * kRadians), s = std::sin(angle * kRadians);
        e.checks.push_back({"ellipse less length at " + number(angle, 0) + " degrees", row[1],
                            [=] { return levelOf(ellipse, 1, 0, c, s) - levelOf(longest, 1, 0, c, s); }, kLevel});
    }
    e.checks.push_back({"component less length, of (1, 1)", -.5,
                        [] { return levelOf(component, 1, 1, 0, 0) - levelOf(longest, 1, 1, 0, 0); }, kLevel});
    e.checks.push_back({"sum less length, of (1, 1)", .5,
                        [] { return levelOf(axisSum, 1, 1, 0, 0) - levelOf(longest, 1, 1, 0, 0); }, kLevel});
    const auto logarithm = [&](const std::string& what, double expected, auto log) {
        e.checks.push_back(
            {"logarithm, " + what, expected,
             [=] { return worstLogarithm(log, static_cast<std::size_t>(effort.samples(1 << 20, 1 << 14))); },
             1e-3 * expected + 2.5e-7});  // the float's own rounding
    };
    logarithm("bits", .0860713, bitsLog2);
    logarithm("degree 2", .00493975, log2Degree2);
    logarithm("degree 3", 6.37114e-4, log2Degree3);
    logarithm("degree 4", 8.75916e-5, log2Degree4);
    logarithm("degree 5", 1.25386e-5, log2Degree5);
    for (const char* form : {"length", "component"}) {
        const std::string name = form;
        e.checks.push_back({name + " outside OpenGL's bounds, %", 0.0,
                            [=] {
                                const auto all = footprints(static_cast<std::size_t>(effort.samples(1 << 20, 1 << 14)));
                                return (name == "length" ? outcomeOf(longest, engineLog2, *all)
                                                         : outcomeOf(component, engineLog2, *all))
                                    .facts[2]
                                    .value;
                            },
                            0.0});
    }
    e.finding = [](const Rows& rows) {
        const Row &exact = rows("ellipse", "log2"), &length = rows("length", "log2");
        const Row &bits = rows("length", "bits"), &third = rows("length", "degree 3");
        return "The longer derivative is up to " + number(length.fact("worst too sharp"), 3) +
               " levels sharper than the ellipse, with an RMS of " + number(length.outcome.error.rms, 3) +
               "; OpenGL's upper bound up to " + number(rows("GL maximum", "log2").fact("worst too blurred"), 3) +
               " more blurred. Beside that the logarithm hardly counts: a float's bits alone, at most " +
               number(bits.fact("of it the logarithm, worst"), 3) + " levels off, change the RMS to " +
               number(bits.outcome.error.rms, 3) + ", and degree 3, good enough for 8 bits of fraction, to " +
               number(third.outcome.error.rms, 3) + ". Times: ellipse " + number(exact.fastest, 3) + ", length " +
               number(length.fastest, 3) + ", with degree 3 " + number(third.fastest, 3) + ", with bits " +
               number(bits.fastest, 3) +
               " ns. The form decides how sharp a picture is; the logarithm only what it costs.";
    };
    return e;
}

}  // namespace relief::experiments
