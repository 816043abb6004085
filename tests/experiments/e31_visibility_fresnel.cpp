// E-31: the two factors of a microfacet highlight that are usually approximated: visibility and Fresnel's reflectance.
#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"
#include "relief/shading/lighting.h"

namespace relief::experiments {

namespace {

// --- visibility: a = roughness, l = N.L, v = N.V ---

constexpr auto smith = [](Float a, Float l, Float v) {
    const Float a2 = a * a;
    return 0.5f / (l * sqrt(v * v * (1.0f - a2) + a2) + v * sqrt(l * l * (1.0f - a2) + a2));
};
constexpr auto rootFree = [](Float a, Float l, Float v) {
    return 0.5f / (l * (v * (1.0f - a) + a) + v * (l * (1.0f - a) + a));
};
constexpr auto unity = [](Float a, Float l, Float v) {
    return 0.5f / (l * (v * (1.0f - a) + a) + v * (l * (1.0f - a) + a) + 1e-5f);
};

double exactSmith(double a, double l, double v)
{
    const double a2 = a * a;
    return 0.5 / (l * std::sqrt(v * v * (1.0 - a2) + a2) + v * std::sqrt(l * l * (1.0 - a2) + a2));
}

template <class Visibility>
Outcome visibilityOutcome(Visibility visibility, int steps)
{
    Columns in(3);
    for (int i = 0; i < 16; ++i) {
        for (int k = 1; k <= steps; ++k) {
            for (int m = 1; m <= steps; ++m) {
                in[0].push_back(static_cast<float>(std::pow(0.002, 1.0 - i / 15.0)));
                in[1].push_back(static_cast<float>(k) / static_cast<float>(steps));
                in[2].push_back(static_cast<float>(m) / static_cast<float>(steps));
            }
        }
    }
    const Columns out = evaluate<3>(in, visibility);
    ErrorSum sum;
    for (std::size_t i = 0; i < in[0].size(); ++i)
        sum.add(100.0 * (static_cast<double>(out[0][i]) / exactSmith(in[0][i], in[1][i], in[2][i]) - 1.0));
    return Outcome(sum.result());
}

// --- Fresnel's reflectance of a dielectric of index 1.5: F0 = 0.04 ---

constexpr auto schlick5 = [](Float c) { return 0.04f + 0.96f * Pow5(1.0f - c); };
constexpr auto schlick4 = [](Float c) {
    const Float s = (1.0f - c) * (1.0f - c);
    return 0.04f + 0.96f * s * s;
};
constexpr auto fresnel = [](Float c) {
    const Float g = sqrt(c * c + 1.25f);  // index^2 - 1
    const Float a = (g - c) / (g + c), b = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
    return 0.5f * a * a * (1.0f + b * b);
};

double exactFresnel(double c)
{
    const double sine = std::sqrt(1.0 - c * c) / 1.5, t = std::sqrt(1.0 - sine * sine);
    const double s = (c - 1.5 * t) / (c + 1.5 * t), p = (t - 1.5 * c) / (t + 1.5 * c);
    return 0.5 * (s * s + p * p);
}

template <class Reflectance>
Outcome fresnelOutcome(Reflectance reflectance, int steps)
{
    Columns in(1);
    for (int i = 0; i <= steps; ++i) in[0].push_back(static_cast<float>(i) / static_cast<float>(steps));
    while (in[0].size() % 16 != 0) in[0].push_back(1.0f);
    const Columns out = evaluate<1>(in, reflectance);
    ErrorSum sum;
    for (std::size_t i = 0; i < in[0].size(); ++i)
        sum.add(100.0 * (static_cast<double>(out[0][i]) - exactFresnel(in[0][i])));
    return Outcome(sum.result());
}

}  // namespace

Experiment visibilityAndFresnel(Effort effort)
{
    Experiment e;
    e.id = "E-31";
    e.title = "Visibility and Fresnel";
    e.question =
        "A highlight is the product of three factors. Visibility: how much of the micro-facets is hidden by others, "
        "Smith's form with its two square roots, and Unity's without. Fresnel: how much glass (index 1.5) reflects, by "
        "the exact formula and by Schlick's fifth power, or a fourth. Errors in percent: of the visibility, and of the "
        "light for Fresnel.";
    e.item = "evaluation";
    e.unit = "percent";
    e.rivals = Rivals::ofOneName;
    const int steps = effort.samples(256, 32);
    const auto in = randomColumns({{0.002, 1.0}, {0.01, 1.0}, {0.01, 1.0}});
    const auto visibility = [&](const char* name, auto f) {
        e.variants.push_back(laneVariant<3>("visibility", name, in, f, [=] { return visibilityOutcome(f, steps); }));
    };
    visibility("Smith", smith);
    visibility("without roots", rootFree);
    visibility("Unity", unity);
    const auto cosines = randomColumns({{0.0, 1.0}});
    const auto reflectance = [&](const char* name, auto f) {
        e.variants.push_back(
            laneVariant<1>("Fresnel", name, cosines, f, [=] { return fresnelOutcome(f, 16 * steps); }));
    };
    reflectance("exact", fresnel);
    reflectance("Schlick, 5th power", schlick5);
    reflectance("4th power", schlick4);

    // Where N.L = N.V = a goes to 0 the rootless form falls short by 1 - 1 / sqrt 2.
    e.checks.push_back({"without roots: percent short at N.L = N.V = a = 0.0001", 29.2893,
                        [] {
                            const Columns at(3, std::vector<float>(16, 1e-4f));
                            return 100.0 * (1.0 - static_cast<double>(evaluate<3>(at, rootFree)[0][0]) /
                                                      exactSmith(1e-4, 1e-4, 1e-4));
                        },
                        0.01});
    e.checks.push_back({"without roots: never further off", 29.2894,
                        [] { return visibilityOutcome(rootFree, 64).error.max; }, 0.0, true});
    e.checks.push_back(
        {"Schlick: largest error, percent", 3.56926, [] { return fresnelOutcome(schlick5, 65536).error.max; }, 4e-4});
    // (1 - c)^4 - (1 - c)^5 has its peak at c = 0.2.
    e.checks.push_back({"4th power for 5th: largest difference", 0.0786432,
                        [] {
                            const Columns at = {std::vector<float>(16, 0.2f)};
                            return static_cast<double>(evaluate<1>(at, schlick4)[0][0]) -
                                   static_cast<double>(evaluate<1>(at, schlick5)[0][0]);
                        },
                        1e-6});
    e.finding = [](const Rows& rows) {
        const Row &exact = rows("visibility", "Smith"), &quick = rows("visibility", "without roots"),
                  &fresnelExact = rows("Fresnel", "exact"), &schlick = rows("Fresnel", "Schlick, 5th power");
        return "Without its roots the visibility is up to " + number(quick.outcome.error.max, 1) +
               " % off, at grazing angles, in " + number(quick.fastest, 2) + " ns against " + number(exact.fastest, 2) +
               ". Schlick's power is off by " + number(schlick.outcome.error.max, 1) + " % of the light at most, in " +
               number(schlick.fastest, 2) + " ns against " + number(fresnelExact.fastest, 2) + " of the exact formula.";
    };
    return e;
}

}  // namespace relief::experiments
