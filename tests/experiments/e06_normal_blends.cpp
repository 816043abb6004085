// E-06: a base normal and a detail normal into one.
#include <numbers>
#include <random>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/shading/normals.h"

namespace relief::experiments {

namespace {

using Blend = float3 (*)(const float3&, const float3&);

Vector normalOf(double slopeX, double slopeY)
{
    const double length = std::sqrt(slopeX * slopeX + slopeY * slopeY + 1.0);
    return {slopeX / length, slopeY / length, 1.0 / length};
}

// G1: both are height fields, and the heights add up.
Vector heightsAdded(const Vector& base, const Vector& detail)
{
    return normalOf(base.x / base.z + detail.x / detail.z, base.y / base.z + detail.y / detail.z);
}

// G2: the detail is a relief on the base's surface: turned by the rotation that takes (0, 0, 1) to the base's normal.
Vector rotated(const Vector& n, const Vector& d)
{
    const double along = (d.y * n.x - d.x * n.y) / (1.0 + n.z);  // about (-n.y, n.x, 0); Rodrigues' formula
    return {d.x * n.z + n.x * d.z + -n.y * along, d.y * n.z + n.y * d.z + n.x * along,
            d.z * n.z - n.x * d.x - n.y * d.y};
}

float3 overlay(const float3& n1, const float3& n2)
{
    // The picture editors' formula on the stored codes, channel by channel.
    const float3 a = n1 * 0.5f + 0.5f, b = n2 * 0.5f + 0.5f;
    const auto channel = [](Float x, Float y) {
        return select(x < 0.5f, 2.0f * x * y, 1.0f - 2.0f * (1.0f - x) * (1.0f - y));
    };
    return normalize(float3(channel(a.x, b.x), channel(a.y, b.y), channel(a.z, b.z)) * 2.0f - 1.0f);
}

// As the algebra has it: a division for each component that BlendNormalsDerivative multiplies out.
float3 derivativeDivided(const float3& n1, const float3& n2)
{
    return normalize(float3(n1.x / n1.z + n2.x / n2.z, n1.y / n1.z + n2.y / n2.z, Float(1.0f)));
}

// Without the guard at the pole and the last normalize(): of unit vectors the result is one.
float3 reorientedPlain(const float3& n1, const float3& n2)
{
    const float3 t = n1 + float3(0, 0, 1), u = n2 * float3(-1, -1, 1);
    return t * (dot(t, u) / t.z) - u;
}

struct Pairs
{
    std::vector<Vector> base, detail;
    Columns columns{6};

