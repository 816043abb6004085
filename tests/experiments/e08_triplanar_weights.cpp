// E-08: how a triplanar shader weighs its three planes.
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/shading/triplanar.h"

namespace relief::experiments {

namespace {

const double kCorner = 1.0 / std::sqrt(3.0);

// Normals evenly spread over the sphere, and heights of the three planes' textures.
Columns directions(int count)
{
    Columns all = *randomColumns({{0, 0}, {0, 0}, {0, 0}, {0, 1}, {0, 1}, {0, 1}}, static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double y = 1.0 - (2.0 * i + 1.0) / count, around = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
        const double radius = std::sqrt(1.0 - y * y);
        const double n[] = {radius * std::cos(around), y, radius * std::sin(around)};
        for (std::size_t c = 0; c < 3; ++c) all[c][static_cast<std::size_t>(i)] = static_cast<float>(n[c]);
    }
    return all;
}

// As TriplanarBlendOffset, without its limit of 0.55.
float3 offsetWithoutLimit(const float3& normal, Float offset)
{
    const float3 rest = max(abs(normal) - offset, float3(0.0f));
    return rest / (rest.x + rest.y + rest.z);
}

template <class Weights>
Columns evaluated(Weights weights, const Columns& in)
{
    return evaluate<6>(in, [weights](Float x, Float y, Float z, Float a, Float b, Float c) {
        return weights(float3(x, y, z), float3(a, b, c));
    });
}

template <class Weights>
Vector weightsAt(Weights weights, double x, double y, double z)
{
    Columns in(6, std::vector<float>(16, 0.5f));
    const double n[] = {x, y, z};
    for (std::size_t c = 0; c < 3; ++c) in[c].assign(16, static_cast<float>(n[c]));
    return vectorAt(evaluated(weights, in), 0);
}

// How much x's weight changes per unit of x in the corner, where all three are equal.
template <class Weights>
double slopeInCorner(Weights weights, double step)
{
    const auto at = [&](double x) { return weightsAt(weights, x, kCorner, kCorner).x; };
    return (at(kCorner + step) - at(kCorner - step)) / (2.0 * step);
}

// Over how many degrees a side's weight goes from 0.1 to 0.9, from the side x towards the side z.
template <class Weights>
double blendWidth(Weights weights)
{
    int within = 0;
    constexpr int steps = 1440;
    for (int i = 0; i <= steps; ++i) {
        const double angle = 90.0 * i / steps / kDegrees;
        const double w = weightsAt(weights, std::sin(angle), 0.0, std::cos(angle)).x;
        within += w > 0.1 && w < 0.9;
    }
    return 90.0 * within / steps;
}

// How far from the planes' sharp borders: the plane that faces most has weight 1, the others 0.
template <class Weights>
Outcome outcome(Weights weights, int count)
{
    const Columns in = directions(count), out = evaluated(weights, in);
    ErrorSum sum;
    double planes = 0.0, sumError = 0.0;
    for (std::size_t i = 0; i < in[0].size(); ++i) {
        double largest = 0.0, total = 0.0;
        for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(static_cast<double>(in[c][i])));
        double error = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double w = out[c][i], ideal = std::abs(static_cast<double>(in[c][i])) == largest ? 1.0 : 0.0;
            error = std::max(error, std::abs(w - ideal));
            total += w;
            planes += w > 0.0;
        }
        sum.add(error);
        sumError = std::max(sumError, std::abs(total - 1.0));
    }
    return Outcome(sum.result(), {{"fetches", planes / count},
                                  {"width in degrees", blendWidth(weights)},
                                  {"change per 1/255 in the corner", slopeInCorner(weights, 1e-4) / 255.0},
                                  {"largest |sum - 1|", sumError}});
}

template <class Weights>
void add(Experiment& e, const std::string& name, Weights weights, Effort effort,
         const std::shared_ptr<const Columns>& in)
{
    const int count = effort.samples(1 << 16, 1 << 12);
    const auto kernel = [weights](Float x, Float y, Float z, Float a, Float b, Float c) {
        return weights(float3(x, y, z), float3(a, b, c));
    };
    e.variants.push_back(laneVariant<6>(name, "", in, kernel, [=] { return outcome(weights, count); }));
}

}  // namespace

