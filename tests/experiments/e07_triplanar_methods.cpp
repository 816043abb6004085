// E-07: a bump of one triplanar plane put onto the surface's normal, by every method of the triplanar chapter.
#include <numbers>

#include "common/triplanar_methods.h"
#include "experiments.h"
#include "lane_kernel.h"
#include "relief/shading/triplanar.h"

namespace relief::experiments {

namespace {

using namespace samples::triplanar;

constexpr double kCorner = 54.7356;
constexpr double kTilts[] = {0.0, 15.0, 30.0, 45.0, kCorner}, kSlopes[] = {0.1, 0.5, 1.0};

// The mesh's own tangents, which know nothing of the plane: those of a sphere that runs along its longitudes, seen from
// its pole.
struct MeshTangents
{
    static constexpr const char* kName = "mesh tangents";
    float3 operator()(const float3& surface, const float3& bump) const
    {
        const float3 tangent = normalize(float3(-surface.y, surface.x, 0.0f));
        return tangent * bump.x + cross(surface, tangent) * bump.y + surface * bump.z;
    }
};

Vector cross(const Vector& a, const Vector& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The truths, in doubles, of unit vectors: the surface moved along the projection; moved along its own normal, with the
// map stretched as the projection stretches it; and the map's normal turned as the surface is turned from the plane.
constexpr const char* kTruths[] = {"along projection", "along normal", "rotated"};
Vector truth(int which, const Vector& n, const Vector& bump)
{
    const double hx = -bump.x / bump.z, hy = -bump.y / bump.z;
    if (which == 0) return {n.x / n.z - hx, n.y / n.z - hy, 1.0};
    if (which == 1) {
        const Vector x = cross(n, {0.0, 1.0, -n.y / n.z}), y = cross({1.0, 0.0, -n.x / n.z}, n);
        return {n.x / n.z + x.x * hx + y.x * hy, n.y / n.z + x.y * hx + y.y * hy, 1.0 + x.z * hx + y.z * hy};
    }
    const Vector axis = {-n.y, n.x, 0.0}, turned = cross(axis, bump);
    const double along = (axis.x * bump.x + axis.y * bump.y) / (1.0 + n.z);
    return {bump.x * n.z + turned.x + axis.x * along, bump.y * n.z + turned.y + axis.y * along,
            bump.z * n.z + turned.z};
}

// Surfaces of one tilt and bumps of one slope, towards so many sides each.
struct Cases
{
    std::vector<Vector> surfaces, bumps;
    Columns columns{6};
};

Cases cases(double tilt, double slope, int sides)
{
    Cases all;
    for (int a = 0; a < sides; ++a) {
        for (int b = 0; b < sides; ++b) {
            const double u = 2.0 * std::numbers::pi * a / sides, v = 2.0 * std::numbers::pi * b / sides;
            const double t = tilt * kRadians, length = std::sqrt(1.0 + slope * slope);
            const Vector n = {std::sin(t) * std::cos(u), std::sin(t) * std::sin(u), std::cos(t)};
            const Vector bump = {-slope * std::cos(v) / length, -slope * std::sin(v) / length, 1.0 / length};
            all.surfaces.push_back(n);
            all.bumps.push_back(bump);
            const double numbers[] = {n.x, n.y, n.z, bump.x, bump.y, bump.z};
            for (std::size_t i = 0; i < 6; ++i) all.columns[i].push_back(static_cast<float>(numbers[i]));
        }
    }
    return all;
}

template <class Method>
Columns evaluated(Method method, const Cases& all)
{
    return evaluate<6>(all.columns, [method](Float x, Float y, Float z, Float bx, Float by, Float bz) {
        return method(float3(x, y, z), float3(bx, by, bz));
    });
}

template <class Method>
void addErrors(ErrorSum (&sums)[3], Method method, const Cases& all)
{
    const Columns results = evaluated(method, all);
    for (std::size_t i = 0; i < all.surfaces.size(); ++i) {
        for (int which = 0; which < 3; ++which)
            sums[which].add(degreesBetween(vectorAt(results, i), truth(which, all.surfaces[i], all.bumps[i])));
    }
}

template <class Method>
double largestError(Method method, int which, double tilt)
{
    ErrorSum sums[3];
    for (const double slope : kSlopes) addErrors(sums, method, cases(tilt, slope, 16));
    return sums[which].result().max;
}

template <class Method>
void add(Experiment& e, Method method, int sides, const std::shared_ptr<const Columns>& in)
{
    const auto kernel = [method](Float nx, Float ny, Float nz, Float ax, Float ay, Float az, Float bx, Float by,
                                 Float bz, Float cx, Float cy, Float cz) {
        const float3 normal = normalize(float3(nx, ny, nz));
        return TriplanarNormal({float3(ax, ay, az), float3(bx, by, bz), float3(cx, cy, cz)}, normal,
                               TriplanarBlendPower4(normal), method);
    };
    e.variants.push_back(laneVariant<12>(Method::kName, "", in, kernel, [=] {
        ErrorSum sums[3];
        for (const double tilt : kTilts) {
            for (const double slope : kSlopes) addErrors(sums, method, cases(tilt, slope, sides));
        }
        std::vector<Fact> facts;
        for (int which = 1; which < 3; ++which) {
            facts.push_back({std::string("largest, ") + kTruths[which], sums[which].result().max});
            facts.push_back({std::string("RMS, ") + kTruths[which], sums[which].result().rms});
        }
        facts.push_back({"largest on the plane itself", largestError(method, 0, 0.0)});
        return Outcome(sums[0].result(), facts);
    }));
}

}  // namespace

Experiment triplanarMethods(Effort effort)
{
    Experiment e;
    e.id = "E-07";
    e.title = "Triplanar normals";
    e.question =
        "A triplanar shader has a normal map's bump and the surface's normal, and no tangents. How far is each way of "
        "putting them together from what a bump could mean: the surface moved along the projection (the error shown), "
        "moved along its own normal, or the map turned onto it without any stretch? Surfaces tilted by 0 to 54.7 "
        "degrees, the most that a plane has to serve; slopes 0.1, 0.5 and 1. [4.13](../../triplanar/13_all_methods.md) "
        "draws the methods, and their errors in false colours, on spheres.";
    e.item = "fragment";
    e.unit = "degrees";
    std::vector<ColumnRange> ranges(3, {-1.0, 1.0});
    for (int plane = 0; plane < 3; ++plane) ranges.insert(ranges.end(), {{-0.5, 0.5}, {-0.5, 0.5}, {0.7, 1.0}});
    const auto in = randomColumns(ranges);
    const int sides = effort.samples(64, 16);
    add(e, MeshTangents(), sides, in);
    add(e, Swizzle(), sides, in);
    add(e, Udn(), sides, in);
    add(e, GpuGems3(), sides, in);
    add(e, Whiteout(), sides, in);
    add(e, Reoriented(), sides, in);
    add(e, CrossProducts(), sides, in);
    add(e, CotangentFrame(), sides, in);
    add(e, CotangentGradients(), sides, in);
    add(e, Derivatives(), sides, in);

    const auto atMost = [&e](const std::string& what, std::function<double()> measured) {
        e.checks.push_back({what, 1e-4, std::move(measured), 0.0});
        e.checks.back().isBound = true;
    };
    for (const double tilt : kTilts) {
        const std::string at = " at " + number(tilt, 0) + " degrees";
        atMost("derivatives, along projection," + at, [=] { return largestError(Derivatives(), 0, tilt); });
        atMost("cotangent gradients, along normal," + at, [=] { return largestError(CotangentGradients(), 1, tilt); });
        atMost("RNM, rotated," + at, [=] { return largestError(Reoriented(), 2, tilt); });
        atMost("GPU Gems 3 from UDN," + at, [=] {
            const Cases all = cases(tilt, 0.5, 16);
            const Columns udn = evaluated(Udn(), all), gems = evaluated(GpuGems3(), all);
            ErrorSum sum;
            for (std::size_t i = 0; i < all.bumps.size(); ++i)
                sum.add(degreesBetween(vectorAt(udn, i), vectorAt(gems, i)));
            return sum.result().max;
        });
    }
    const auto exactWhenFlat = [&](auto method) {
        atMost(method.kName + std::string(" on the plane itself"), [=] { return largestError(method, 0, 0.0); });
    };
    exactWhenFlat(Swizzle());
    exactWhenFlat(Whiteout());
    exactWhenFlat(Reoriented());
    exactWhenFlat(CrossProducts());
    exactWhenFlat(CotangentFrame());

    e.finding = [](const Rows& rows) {
        const Row &whiteout = rows("whiteout"), &rnm = rows("RNM"), &derivatives = rows("derivatives"),
                  &udn = rows("UDN"), &gradients = rows("cotangent gradients");
        const auto rms = [](const Row& row) { return number(row.outcome.error.rms, 2); };
        const auto ns = [](const Row& row) { return number(row.fastest, 2) + " ns"; };
        return "There is no right method without saying what a bump means: derivatives are exact for heights along the "
               "projection, cotangent gradients for heights along the surface's normal, RNM for a map turned onto it "
               "(" +
               ns(derivatives) + ", " + ns(gradients) + " and " + ns(rnm) +
               "); held to the first truth, RNM is "
               "off by " +
               rms(rnm) + " degrees RMS. Whiteout (" + ns(whiteout) + ") is off by " + rms(whiteout) + ", UDN (" +
               ns(udn) + ") by " + rms(udn) + ", and UDN is wrong even on a flat plane, by up to " +
               number(udn.fact("largest on the plane itself"), 1) +
               " degrees. The mesh's own tangents are wrong by up "
               "to " +
               number(rows("mesh tangents").outcome.error.max, 0) + ".";
    };
    return e;
}

}  // namespace relief::experiments
