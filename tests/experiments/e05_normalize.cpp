// E-05: what the normalize() after bumping is for, and how exact it has to be.
#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"
#include "rsqrt_estimate.h"

namespace relief::experiments {

namespace {

// Lambert's term and a highlight, (N.H)^exponent, of a normal that is made unit length in some way.
template <class Normalize>
auto lit(Normalize makeUnit)
{
    return [=](Float x, Float y, Float z) {
        const float3 n = makeUnit(float3(x, y, z));
        // The light stands to the side, the half vector straight above.
        return float2(saturate(n.x * 0.6f + n.z * 0.8f), saturate(n.z));
    };
}

// Interpolated and bumped normals: lengths 0.8 to 1.1, tilted up to 25 degrees.
std::shared_ptr<const Columns> bumps(std::size_t count)
{
    auto columns = std::make_shared<Columns>(3);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < count; ++i) {
        const double tilt = std::sqrt(uniform(random)) * 25.0 * kRadians,
                     side = uniform(random) * 2.0 * std::numbers::pi;
        const double length = 0.8 + 0.3 * uniform(random);
        const double n[3] = {length * std::sin(tilt) * std::cos(side), length * std::sin(tilt) * std::sin(side),
                             length * std::cos(tilt)};
        for (std::size_t k = 0; k < 3; ++k) (*columns)[k].push_back(static_cast<float>(n[k]));
    }
    return columns;
}

template <class Normalize>
Outcome outcome(Normalize makeUnit, std::size_t count)
{
    const auto columns = bumps(count);
    const Columns results = evaluate<3>(*columns, lit(makeUnit));
    constexpr double kExponents[] = {10.0, 100.0, 1000.0, 10000.0};
    ErrorSum lambert, highlight[4];
    for (std::size_t i = 0; i < count; ++i) {
        const Vector n = vectorAt(*columns, i);
        const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        lambert.add(255.0 * (results[0][i] - std::fmax(0.0, (n.x * 0.6 + n.z * 0.8) / length)));
        for (int k = 0; k < 4; ++k) {
            highlight[k].add(255.0 * (std::pow(static_cast<double>(results[1][i]), kExponents[k]) -
                                      std::pow(n.z / length, kExponents[k])));
        }
    }
    Outcome all(lambert.result());
    for (int k = 0; k < 4; ++k)
        all.facts.push_back({"highlight, exponent " + number(kExponents[k], 0), highlight[k].result().max});
    return all;
}

template <class Normalize>
void add(Experiment& e, const std::string& name, Normalize makeUnit, const std::shared_ptr<const Columns>& in,
         Effort effort)
{
    const auto count = static_cast<std::size_t>(effort.samples(1 << 18, 1 << 12));
    e.variants.push_back(laneVariant<3>(name, "", in, lit(makeUnit), [=] { return outcome(makeUnit, count); }));
}

}  // namespace

Experiment normalizing(Effort effort)
{
    Experiment e;
    e.id = "E-05";
    e.title = "The normalize() after bumping";
    e.question =
        "Interpolated and bumped normals are 0.8 to 1.1 long. What happens without normalize(), and with the "
        "processor's quick estimate of 1 / sqrt, bare or refined by one step of Newton's method? The engine has "
        "neither: the estimate's last bits differ between processors. Errors are in codes of 255: of Lambert's term "
        "here, and at most of a highlight (N.H)^n in the columns.";
    e.item = "fragment";
    e.unit = "codes of 255";
    const auto in = bumps(kStreamedItems);
    add(
        e, "normalize()", [](const float3& n) { return normalize(n); }, in, effort);
    add(
        e, "estimate", [](const float3& n) { return n * rsqrtEstimate(dot(n, n)); }, in, effort);
    add(
        e, "estimate, one step", [](const float3& n) { return n * rsqrtRefined(dot(n, n)); }, in, effort);
    add(
        e, "none", [](const float3& n) { return n; }, in, effort);

    // A relative error of e in N.H is one of (1 + e)^n in the highlight: the documented 1.5 * 2^-12 of the estimate,
    // where the highlight is at its brightest.
    for (const double exponent : {10.0, 100.0, 1000.0}) {
        e.checks.push_back({"estimate: highlight, exponent " + number(exponent, 0),
                            255.0 * (std::pow(1.0 + 1.5 / 4096.0, exponent) - 1.0),
                            [=] {
                                const auto estimate = [](const float3& n) { return n * rsqrtEstimate(dot(n, n)); };
                                const Outcome o = outcome(estimate, 1 << 14);
                                return o.facts[exponent == 10.0 ? 0 : exponent == 100.0 ? 1 : 2].value;
                            },
                            0.0, true});
    }
    e.finding = [](const Rows& rows) {
        const Row &exact = rows("normalize()"), &estimate = rows("estimate"), &refined = rows("estimate, one step"),
                  &none = rows("none");
        const auto times = [](const Row& row) {
            return number(row.fastest, 2) + " ns (" + number(row.streaming.value_or(NAN), 2) + " streaming)";
        };
        return "Without normalize() a bumped surface is lit wrongly by up to " + number(none.outcome.error.max, 0) +
               " codes. The estimate is good enough for diffuse light (" + number(estimate.outcome.error.max, 2) +
               " codes), not for tight highlights: up to " + number(estimate.fact("highlight, exponent 1000"), 0) +
               " codes at exponent 1000; one step of Newton's method brings that to " +
               number(refined.fact("highlight, exponent 1000"), 2) + ". The times: exact " + times(exact) +
               ", estimate " + times(estimate) + ", refined " + times(refined) + ".";
    };
    return e;
}

}  // namespace relief::experiments