Experiment triplanarWeights(Effort effort)
{
    Experiment e;
    e.id = "E-08";
    e.title = "Triplanar weights";
    e.question =
        "How to mix the three planes: softly, which shows two or three pictures at once nearly everywhere, or "
        "sharply, which shows borders? The error is the distance from the sharpest mix, each point to the plane that "
        "it faces most. A plane without weight is not fetched; and in the corner, where all three are equal, a sharp "
        "mix turns the noise of an 8-bit normal into noise of the weights.";
    e.item = "fragment";
    e.unit = "weight";
    const auto in = std::make_shared<const Columns>(directions(static_cast<int>(kStreamedItems)));
    add(
        e, "linear", [](float3 n, float3) { return TriplanarBlendLinear(n); }, effort, in);
    add(
        e, "offset 0.2", [](float3 n, float3) { return TriplanarBlendOffset(n, 0.2f); }, effort, in);
    add(
        e, "offset 0.5", [](float3 n, float3) { return TriplanarBlendOffset(n, 0.5f); }, effort, in);
    add(
        e, "offset 0.55", [](float3 n, float3) { return TriplanarBlendOffset(n, 0.55f); }, effort, in);
    add(
        e, "offset 0.57", [](float3 n, float3) { return offsetWithoutLimit(n, 0.57f); }, effort, in);
    add(
        e, "power 4", [](float3 n, float3) { return TriplanarBlendPower4(n); }, effort, in);
    add(
        e, "power 8", [](float3 n, float3) { return TriplanarBlendPower(n, 8.0f); }, effort, in);
    add(
        e, "power 64", [](float3 n, float3) { return TriplanarBlendPower(n, 64.0f); }, effort, in);
    add(
        e, "asymmetric", [](float3 n, float3) { return TriplanarBlendAsymmetric(n); }, effort, in);
    add(
        e, "height", [](float3 n, float3 h) { return TriplanarBlendHeight(n, h, 0.2f); }, effort, in);

    struct Reference
    {
        double offset, residual, slope;
    };
    constexpr Reference kReferences[] = {{.2, .377350, .588902},
                                         {.5, .0773503, 2.87293},
                                         {.55, .0273503, 8.12504},
                                         {.57, .00735027, 30.2332},
                                         {.577, 3.50269e-4, 634.433}};
    for (const Reference& r : kReferences) {
        const auto offset = static_cast<float>(r.offset);
        const double step = 0.03 * r.residual;  // a float's rounding is 6e-8 of it, the curve's bend 1e-3
        const double tolerance = r.slope * (2e-3 + 4e-6 / r.residual);
        e.checks.push_back(
            {"without limit, change per unit in the corner, offset " + number(r.offset, 3), r.slope,
             [=] { return slopeInCorner([=](float3 n, float3) { return offsetWithoutLimit(n, offset); }, step); },
             tolerance});
        if (r.offset > 0.55) continue;
        e.checks.push_back(
            {"change per unit in the corner, offset " + number(r.offset, 2), r.slope,
             [=] { return slopeInCorner([=](float3 n, float3) { return TriplanarBlendOffset(n, offset); }, step); },
             tolerance});
    }
    const auto beyond = [](float3 n, float3) { return offsetWithoutLimit(n, 0.58f); };
    e.checks.push_back({"without limit, offset 0.58: NaN in the corner", 1.0,
                        [=] { return std::isnan(weightsAt(beyond, kCorner, kCorner, kCorner).x) ? 1.0 : 0.0; }, 0.0});
    const auto limited = [](float3 n, float3) { return TriplanarBlendOffset(n, 0.58f); };
    e.checks.push_back({"offset 0.58, limited: a third in the corner", 1.0 / 3.0,
                        [=] { return weightsAt(limited, kCorner, kCorner, kCorner).x; }, 1e-5});
    const auto asymmetric = [](float3 n, float3) { return TriplanarBlendAsymmetric(n); };
    const auto top = [=](double y) { return weightsAt(asymmetric, std::sqrt(1.0 - y * y), y, 0.0).y; };
    e.checks.push_back(
        {"asymmetric, the top's weight where it begins, at 0.675", 0.0, [=] { return top(0.675); }, 1e-5});
    e.checks.push_back({"asymmetric, where it has all, at 0.6875", 1.0, [=] { return top(0.6875); }, 1e-5});
    e.checks.push_back({"asymmetric, each of two sides at 45 degrees", 0.5,
                        [=] { return weightsAt(asymmetric, 1.0, 0.0, 1.0).x; }, 1e-5});

    e.finding = [](const Rows& rows) {
        const Row &linear = rows("linear"), &offset = rows("offset 0.5"), &power = rows("power 4"),
                  &sharp = rows("power 64"), &noisy = rows("offset 0.57");
        const auto of = [](const Row& row, const char* name, int digits) { return number(row.fact(name), digits); };
        return "Linear weights fetch " + of(linear, "fetches", 2) + " planes a fragment; power 4 blends over " +
               of(power, "width in degrees", 0) + " degrees instead of " + of(linear, "width in degrees", 0) +
               " and fetches as many (" + of(power, "fetches", 2) +
               "), because a power is hardly ever 0. What becomes exactly 0 saves fetches: an offset of 0.5 blends "
               "over " +
               of(offset, "width in degrees", 0) + " degrees with " + of(offset, "fetches", 2) +
               ", the asymmetric mix over " + of(rows("asymmetric"), "width in degrees", 0) + " with " +
               of(rows("asymmetric"), "fetches", 2) + ". The offset takes " + number(offset.fastest, 2) +
               " ns, power 4 " + number(power.fastest, 2) + " and power 64 " + number(sharp.fastest, 2) +
               ". Beyond 0.55 an offset makes the corners noisy: at 0.57 one code of the normal changes a weight by " +
               of(noisy, "change per 1/255 in the corner", 2) + ".";
    };
    return e;
}

}  // namespace relief::experiments
