// E-01: the z of a normal whose x and y are in a texture.
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"

namespace relief::experiments {

namespace {

constexpr auto root = [](Float x, Float y) { return float3(x, y, sqrt(1.0f - saturate(x * x + y * y))); };
constexpr auto oneMinusHalf = [](Float x, Float y) { return float3(x, y, 1.0f - (x * x + y * y) * 0.5f); };
constexpr auto one = [](Float x, Float y) { return float3(x, y, Float(1.0f)); };

// Normals of tilts 0 to `largest` degrees, towards 16 sides, and the x and y that are stored of them.
struct Normals
{
    Columns stored{2};
    std::vector<Vector> exact;
    std::vector<double> weights;  // the solid angle that a normal stands for
};

Normals normals(double largest, int steps, int levels)
{
    Normals all;
    const auto store = [levels](double v) {
        if (levels == 0) return static_cast<float>(v);
        const float code = static_cast<float>(std::floor((v * 0.5 + 0.5) * levels + 0.5)) / static_cast<float>(levels);
        return code * 2.0f - 1.0f;
    };
    for (int step = 0; step <= steps; ++step) {
        const double tilt = largest * step / steps * kRadians;
        for (int side = 0; side < 16; ++side) {
            const double azimuth = (side + 0.3) * std::numbers::pi / 8.0;
            const Vector n = {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
            all.exact.push_back(n);
            all.weights.push_back(std::sin(tilt));
            all.stored[0].push_back(store(n.x));
            all.stored[1].push_back(store(n.y));
        }
    }
    return all;
}

template <class Decode>
Error errorOf(Decode decode, double largestTilt, int steps, int levels)
{
    const Normals all = normals(largestTilt, steps, levels);
    const Columns decoded = evaluate<2>(all.stored, decode);
    ErrorSum sum;
    for (std::size_t i = 0; i < all.exact.size(); ++i) {
        sum.add(degreesBetween(vectorAt(decoded, i), all.exact[i]), all.weights[i]);
    }
    return sum.result();
}

// Of one normal of this tilt, in degrees of tilt.
template <class Decode>
double decodedTilt(Decode decode, double tilt)
{
    const Columns stored = {std::vector<float>(16, static_cast<float>(std::sin(tilt * kRadians))),
                            std::vector<float>(16, 0.0f)};
    return degreesBetween(vectorAt(evaluate<2>(stored, decode), 0), Vector{0.0, 0.0, 1.0});
}

template <class Decode>
void add(Experiment& e, const std::string& name, Decode decode, Effort effort, const std::shared_ptr<const Columns>& in)
{
    const int steps = effort.samples(3600, 180);
    const auto outcome = [=] {
        const double at30 = std::abs(decodedTilt(decode, 30.0) - 30.0);
        return Outcome(errorOf(decode, 90.0, steps, 0),
                       {{"degrees at 30", at30},
                        {"Lambert codes at 30", 255.0 * std::sin(at30 * kRadians)},
                        {"worst to 45, 8 bits", errorOf(decode, 45.0, steps, 255).max}});
    };
    e.variants.push_back(laneVariant<2>(name, "", in, decode, outcome));
    const auto normalized = [decode](Float x, Float y) { return normalize(decode(x, y)); };
    e.variants.push_back(laneVariant<2>(name, "normalised", in, normalized, outcome));
}

}  // namespace

Experiment zDecode(Effort effort)
{
    Experiment e;
    e.id = "E-01";
    e.title = "The z of a stored normal";
    e.question =
        "A normal map stores x and y; z follows from the length 1. The tutorials offer a square root, 1 - (x² + y²) / "
        "2, and simply 1. How wrong are the two short cuts, and are they faster? Their result is not of length 1, so a "
        "shader that needs a unit vector pays for a normalize() that the root does not need.";
    e.item = "decode";
    e.unit = "degrees";
    const auto in = randomColumns({{-0.7, 0.7}, {-0.7, 0.7}});
    add(e, "root", root, effort, in);
    add(e, "1 - d/2", oneMinusHalf, effort, in);
    add(e, "1", one, effort, in);

    struct Reference
    {
        double tilt, oneMinusHalf, one;
    };
    constexpr Reference kReferences[] = {{5, 4.99996, 4.98107},  {10, 9.99885, 9.85108}, {20, 19.9644, 18.8817},
                                         {30, 29.7449, 26.5651}, {45, 43.3139, 35.2644}, {60, 54.1825, 40.8934},
                                         {75, 61.0875, 44.0070}, {80, 62.3894, 44.5615}, {85, 63.1733, 44.8908},
                                         {89, 63.4245, 44.9956}, {90, 63.4349, 45.0}};
    for (const Reference& r : kReferences) {
        const std::string at = " at " + std::to_string(static_cast<int>(r.tilt)) + " degrees";
        e.checks.push_back({"1 - d/2" + at, r.oneMinusHalf, [=] { return decodedTilt(oneMinusHalf, r.tilt); }, 1e-3});
        e.checks.push_back({"1" + at, r.one, [=] { return decodedTilt(one, r.tilt); }, 1e-3});
        if (r.tilt < 89) e.checks.push_back({"root" + at, r.tilt, [=] { return decodedTilt(root, r.tilt); }, 1e-3});
    }
    e.finding = [](const Rows& rows) {
        const Row &exact = rows("root"), &half = rows("1 - d/2", "normalised"), &flat = rows("1", "normalised");
        return "z = 1 bends a slope of 30 degrees by " + number(flat.fact("degrees at 30"), 3) + " degrees, " +
               number(flat.fact("Lambert codes at 30"), 1) + " of 255 codes of brightness; 1 - d/2 by " +
               number(half.fact("degrees at 30"), 3) + ". Unnormalised they are faster than the root (" +
               number(rows("1 - d/2").fastest, 3) + " and " + number(rows("1").fastest, 3) + " ns against " +
               number(exact.fastest, 3) + "); of unit length, as the root is without more ado, they take " +
               number(half.fastest, 3) + " and " + number(flat.fastest, 3) + " ns.";
    };
    return e;
}

}  // namespace relief::experiments
