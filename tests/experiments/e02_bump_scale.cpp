// E-02: making the bumps of a normal map deeper or flatter.
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/shading/normals.h"

namespace relief::experiments {

namespace {

// All take a normal's x and y, as a texture stores them (0 to 1), its z, and the scale.
constexpr auto rootAfter = [](Float x, Float y, Float, Float scale) {
    return UnpackScaleNormal(float4(Float(1.0f), y, Float(1.0f), x), scale);
};
constexpr auto storedZ = [](Float x, Float y, Float z, Float scale) {
    return UnpackScaleNormalRGB(float4(x, y, z, Float(1.0f)), scale);
};
constexpr auto slope = [](Float x, Float y, Float, Float scale) {
    const float3 n = UnpackScaleNormal(float4(Float(1.0f), y, Float(1.0f), x), 1.0f);
    return normalize(float3(n.x / n.z * scale, n.y / n.z * scale, Float(1.0f)));
};

// The tilt in degrees that a bump of this tilt gets.
template <class Scaling>
double tiltOf(Scaling scaling, double tilt, double scale)
{
    const auto code = [](double v) { return static_cast<float>(v * 0.5 + 0.5); };
    Columns in;
    for (const float v :
         {code(std::sin(tilt * kRadians)), 0.5f, code(std::cos(tilt * kRadians)), static_cast<float>(scale)}) {
        in.emplace_back(16, v);
    }
    return degreesBetween(vectorAt(evaluate<4>(in, scaling), 0), Vector{0.0, 0.0, 1.0});
}

double trueTilt(double tilt, double scale)
{
    return std::atan(scale * std::tan(tilt * kRadians)) / kRadians;
}

template <class Scaling>
Error errorOf(Scaling scaling, const std::vector<double>& scales, double largestTilt)
{
    ErrorSum sum;
    for (const double scale : scales) {
        for (double tilt = 0.0; tilt <= largestTilt; tilt += 1.0)
            sum.add(tiltOf(scaling, tilt, scale) - trueTilt(tilt, scale));
    }
    return sum.result();
}

template <class Scaling>
void add(Experiment& e, const std::string& name, Scaling scaling, const std::shared_ptr<const Columns>& in)
{
    e.variants.push_back(laneVariant<4>(name, "", in, scaling, [=] {
        return Outcome(errorOf(scaling, {0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}, 85.0),
                       {{"at scale 0.5, to 45 degrees", errorOf(scaling, {0.5}, 45.0).max},
                        {"at scale 2, to 45 degrees", errorOf(scaling, {2.0}, 45.0).max},
                        {"at scale 2, to 10 degrees", errorOf(scaling, {2.0}, 10.0).max}});
    }));
}

}  // namespace

Experiment bumpScale(Effort)
{
    Experiment e;
    e.id = "E-02";
    e.title = "Scaling bumps";
    e.question =
        "A bump scale is to make a height field s times as high: its slopes s times as steep. A map that stores only "
        "x and y scales these and then takes the square root for z; a map that stores z keeps it and normalises; and "
        "one can divide x and y by z, scale, and normalise. Which of them scales slopes?";
    e.item = "decode";
    e.unit = "degrees";
    const auto in = randomColumns({{0.2, 0.8}, {0.2, 0.8}, {0.7, 1.0}, {0.5, 2.0}});
    add(e, "x and y, then the root", rootAfter, in);
    add(e, "x and y, stored z", storedZ, in);
    add(e, "slopes", slope, in);

    struct Reference
    {
        double scale, tilt, exact, root;
    };
    constexpr Reference kReferences[] = {
        {0.25, 10, 2.52406, 2.48811}, {0.25, 30, 8.21321, 7.18076}, {0.25, 45, 14.0362, 10.1821},
        {0.5, 10, 5.03837, 4.98093},  {0.5, 30, 16.1021, 14.4775},  {0.5, 60, 40.8934, 25.6589},
        {2, 5, 9.92499, 10.0386},     {2, 10, 19.4254, 20.3220},    {2, 20, 36.0524, 43.1602},
        {2, 30, 49.1066, 90.0},       {4, 5, 19.2877, 20.4031},     {4, 10, 35.1956, 43.9948}};
    for (const Reference& r : kReferences) {
        const std::string at = ", scale " + number(r.scale, 2) + ", " + number(r.tilt, 0) + " degrees";
        e.checks.push_back({"root" + at, r.root, [=] { return tiltOf(rootAfter, r.tilt, r.scale); }, 2e-3});
        e.checks.push_back({"slopes" + at, r.exact, [=] { return tiltOf(slope, r.tilt, r.scale); }, 1e-3});
        e.checks.push_back({"stored z" + at, r.exact, [=] { return tiltOf(storedZ, r.tilt, r.scale); }, 1e-3});
    }
    // From asin(1 / s) on nothing is left of z.
    for (const auto& [scale, tilt] : {std::pair{2.0, 30.0}, {4.0, 14.4775}, {8.0, 7.18076}}) {
        e.checks.push_back({"root lies flat at scale " + number(scale, 0) + ", " + number(tilt, 4) + " degrees", 90.0,
                            [s = scale, t = tilt] { return tiltOf(rootAfter, t + 1e-4, s); }, 1e-3});
    }
    e.finding = [](const Rows& rows) {
        const Row &root = rows("x and y, then the root"), &stored = rows("x and y, stored z"), &slopes = rows("slopes");
        return "Scaling x and y before the root is right for small bumps only: at scale 2 it is off by " +
               number(root.fact("at scale 2, to 10 degrees"), 2) + " degrees at most up to slopes of 10 degrees, by " +
               number(root.fact("at scale 2, to 45 degrees"), 1) +
               " up to 45, where everything steeper than 30 lies flat. A map with z in it scales slopes exactly (" +
               number(stored.outcome.error.max, 4) + " degrees at most), in " + number(stored.fastest, 3) +
               " ns against " + number(root.fastest, 3) + "; going by slopes from x and y alone takes " +
               number(slopes.fastest, 3) + ".";
    };
    return e;
}

}  // namespace relief::experiments