    void add(Vector b, Vector d)
    {
        base.push_back(b);
        detail.push_back(d);
        const double all[6] = {b.x, b.y, b.z, d.x, d.y, d.z};
        for (std::size_t i = 0; i < 6; ++i) columns[i].push_back(static_cast<float>(all[i]));
    }
    void fill()  // up to a whole number of blocks
    {
        while (base.size() % 16 != 0) add(base.back(), detail.back());
    }
};

// Slopes 0.1 to 2 of either map, in every direction to each other.
Pairs randomPairs(std::size_t count)
{
    Pairs pairs;
    std::mt19937 random(3);
    while (pairs.base.size() < count) {
        const double a = uniform(random) * 2.0 * std::numbers::pi, b = uniform(random) * 2.0 * std::numbers::pi;
        const double s = 0.1 * std::pow(20.0, uniform(random)), t = 0.1 * std::pow(20.0, uniform(random));
        pairs.add(normalOf(s * std::cos(a), s * std::sin(a)), normalOf(t * std::cos(b), t * std::sin(b)));
    }
    return pairs;
}

template <class Function, class Truth>
Error errorOf(Function blend, const Pairs& pairs, Truth truth)
{
    const Columns blended = evaluate<6>(pairs.columns, blend);
    ErrorSum sum;
    for (std::size_t i = 0; i < pairs.base.size(); ++i)
        sum.add(degreesBetween(vectorAt(blended, i), truth(pairs.base[i], pairs.detail[i])));
    return sum.result();
}

// Of one pair, in degrees to G1 and to G2.
template <class Function, class Truth>
double errorAt(Function blend, const Vector& base, const Vector& detail, Truth truth)
{
    Pairs pairs;
    pairs.add(base, detail);
    pairs.fill();
    return errorOf(blend, pairs, truth).max;
}

template <Blend blend>
constexpr auto kernel = [](Float ax, Float ay, Float az, Float bx, Float by, Float bz) {
    return blend(float3(ax, ay, az), float3(bx, by, bz));
};

struct Setting
{
    const char* name;
    double detailSlope;  // 0: that of the base
    double direction;    // of the detail's slope, to the base's: degrees
    bool flatBase = false, flatDetail = false;
};
constexpr Setting kCollinear = {"collinear", 0, 0}, kOrthogonal = {"orthogonal", 0, 90},
                  kUnequal = {"orthogonal, detail 0.5", 0.5, 90}, kOpposed = {"opposed", 0, 180},
                  kFlatDetail = {"flat detail", 0, 0, false, true}, kFlatBase = {"flat base", 0, 0, true, false};

template <Blend blend>
void check(Experiment& e, const std::string& name, bool rotation, const Setting& setting,
           std::initializer_list<std::pair<double, double>> slopesAndErrors)
{
    for (const auto& [slope, expected] : slopesAndErrors) {
        const double angle = setting.direction * std::numbers::pi / 180.0;
        const double d = setting.detailSlope > 0.0 ? setting.detailSlope : slope;
        const Vector base = setting.flatBase ? Vector{0, 0, 1} : normalOf(slope, 0.0);
        const Vector detail = setting.flatDetail ? Vector{0, 0, 1} : normalOf(d * std::cos(angle), d * std::sin(angle));
        e.checks.push_back(
            {name + " to " + (rotation ? "G2" : "G1") + ", " + setting.name + ", slope " + number(slope, 1), expected,
             [=] {
                 return rotation ? errorAt(kernel<blend>, base, detail, rotated)
                                 : errorAt(kernel<blend>, base, detail, heightsAdded);
             },
             1e-3});
    }
}

template <Blend blend>
void add(Experiment& e, const std::string& name, Effort effort, const std::shared_ptr<const Columns>& in)
{
    e.variants.push_back(laneVariant<6>(name, "", in, kernel<blend>, [effort] {
        const Pairs pairs = randomPairs(static_cast<std::size_t>(effort.samples(160000, 1600)));
        const Error g1 = errorOf(kernel<blend>, pairs, heightsAdded), g2 = errorOf(kernel<blend>, pairs, rotated);
        return Outcome(g1, {{"RMS to G2", g2.rms}, {"largest to G2", g2.max}});
    }));
}

}  // namespace

Experiment normalBlends(Effort effort)
{
    Experiment e;
    e.id = "E-06";
    e.title = "Two normal maps into one";
    e.question =
        "There is no right blend before one says what is meant. G1: both maps are heights, and the heights add up "
        "(the errors below). G2: the detail lies on the base's surface like a relief on a vase, turned with it. "
        "Slopes of 0.1 to 2, in all directions to each other.";
    e.item = "blend";
    e.unit = "degrees to G1";
    const auto in = std::make_shared<const Columns>(randomPairs(kStreamedItems).columns);
    add<BlendNormalsAverage>(e, "average", effort, in);
    add<overlay>(e, "overlay", effort, in);
    add<derivativeDivided>(e, "derivatives, divided", effort, in);
    add<BlendNormalsDerivative>(e, "derivatives", effort, in);
    add<BlendNormals>(e, "whiteout", effort, in);
    add<BlendNormalsUDN>(e, "UDN", effort, in);
    add<BlendNormalsRNM>(e, "RNM", effort, in);
    add<reorientedPlain>(e, "RNM, not normalised", effort, in);

    check<BlendNormalsAverage>(e, "average", false, kCollinear,
                               {{.1, 5.59934}, {.5, 18.4349}, {1, 18.4349}, {2, 12.5288}, {5, 5.59934}});
    check<BlendNormals>(e, "whiteout", false, kCollinear,
                        {{.1, .0549445}, {.5, 3.18969}, {1, 7.09383}, {2, 7.65687}, {5, 4.58707}});
    check<BlendNormalsRNM>(e, "RNM", false, kCollinear,
                           {{.1, .111254}, {.5, 8.13010}, {1, 26.5651}, {2, 50.9061}, {5, 73.0907}});
    check<overlay>(e, "overlay", false, kCollinear,
                   {{.1, .601129}, {.5, 9.92139}, {1, 18.4349}, {2, 21.0424}, {5, 13.7785}});
    for (const Setting& s : {kCollinear, kOrthogonal}) {
        check<BlendNormalsDerivative>(e, "derivatives", false, s, {{.1, 0}, {.5, 0}, {1, 0}, {2, 0}, {5, 0}});
        check<BlendNormalsUDN>(e, "UDN", false, s, {{.1, 0}, {.5, 0}, {1, 0}, {2, 0}, {5, 0}});
        check<BlendNormalsRNM>(e, "RNM", true, s, {{.1, 0}, {.5, 0}, {1, 0}, {2, 0}, {5, 0}});
    }
    check<BlendNormalsAverage>(e, "average", false, kOrthogonal,
                               {{.1, 4.00478}, {.5, 15.7932}, {1, 19.4712}, {2, 15.7932}, {5, 7.74370}});
    check<BlendNormals>(e, "whiteout", false, kOrthogonal,
                        {{.1, .0396172}, {.5, 3.06443}, {1, 8.69934}, {2, 10.4863}, {5, 6.46078}});
    check<BlendNormalsRNM>(e, "RNM", false, kOrthogonal,
                           {{.1, .0281547}, {.5, 2.47021}, {1, 9.73561}, {2, 21.6246}, {5, 34.2518}});
    check<overlay>(e, "overlay", false, kOrthogonal,
                   {{.1, .0392335}, {.5, 2.66206}, {1, 7.16959}, {2, 9.29525}, {5, 6.26188}});
    check<BlendNormalsAverage>(e, "average", false, kUnequal, {{.1, 13.3935}, {1, 20.8871}, {5, 37.6811}});
    check<BlendNormals>(e, "whiteout", false, kUnequal, {{.1, .604623}, {1, 6.47787}, {5, 18.6109}});
    check<BlendNormalsUDN>(e, "UDN", false, kUnequal, {{.1, 2.35636}, {1, 4.62362}, {5, 18.4944}});
    check<BlendNormalsRNM>(e, "RNM", false, kUnequal, {{.1, .113852}, {1, 7.09383}, {5, 20.9646}});
    check<overlay>(e, "overlay", false, kUnequal, {{.1, 2.45043}, {1, 8.40492}, {5, 33.4847}});
    check<BlendNormalsAverage>(e, "average", false, kFlatDetail,
                               {{.1, 2.85530}, {.5, 13.2825}, {1, 22.5000}, {2, 31.7175}, {5, 39.3450}});
    check<BlendNormalsUDN>(e, "UDN", false, kFlatBase,
                           {{.1, .0281547}, {.5, 2.47021}, {1, 9.73561}, {2, 21.6246}, {5, 34.2518}});
    check<overlay>(e, "overlay", false, kFlatBase,
                   {{.1, .0281547}, {.5, 2.47021}, {1, 9.73561}, {2, 21.6246}, {5, 34.2518}});
    check<overlay>(e, "overlay", false, kOpposed,
                   {{.1, .567280}, {.5, 11.4341}, {1, 28.6751}, {2, 49.0409}, {5, 69.8003}});
    check<BlendNormalsAverage>(e, "average", true, kCollinear,
                               {{.1, 5.71059}, {.5, 26.5651}, {1, 45}, {2, 63.4349}, {5, 78.6901}});
    check<BlendNormalsDerivative>(e, "derivatives", true, kCollinear,
                                  {{.1, .111254}, {.5, 8.13010}, {1, 26.5651}, {2, 50.9061}, {5, 73.0907}});
    check<BlendNormals>(e, "whiteout", true, kCollinear,
                        {{.1, .0563093}, {.5, 4.94042}, {1, 19.4712}, {2, 43.2493}, {5, 68.5037}});
    check<BlendNormalsAverage>(e, "average", true, kOrthogonal,
                               {{.1, 4.02463}, {.5, 17.4579}, {1, 25.7039}, {2, 30.3667}, {5, 36.0487}});
    check<BlendNormalsDerivative>(e, "derivatives", true, kOrthogonal,
                                  {{.1, .0281547}, {.5, 2.47021}, {1, 9.73561}, {2, 21.6246}, {5, 34.2518}});
    check<BlendNormals>(e, "whiteout", true, kOrthogonal,
                        {{.1, .0281533}, {.5, 2.43189}, {1, 9.23152}, {2, 20.7230}, {5, 33.8905}});
    check<BlendNormals>(e, "whiteout", true, kUnequal,
                        {{.1, .598915}, {.5, 2.43189}, {1, 3.16053}, {2, 3.01538}, {5, 2.61038}});
    check<BlendNormalsUDN>(e, "UDN", true, kUnequal,
                           {{.1, 2.47021}, {.5, 2.47021}, {1, 2.47021}, {2, 2.47021}, {5, 2.47021}});

    e.finding = [](const Rows& rows) {
        const Row &derivatives = rows("derivatives"), &divided = rows("derivatives, divided"), &rnm = rows("RNM"),
                  &plain = rows("RNM, not normalised"), &whiteout = rows("whiteout");
        return "Derivatives are exact for added heights (" + number(derivatives.outcome.error.max, 4) +
               " degrees at most) and RNM for a relief on the base (" + number(rnm.fact("largest to G2"), 4) +
               "); each is far off by the other's measure (" + number(derivatives.fact("RMS to G2"), 1) + " and " +
               number(rnm.outcome.error.rms, 1) +
               " degrees RMS). Whiteout stands between: " + number(whiteout.outcome.error.rms, 1) + " and " +
               number(whiteout.fact("RMS to G2"), 1) + ". Multiplied out, derivatives take " +
               number(derivatives.fastest, 3) + " ns against " + number(divided.fastest, 3) +
               " with divisions. RNM's result is of unit length already: without its "
               "normalize() it takes " +
               number(plain.fastest, 3) + " ns" +
               (plain.fastest < whiteout.fastest ? ", less than whiteout's " : ", whiteout ") +
               number(whiteout.fastest, 3) + ".";
    };
    return e;
}

}  // namespace relief::experiments
