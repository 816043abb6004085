// Triplanar mapping: weights (stability cases S-701 to S-709), the methods against surfaces that are moved in double
// (T-05), and signs: six sides, both handednesses, both kinds of normal map (S-713).
#include "relief/shading/triplanar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/triplanar_methods.h"
#include "numbers.h"
#include "shading_fixture.h"

using namespace fixture;
using namespace relief::samples::triplanar;

namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

// Directions all over the sphere, the axes, the corners and the diagonals among them.
std::vector<glm::vec3> directions()
{
    std::vector<glm::vec3> all;
    for (int x = -8; x <= 8; ++x) {
        for (int y = -8; y <= 8; ++y) {
            for (int z = -8; z <= 8; ++z) {
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != 8) continue;
                const glm::dvec3 d(x, y, z);
                all.push_back(glm::vec3(d / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
            }
        }
    }
    return all;
}

float3 of(const glm::vec3& v)
{
    return broadcast(v);
}

// Every weight function, the height blend with some heights.
std::vector<float3> allWeights(const float3& n)
{
    return {TriplanarBlendLinear(n),
            TriplanarBlendOffset(n, 0.2f),
            TriplanarBlendOffset(n, 0.55f),
            TriplanarBlendPower4(n),
            TriplanarBlendPower(n, 8.0f),
            TriplanarBlendPower(n, 64.0f),
            TriplanarBlendAsymmetric(n),
            TriplanarBlendHeight(n, float3(0.3f, 0.9f, 0.5f), 0.2f),
            TriplanarBlendHeight(n, float3(1.0f, 1.0f, 1.0f), 0.01f)};
}

bool isPartition(const float3& weights)
{
    const Vector w = lane(weights);
    const auto inRange = [](double x) { return x >= 0.0 && x <= 1.0; };
    measured("sum off 1", std::abs(w.x + w.y + w.z - 1.0), 3.0 * 0x1p-24);
    return inRange(w.x) && inRange(w.y) && inRange(w.z) && std::abs(w.x + w.y + w.z - 1.0) <= 3.0 * 0x1p-24;
}

bool isExactly(const float3& v, float x, float y, float z)
{
    return v.x[0] == x && v.y[0] == y && v.z[0] == z;
}

// --- T-05's plane, in double ---

struct Case
{
    Vector surface, bump;  // of unit length
    double fx, fy;         // the plane z = fx x + fy y
    double hx, hy;         // the height map's slopes
};

std::vector<Case> cases(double tiltDegrees, double slope)
{
    std::vector<Case> all;
    const double t = tiltDegrees / kDegrees;
    for (int a = 0; a < 64; ++a) {
        for (int b = 0; b < 64; ++b) {
            const double u = a * 2.0 / 64 * 180.0 / kDegrees, v = b * 2.0 / 64 * 180.0 / kDegrees;
            const Vector n = {std::sin(t) * std::cos(u), std::sin(t) * std::sin(u), std::cos(t)};
            const double hx = slope * std::cos(v), hy = slope * std::sin(v);
            all.push_back({n, unit({-hx, -hy, 1.0}), -n.x / n.z, -n.y / n.z, hx, hy});
        }
    }
    return all;
}

// The normal of a surface that is given as a function (x, y) -> point, by central differences about the origin.
template <class Surface>
Vector normalOf(Surface surface)
{
    const double e = 1e-5;
    const Vector a = surface(e, 0.0), b = surface(-e, 0.0), c = surface(0.0, e), d = surface(0.0, -e);
    const Vector x = {a.x - b.x, a.y - b.y, a.z - b.z}, y = {c.x - d.x, c.y - d.y, c.z - d.z};
    return {x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x};
}

// Heights added along the projection.
Vector alongProjection(const Case& c)
{
    return normalOf([&](double x, double y) { return Vector{x, y, c.fx * x + c.fy * y + c.hx * x + c.hy * y}; });
}

// Heights added along the surface's normal.
Vector alongNormal(const Case& c)
{
    return normalOf([&](double x, double y) {
        const double h = c.hx * x + c.hy * y;
        return Vector{x + h * c.surface.x, y + h * c.surface.y, c.fx * x + c.fy * y + h * c.surface.z};
    });
}

// Turned about the axis that is perpendicular to z and the surface's normal, by the angle between them.
Vector rotated(const Case& c)
{
    const double tilt = std::acos(std::min(c.surface.z, 1.0));
    const double across = std::sqrt(c.surface.x * c.surface.x + c.surface.y * c.surface.y);
    if (across == 0.0) return c.bump;
    const double kx = -c.surface.y / across, ky = c.surface.x / across;
    const double along = kx * c.bump.x + ky * c.bump.y;
    const double cosine = std::cos(tilt), sine = std::sin(tilt);
    return {c.bump.x * cosine + ky * c.bump.z * sine + kx * along * (1 - cosine),
            c.bump.y * cosine - kx * c.bump.z * sine + ky * along * (1 - cosine),
            c.bump.z * cosine + (kx * c.bump.y - ky * c.bump.x) * sine};
}

float3 single(const Vector& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The largest angle between a method and a truth, over all of T-05.
template <class Method, class Truth>
double largestAngle(Method method, Truth truth)
{
    double largest = 0.0;
    for (const double tilt : {0.0, 30.0, 45.0, 54.7356}) {
        for (const double slope : {0.1, 0.5, 1.0}) {
            for (const Case& c : cases(tilt, slope)) {
                largest = std::max(largest, angle(lane(method(single(c.surface), single(c.bump))), truth(c)));
            }
        }
    }
    return largest;
}

// What is off by `degrees` where the surface faces along the projection.
template <class Method>
double largestWhenFlat(Method method, double slope)
{
    double largest = 0.0;
    for (const Case& c : cases(0.0, slope)) {
        largest = std::max(largest, angle(lane(method(float3(0, 0, 1), single(c.bump))), c.bump));
    }
    return largest;
}

}  // namespace

TEST_CASE("triplanar: S-701 a normal that is zero, not a number or infinite belongs to the ground plane")
{
    for (const float bad : {0.0f, -0.0f, kNan, kInfinity, -kInfinity}) {
        for (const float3& weights : allWeights(float3(bad, bad, bad))) CHECK(isExactly(weights, 0.0f, 1.0f, 0.0f));
    }
    for (const glm::vec3& n : {glm::vec3(kNan, 0.6f, 0.8f), glm::vec3(0.6f, kNan, 0.8f), glm::vec3(0.6f, 0.8f, kNan),
                               glm::vec3(1e-30f, 0.0f, 0.0f), glm::vec3(1e30f, 1e30f, 0.0f)}) {
        for (const float3& weights : allWeights(of(n))) CHECK(isPartition(weights));
    }
}

TEST_CASE("triplanar: S-702 in the corners no offset leaves nothing")
{
    const float corner = 0.57735026f;
    for (const float offset : {0.0f, 0.2f, 0.5f, 0.55f, 0.57f, 0.577f, 0.58f, 1.0f, 1e30f, kInfinity, kNan, -1.0f}) {
        for (const float sign : {1.0f, -1.0f}) {
            const float3 weights = TriplanarBlendOffset(float3(corner, sign * corner, -corner), offset);
            CHECK(isPartition(weights));
            measured("weight off 1/3", std::abs(static_cast<double>(weights.x[0]) - 1.0 / 3.0), 1e-5);
        }
    }
    // The limit is 0.55, whatever more is asked for.
    for (const float offset : {0.56f, 0.57f, 1.0f}) {
        const float3 normal = {0.6f, 0.56f, -0.57f};
        const float3 limited = TriplanarBlendOffset(normal, 0.55f), weights = TriplanarBlendOffset(normal, offset);
        for (int plane = 0; plane < 3; ++plane) CHECK(weights[plane][0] == limited[plane][0]);
    }
    // A normal that interpolation has made short falls back on linear weights.
    CHECK(isPartition(TriplanarBlendOffset(float3(0.3f, 0.3f, 0.2f), 0.5f)));
    CHECK(TriplanarBlendOffset(float3(0.3f, 0.3f, 0.2f), 0.5f).z[0] == 0.25f);
}

TEST_CASE("triplanar: T-05b how fast the weights change in a corner, by the offset")
{
    // dw/dn = 2 / (9 r), r = 1 / sqrt(3) - k, by differences in double-sized steps.
    for (const auto& [k, slope] : {std::array{0.2, 0.588902}, std::array{0.5, 2.87293}, std::array{0.55, 8.12504}}) {
        const double c = 1.0 / std::sqrt(3.0), e = 0.002;
        const auto weight = [k = k](double x, double y, double z) {
            return static_cast<double>(TriplanarBlendOffset(single({x, y, z}), static_cast<float>(k)).x[0]);
        };
        CHECK((weight(c + e, c, c) - weight(c - e, c, c)) / (2 * e) == doctest::Approx(slope).epsilon(0.02));
    }
}

TEST_CASE("triplanar: S-703 all weights are a partition of unity, for all directions")
{
    for (const glm::vec3& n : directions()) {
        for (const float3& weights : allWeights(of(n))) REQUIRE(isPartition(weights));
    }
}

TEST_CASE("triplanar: S-704 high powers do not underflow")
{
    for (const float power : {1.0f, 4.0f, 64.0f, 128.0f, 1e30f}) {
        for (const glm::vec3& n : directions()) {
            const float3 weights = TriplanarBlendPower(of(n * 0.1f), power);
            REQUIRE(isPartition(weights));
            const Vector w = lane(weights);
            CHECK(std::max({w.x, w.y, w.z}) >= 1.0 / 3.0 - 1e-7);
        }
    }
    const float third = 1.0f / 3.0f;
    CHECK(isExactly(TriplanarBlendPower(float3(0.1f, -0.1f, 0.1f), 128.0f), third, third, third));
}

TEST_CASE("triplanar: S-705 the sign of zero is plus, of either zero, and nothing jumps there")
{
    CHECK(isExactly(axisSign(float3(0.0f, -0.0f, -1e-30f)), 1.0f, 1.0f, -1.0f));
    const Triplanar<float3> bumps = {float3(0.3f, 0.2f, 0.9f), float3(-0.1f, 0.4f, 0.9f), float3(0.2f, -0.3f, 0.9f)};
    const auto normalAt = [&](float x) {
        const float3 n = normalize(float3(x, 0.8f, 0.6f));
        return lane(TriplanarNormal(bumps, n, TriplanarBlendOffset(n, 0.2f), Whiteout()));
    };
    measured("degrees across 0", angle(normalAt(1e-7f), normalAt(-1e-7f)), 1e-4);
    CHECK(angle(normalAt(0.0f), normalAt(-0.0f)) == 0.0);
}

TEST_CASE("triplanar: S-706 weights do not depend on the side")
{
    for (const glm::vec3& n : directions()) {
        const std::vector<float3> front = allWeights(of(n)), back = allWeights(of(-n));
        for (std::size_t i = 0; i < front.size(); ++i) REQUIRE(sameBits(front[i], back[i]));
    }
}

TEST_CASE("triplanar: S-708 the asymmetric blend on the axes, and where its ramp begins and ends")
{
    CHECK(isExactly(TriplanarBlendAsymmetric(float3(0, 1, 0)), 0, 1, 0));
    CHECK(isExactly(TriplanarBlendAsymmetric(float3(0, -1, 0)), 0, 1, 0));
    CHECK(isExactly(TriplanarBlendAsymmetric(float3(1, 0, 0)), 1, 0, 0));
    CHECK(isExactly(TriplanarBlendAsymmetric(float3(0, 0, -1)), 0, 0, 1));
    CHECK(isExactly(TriplanarBlendAsymmetric(float3(0.6f, 0.674f, 0.1f)), 1, 0, 0));
    CHECK(TriplanarBlendAsymmetric(float3(0.6f, 0.688f, 0.3f)).y[0] == 1.0f);
    CHECK(TriplanarBlendAsymmetric(float3(0.5f, 0.0f, -0.5f)).x[0] == 0.5f);
}

TEST_CASE("triplanar: S-709 the height blend with any range and any heights")
{
    const float3 n = {0.6f, 0.0f, 0.8f};
    for (const float range : {0.0f, 1e-30f, -1.0f, 0.01f, 1.0f, 1e30f, kInfinity, kNan}) {
        for (const float height : {0.0f, 0.5f, 1e30f, -1e30f, kNan, kInfinity}) {
            CHECK(isPartition(TriplanarBlendHeight(n, float3(height, height, height), range)));
            CHECK(isPartition(TriplanarBlendHeight(n, float3(height, 0.0f, 1.0f), range)));
        }
    }
    // The higher texel wins over a little more of the normal; with a large range both show.
    const float3 even = normalize(float3(1.0f, 0.0f, 1.0f));
    CHECK(isExactly(TriplanarBlendHeight(even, float3(1.0f, 0.0f, 0.0f), 0.01f), 1, 0, 0));
    CHECK(TriplanarBlendHeight(even, float3(0.6f, 0.0f, 0.5f), 1.0f).z[0] > 0.4f);
}

TEST_CASE("triplanar: the factor 7 of the old formula changes nothing but the last bit")
{
    double largest = 0.0;
    for (const glm::vec3& n : directions()) {
        const float3 a = TriplanarBlendOffset(of(n), 0.2f);
        float3 b = max((abs(of(n)) - 0.2f) * 7.0f, float3(0.0f));
        b /= b.x + b.y + b.z;
        const Vector p = lane(a), q = lane(b);
        largest = std::max({largest, std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
    }
    CHECK(largest <= 2.0 * 0x1p-24);
}

TEST_CASE("triplanar: T-05 the three truths are those of surfaces that are moved or turned in double")
{
    CHECK(largestAngle(AlongProjection(), alongProjection) <= 1e-4);
    CHECK(largestAngle(AlongNormal(), alongNormal) <= 1e-4);
    CHECK(largestAngle(Rotated(), rotated) <= 1e-4);
}

TEST_CASE("triplanar: T-05 identities: derivatives, cotangent gradients and RNM are one truth each")
{
    CHECK(largestAngle(Derivatives(), alongProjection) <= 1e-4);
    CHECK(largestAngle(CotangentGradients(), alongNormal) <= 1e-4);
    CHECK(largestAngle(Reoriented(), rotated) <= 1e-4);
    // And none of the others is.
    CHECK(largestAngle(Whiteout(), alongProjection) > 1.0);
    CHECK(largestAngle(CotangentFrame(), alongNormal) > 1.0);
    CHECK(largestAngle(CrossProducts(), rotated) > 1.0);
}

TEST_CASE("triplanar: S-710 on a flat wall every method but UDN gives the map's normal")
{
    for (const double slope : {0.1, 0.5, 1.0}) {
        measured("degrees off, swizzle", largestWhenFlat(Swizzle(), slope), 1e-5);
        measured("degrees off, whiteout", largestWhenFlat(Whiteout(), slope), 1e-5);
        measured("degrees off, RNM", largestWhenFlat(Reoriented(), slope), 1e-5);
        measured("degrees off, cotangent frame", largestWhenFlat(CotangentFrame(), slope), 1e-5);
        CHECK(largestWhenFlat(CotangentGradients(), slope) <= 1e-5);
        measured("degrees off, cross products", largestWhenFlat(CrossProducts(), slope), 1e-5);
        CHECK(largestWhenFlat(Derivatives(), slope) <= 1e-5);
        // UDN takes the sine of the slope for its tangent.
        const double expected = (std::atan(slope) - std::atan(std::sin(std::atan(slope)))) * kDegrees;
        CHECK(largestWhenFlat(Udn(), slope) == doctest::Approx(expected).epsilon(1e-4));
        CHECK(largestWhenFlat(GpuGems3(), slope) == doctest::Approx(expected).epsilon(1e-4));
    }
}

TEST_CASE("triplanar: S-711 GPU Gems 3 is UDN, when the weights sum to 1")
{
    double largest = 0.0, halfWeights = 0.0;
    for (const glm::vec3& direction : directions()) {
        for (int k = 0; k < 8; ++k) {
            const auto bump = [k](int plane) {
                const double around = k * 0.785 + plane;
                return single(unit({0.5 * std::cos(around), 0.5 * std::sin(around), 1.0}));
            };
            const Triplanar<float3> bumps = {bump(0), bump(1), bump(2)};
            const float3 n = of(direction), w = TriplanarBlendOffset(n, 0.2f);
            const auto gems = [&](const float3& blend) {
                const float3 x = {0.0f, bumps.x.y, bumps.x.x}, y = {bumps.y.x, 0.0f, bumps.y.y};
                const float3 z = {bumps.z.x, bumps.z.y, 0.0f};
                return lane(normalize(x * blend.x + y * blend.y + z * blend.z + n));
            };
            const Vector udn = lane(TriplanarNormal(bumps, n, w, Udn()));
            largest = std::max(largest, angle(gems(w), udn));
            halfWeights =
                std::max(halfWeights, angle(gems(w * 0.5f), lane(TriplanarNormal(bumps, n, w * 0.5f, Udn()))));
        }
    }
    measured("degrees off UDN", largest, 1e-5);
    CHECK(halfWeights > 1.0);
}

TEST_CASE("triplanar: errors over 64 directions each, as explain 4.13 prints them")
{
    const std::vector<MethodError> errors = triplanarErrors(45.0f, 0.5f);
    REQUIRE(errors.size() == 9);
    const auto row = [&](const char* name) {
        return *std::find_if(errors.begin(), errors.end(), [&](const MethodError& e) { return e.method == name; });
    };
    // The swizzle ignores the tilt: against the rotation it is off by the tilt itself, at most.
    CHECK(row("swizzle").maximum[2] == doctest::Approx(45.0).epsilon(1e-6));
    CHECK(row("RNM").maximum[2] <= 1e-4);
    CHECK(row("derivatives").maximum[0] <= 1e-4);
    CHECK(row("cotangent gradients").maximum[1] <= 1e-4);
    // The same in double, for one.
    double largest = 0.0, sum = 0.0;
    for (const Case& c : cases(45.0, 0.5)) {
        const Vector udn = {c.surface.x + c.bump.x, c.surface.y + c.bump.y, c.surface.z};
        const double degrees = angle(udn, alongProjection(c));
        largest = std::max(largest, degrees);
        sum += degrees * degrees / 4096;
    }
    CHECK(row("UDN").maximum[0] == doctest::Approx(largest).epsilon(1e-4));
    CHECK(row("UDN").rms[0] == doctest::Approx(std::sqrt(sum)).epsilon(1e-4));
}

// --- signs ---

namespace {

// One side of a box: the axis that it looks along, and where.
struct Side
{
    int axis;
    float sign;
};

constexpr Side kSides[] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}, {2, -1}};

// The world axes of u and v on a plane.
std::array<int, 2> axesOf(int plane)
{
    return plane == 0 ? std::array{2, 1} : plane == 1 ? std::array{0, 2} : std::array{0, 1};
}

// What points to the right for who looks at a side from outside, with `up` upwards.
glm::vec3 rightOf(const glm::vec3& outwards, const glm::vec3& up, bool leftHanded)
{
    const glm::vec3 forward = -outwards;
    const auto cross = [](const glm::vec3& a, const glm::vec3& b) {
        return glm::vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    };
    return leftHanded ? cross(up, forward) : cross(forward, up);
}

}  // namespace

TEST_CASE("triplanar: the planes' coordinates, there and back")
{
    const float3 p = {1.0f, 2.0f, 3.0f};
    const Triplanar<float2> uv = TriplanarUV(p);
    CHECK((uv.x.x[0] == 3.0f && uv.x.y[0] == 2.0f && uv.y.x[0] == 1.0f && uv.y.y[0] == 3.0f));
    CHECK((uv.z.x[0] == 1.0f && uv.z.y[0] == 2.0f));
    const float3 back = Triblend({p.zyx(), p.xzy(), p.xyz()}, float3(0.25f, 0.25f, 0.5f));
    CHECK(angle(lane(back), lane(p)) <= 1e-5);
}

TEST_CASE("triplanar: S-713 six sides, flipped or not: each is lit as a real bump would be")
{
    // Heights rise by hu along the picture's u and by hv along its v.
    const float hu = 0.3f, hv = -0.2f;
    for (const Side& side : kSides) {
        for (const bool flipped : {false, true}) {
            glm::vec3 outwards(0.0f);
            outwards[side.axis] = side.sign;
            const std::array<int, 2> axes = axesOf(side.axis);
            const float flip = flipped ? (side.axis == 2 ? -side.sign : side.sign) : 1.0f;

            // A real bump: the side moved outwards by hu * (flip * u) + hv * v.
            glm::vec3 expected = outwards;
            expected[axes[0]] -= hu * flip;
            expected[axes[1]] -= hv;

            float3 bump = normalize(float3(-hu, -hv, 1.0f));
            bump.x *= flip;
            const float3 n = of(outwards);
            const float3 result = TriplanarNormal({bump, bump, bump}, n, TriplanarBlendOffset(n, 0.2f), Whiteout());
            CHECK(angle(lane(result), {static_cast<double>(expected.x), static_cast<double>(expected.y),
                                       static_cast<double>(expected.z)}) <= 1e-4);
        }
    }
}

TEST_CASE("triplanar: green down is one sign, whether v runs up or down, and with Z up the swizzles are these")
{
    // Heights rise by hu along u and by hv along v on the plane x = 0, seen from +x.
    const float hu = 0.3f, hv = -0.2f;
    const float3 n = {1, 0, 0}, weights = {1, 0, 0};
    const auto withBump = [&](const float3& bump) {
        return lane(TriplanarNormal({bump, bump, bump}, n, weights, Whiteout()));
    };
    // v up (y), and a map that stores the way down: -(-hv).
    const float3 greenDown = normalize(float3(-hu, hv, 1.0f));
    CHECK(angle(withBump(greenDown * float3(1, -1, 1)), {1.0, 0.2, -0.3}) <= 1e-4);
    // v down (-y), and a map whose y is along v: the surface is x = hu z + hv (-y).
    const float3 alongV = normalize(float3(-hu, -hv, 1.0f));
    CHECK(angle(withBump(alongV * float3(1, -1, 1)), {1.0, -0.2, -0.3}) <= 1e-4);
    // Z up: u along y, v along z.
    const float3 bump = normalize(float3(-hu, -hv, 1.0f));
    CHECK(angle(lane(bump.zxy()), {1.0, -0.3, 0.2}) <= 1e-4);
    CHECK(sameBits(bump.zxy().yzx(), bump));
}

TEST_CASE("triplanar: which sides show the picture mirrored, in a left-handed and in a right-handed world")
{
    // docs/triplanar_signs.md: 1 where u runs to the right for who looks at the side, -1 where the picture is mirrored.
    const std::array<float, 6> leftHanded = {1, -1, 1, -1, -1, 1}, rightHanded = {-1, 1, -1, 1, 1, -1};
    for (std::size_t i = 0; i < 6; ++i) {
        const Side side = kSides[i];
        glm::vec3 outwards(0.0f), up(0.0f);
        outwards[side.axis] = side.sign;
        up[axesOf(side.axis)[1]] = 1.0f;
        CHECK(rightOf(outwards, up, true)[axesOf(side.axis)[0]] == leftHanded[i]);
        CHECK(rightOf(outwards, up, false)[axesOf(side.axis)[0]] == rightHanded[i]);
        // The flip of 4.12 is that of the left-handed world.
        const float3 flip = axisSign(of(outwards)) * float3(1, 1, -1);
        CHECK(flip[side.axis][0] == leftHanded[i]);
    }
}

TEST_CASE("triplanar: S-712 a million units away uv stays exact, taken from within the nearest tile")
{
    const float tiling = 0.7f;
    const glm::vec3 place(1e6f + 0.25f, -1e6f, 3.3e5f);
    glm::mat4 world(1.0f);
    world[3] = glm::vec4(place, 1.0f);
    const glm::mat4 near = withoutWholeTiles(world, tiling);
    double naive = 0.0, exact = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 p(0.001f * static_cast<float>(i), 0.37f, -0.5f);
        for (int c = 0; c < 3; ++c) {
            // The uv of 512 texels, in double, and the whole tiles that it may differ by.
            const double t = static_cast<double>(tiling), x = static_cast<double>(p[c]);
            const double truth = (static_cast<double>(place[c]) + x) * t;
            const auto texelsOff = [&](float uv) {
                const double d = static_cast<double>(uv) - truth;
                return std::abs(d - std::round(d)) * 512.0;
            };
            naive = std::max(naive, texelsOff((place[c] + p[c]) * tiling));
            exact = std::max(exact, texelsOff((near[3][c] + p[c]) * tiling));
        }
    }
    measured("texels off", exact, 1e-3);
    CHECK(naive > 10.0);
    // Nothing to do, and nothing to be done.
    CHECK(withoutWholeTiles(glm::mat4(1.0f), 1.0f) == glm::mat4(1.0f));
    world[3] = glm::vec4(kInfinity, kNan, 5.0f, 1.0f);
    CHECK(withoutWholeTiles(world, 1.0f)[3].x == kInfinity);
    CHECK(withoutWholeTiles(world, 1.0f)[3].z == 0.0f);
    CHECK(withoutWholeTiles(world, 0.0f)[3].z == 5.0f);
}
