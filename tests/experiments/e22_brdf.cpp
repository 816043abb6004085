// E-22: lighting models, and what Unity's epsilons do to a highlight.
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/shading/lighting.h"

namespace relief::experiments {

namespace {

constexpr double kPi = std::numbers::pi;

// One light: the normal is (0, 0, 1); the light's tilt and direction, the viewer's tilt, the smoothness.
struct Geometry
{
    float3 light, view;
};
inline Geometry geometryOf(Float lx, Float ly, Float vx)
{
    return {{lx, ly, sqrt(saturate(1.0f - lx * lx - ly * ly))}, {vx, 0.0f, sqrt(saturate(1.0f - vx * vx))}};
}

constexpr float kAlbedo = 0.5f, kSpecular = 0.04f;

constexpr auto pbs = [](Float lx, Float ly, Float vx, Float smoothness) {
    const Geometry g = geometryOf(lx, ly, vx);
    return UNITY_BRDF_PBS(float3(kAlbedo), float3(kSpecular), smoothness, float3(0, 0, 1), g.view,
                          {float3(1.0f), g.light})
        .x;
};
constexpr auto pbsExact = [](Float lx, Float ly, Float vx, Float smoothness) {
    const Geometry g = geometryOf(lx, ly, vx);
    return UNITY_BRDF_PBS_Exact(float3(kAlbedo), float3(kSpecular), smoothness, float3(0, 0, 1), g.view,
                                {float3(1.0f), g.light})
        .x;
};
// The older models, with the exponent whose lobe is as wide: 2 / a^2 - 2.
inline Float exponentOf(Float smoothness)
{
    const Float p = 1.0f - saturate(smoothness), a = max(p * p, Float(0.002f));
    return 2.0f / (a * a) - 2.0f;
}
constexpr auto blinnPhong = [](Float lx, Float ly, Float vx, Float smoothness) {
    const Geometry g = geometryOf(lx, ly, vx);
    const Float n = exponentOf(smoothness), NdotH = saturate(normalize(g.light + g.view).z);
    return g.light.z * (kAlbedo + kSpecular * (n + 8.0f) * 0.125f * pow(NdotH, n));
};
constexpr auto phong = [](Float lx, Float ly, Float vx, Float smoothness) {
    const Geometry g = geometryOf(lx, ly, vx);
    const float3 mirrored = reflect(-g.light, float3(0, 0, 1));
    const Float n = exponentOf(smoothness) * 0.25f;  // of the angle to the mirror direction, twice as large
    return g.light.z * (kAlbedo + kSpecular * (n + 2.0f) * 0.5f * pow(saturate(dot(mirrored, g.view)), n));
};
constexpr auto lambert = [](Float lx, Float ly, Float, Float) {
    return geometryOf(lx, ly, Float(0.0f)).light.z * kAlbedo;
};

// The microfacet model in doubles: GGX, Smith's joint visibility, Schlick, Disney's diffuse.
double reference(double lx, double ly, double vx, double smoothness)
{
    const double l = std::sqrt(std::fmax(0.0, 1.0 - lx * lx - ly * ly)), v = std::sqrt(std::fmax(0.0, 1.0 - vx * vx));
    const double hx = lx + vx, hy = ly, hz = l + v, length = std::sqrt(hx * hx + hy * hy + hz * hz);
    const double sine2 = (hx * hx + hy * hy) / (length * length), LdotH = (lx * hx + ly * hy + l * hz) / length;
    const double p = 1.0 - smoothness, a = std::fmax(p * p, 0.002), a2 = a * a;
    const auto pow5 = [](double x) { return x * x * x * x * x; };
    const double fd90 = 0.5 + 2.0 * LdotH * LdotH * p;
    const double diffuse = (1.0 + (fd90 - 1.0) * pow5(1.0 - l)) * (1.0 + (fd90 - 1.0) * pow5(1.0 - v)) * l;
    const double V = 0.5 / (l * std::sqrt(v * v * (1.0 - a2) + a2) + v * std::sqrt(l * l * (1.0 - a2) + a2));
    const double d = a2 + (1.0 - a2) * sine2, D = a2 / (kPi * d * d);
    const double F = kSpecular + (1.0 - kSpecular) * pow5(1.0 - LdotH);
    return kAlbedo * diffuse + F * V * D * kPi * l;
}

// Exposed as a picture is: 1 is white.
template <class Model>
Outcome outcome(Model model, int count)
{
    const std::shared_ptr<const Columns> in =
        randomColumns({{-0.65, 0.65}, {-0.65, 0.65}, {-0.95, 0.95}, {0.0, 1.0}}, static_cast<std::size_t>(count), 22);
    const Columns out = evaluate<4>(*in, model);
    ErrorSum sum;
    std::int64_t off = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const auto shown = [](double x) { return std::fmin(1.0, std::fmax(0.0, x)); };
        const double exact = reference((*in)[0][i], (*in)[1][i], (*in)[2][i], (*in)[3][i]);
        const double error = 255.0 * (shown(out[0][i]) - shown(exact));
        sum.add(error);
        off += std::abs(error) > 1.0;
    }
    return Outcome(sum.result(), {{"% off by over a code", 100.0 * static_cast<double>(off) / count}});
}

// D at N.H = 1 from the highlight's peak: light and viewer straight above, where V = 1/4 or a little less.
template <class Model>
double peak(Model model, double smoothness)
{
    Columns in(4, std::vector<float>(16, 0.0f));
    in[3].assign(16, static_cast<float>(smoothness));
    const double p = 1.0 - static_cast<double>(in[3][0]), fd = 0.5 + 2.0 * p, diffuse = kAlbedo * (fd * 0 + 1.0);
    return (static_cast<double>(evaluate<4>(in, model)[0][0]) - diffuse) / (kSpecular * kPi * 0.25);
}

// What of the light a surface with F = 1 sends on, by quadrature over the half vector; `compat` with Unity's epsilons.
double directionalAlbedo(double smoothness, double NdotV, bool compat)
{
    const double p = 1.0 - smoothness, a = std::fmax(p * p, 0.002), a2 = a * a;
    const double vx = std::sqrt(1.0 - NdotV * NdotV);
    constexpr int kTilts = 3000, kTurns = 480;
    double sum = 0.0;
    for (int i = 0; i < kTilts; ++i) {
        // Tilts as GGX spreads them: tan^2 = a^2 x / (1 - x), whose density is D N.H.
        const double x = (i + 0.5) / kTilts, tan2 = a2 * x / (1.0 - x), cosine = 1.0 / std::sqrt(1.0 + tan2);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const double d = (cosine * a2 - cosine) * cosine + 1.0;
        const double dExact = a2 + (1.0 - a2) * sine * sine;
        const double share = compat ? dExact * dExact / (d * d + 1e-7) : 1.0;
        for (int k = 0; k < kTurns; ++k) {
            const double phi = (k + 0.5) / kTurns * 2.0 * kPi, hx = sine * std::cos(phi),
                         VdotH = vx * hx + NdotV * cosine;
            const double NdotL = 2.0 * VdotH * cosine - NdotV;
            if (NdotL <= 0.0 || VdotH <= 0.0) continue;
            const double l = NdotL, v = NdotV;
            const double V =
                compat ? 0.5 / (l * (v * (1.0 - a) + a) + v * (l * (1.0 - a) + a) + 1e-5)
                       : 0.5 / (l * std::sqrt(v * v * (1.0 - a2) + a2) + v * std::sqrt(l * l * (1.0 - a2) + a2));
            sum += share * V * l * 4.0 * VdotH / cosine;
        }
    }
    return sum / (static_cast<double>(kTilts) * kTurns);
}

// The integral of D N.H over all half vectors, 1 by definition, with Unity's epsilon: what of the highlight is left.
double leftOfHighlight(double smoothness)
{
    const double p = 1.0 - smoothness, a = std::fmax(p * p, 0.002), a2 = a * a;
    constexpr int kTilts = 200000;
    double sum = 0.0;
    for (int i = 0; i < kTilts; ++i) {
        const double x = (i + 0.5) / kTilts, tan2 = a2 * x / (1.0 - x), cosine2 = 1.0 / (1.0 + tan2);
        const double d = cosine2 * (a2 - 1.0) + 1.0;
        sum += d * d / (d * d + 1e-7);
    }
    return sum / kTilts;
}

}  // namespace

Experiment lightingModels(Effort effort)
{
    Experiment e;
    e.id = "E-22";
    e.title = "Lighting models";
    e.question =
        "Unity's lighting model adds small numbers to its denominators and leaves out two square roots; the exact form "
        "of the same model does not. The older models stand beside them, with the exponent whose highlight is as wide. "
        "Errors are those of a picture in which 1 is white, over all directions of light and viewer and all "
        "smoothnesses, against the microfacet model in doubles. Of the reference values, the shares of light at N.V = "
        "0.1 are from a quadrature coarser than the one here, and differ in the third digit.";
    e.item = "light and fragment";
    e.unit = "codes of 255";
    const auto in = randomColumns({{-0.65, 0.65}, {-0.65, 0.65}, {-0.95, 0.95}, {0.0, 1.0}});
    const int count = effort.samples(1 << 20, 1 << 13);
    const auto add = [&](const char* name, auto model) {
        e.variants.push_back(laneVariant<4>(name, "", in, model, [=] { return outcome(model, count); }));
    };
    add("exact", pbsExact);
    add("Unity", pbs);
    add("Blinn-Phong", blinnPhong);
    add("Phong", phong);
    add("Lambert", lambert);

    struct Reference
    {
        double smoothness, exactPeak, unityPeak, left;
    };
    for (const Reference& r : {Reference{0.5, 5.09296, 5.09283, .999991},
                               {0.7, 39.2975, 39.2377, .999488},
                               {0.8, 198.944, 191.465, .987256},
                               {0.85, 628.760, 452.286, .893804},
                               {0.9, 3183.10, 289.373, .399816},
                               {0.95, 50929.6, 19.8866, .0306490},
                               {1.0, 79577.5, 12.7304, .0197053}}) {
        // The smoothness itself is a float: (1 - s)^4 of it differs in the sixth digit.
        const std::string at = " peak of D at smoothness " + number(r.smoothness, 2);
        e.checks.push_back(
            {"exact:" + at, r.exactPeak, [=] { return peak(pbsExact, r.smoothness); }, r.exactPeak * 2e-4});
        e.checks.push_back({"Unity:" + at, r.unityPeak, [=] { return peak(pbs, r.smoothness); }, r.unityPeak * 2e-3});
        e.checks.push_back({"Unity: what is left of the highlight at smoothness " + number(r.smoothness, 2), r.left,
                            [=] { return leftOfHighlight(r.smoothness); }, 1e-4 * r.left});
    }
    struct Albedo
    {
        double smoothness, NdotV, exact, unity;
    };
    for (const Albedo& a : {Albedo{.5, 1, .9158, .8951},
                            {.5, .5, .8573, .7562},
                            {.5, .1, .8941, .7503},
                            {.75, 1, .9955, .9920},
                            {.75, .5, .9888, .9321},
                            {.75, .1, .8948, .7023},
                            {.9, 1, 1.0000, .3998},
                            {.9, .5, .9997, .3957},
                            {.9, .1, .9935, .3649}}) {
        // The references' quadrature is coarser than this one where the viewer grazes the surface.
        const double tolerance = a.NdotV < 0.5 ? 3e-3 : 1e-3;
        const std::string at =
            "share of light at smoothness " + number(a.smoothness, 2) + ", N.V " + number(a.NdotV, 1);
        e.checks.push_back(
            {"exact: " + at, a.exact, [=] { return directionalAlbedo(a.smoothness, a.NdotV, false); }, tolerance});
        e.checks.push_back(
            {"Unity: " + at, a.unity, [=] { return directionalAlbedo(a.smoothness, a.NdotV, true); }, tolerance});
    }
    e.finding = [](const Rows& rows) {
        const Row &exact = rows("exact"), &unity = rows("Unity"), &blinn = rows("Blinn-Phong");
        const auto cut = [](double smoothness) {
            return number(peak(pbsExact, smoothness) / peak(pbs, smoothness), 0);
        };
        return "Unity's 1e-7 is far from harmless: at smoothness 0.9 the highlight's peak is " + cut(0.9) +
               " times too low, at 1 " + cut(1.0) + " times, and " + number(100.0 * leftOfHighlight(0.9), 0) +
               " % and " + number(100.0 * leftOfHighlight(1.0), 1) + " % of its light come back. " +
               number(unity.fact("% off by over a code"), 1) +
               " % of all settings are off by more than a code. The exact form, " + number(exact.outcome.error.max, 2) +
               " codes off at most, takes " + number(exact.fastest, 2) + " ns a light against " +
               number(unity.fastest, 2) + ". Blinn-Phong (" + number(blinn.fastest, 2) +
               " ns) is another model: " + number(blinn.fact("% off by over a code"), 0) + " % differ.";
    };
    return e;
}

}  // namespace relief::experiments
