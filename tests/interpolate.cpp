// Interpolation: weights against exact arithmetic, perspective against affine, what helper lanes hold, and the contents
// of SV_POSITION.
#include "relief/pipeline/interpolate.h"

#include <limits>

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

constexpr double kUlp = 0x1p-24;  // of a number just below 1: half the distance to the next float above 1

Triangle makeTriangle(const Corners& c, const float (&z)[3], const float (&w)[3])
{
    Triangle t{};
    for (int k = 0; k < 3; ++k) {
        t.x[k] = c[static_cast<std::size_t>(k)].x;
        t.y[k] = c[static_cast<std::size_t>(k)].y;
        t.z[k] = z[k];
        t.invW[k] = 1.0f / w[k];
    }
    return t;
}

// The weights of one triangle, with the batch that they refer to.
class Weights
{
public:
    explicit Weights(const Triangle& t) : triangle(t)
    {
        const Triangle* const one[] = {&triangle};
        batch.set(one, {0, 0, kMaxTargetSize, kMaxTargetSize});
        edges.set(batch, 0);
        weights.set(batch, 0);
    }
    Weights(const Weights&) = delete;
    Weights& operator=(const Weights&) = delete;

    BlockWeights at(int x, int y, unsigned coverage) const
    {
        Float edge[3];
        edges.at(x, y, edge);
        return weights.of(edge, coverage);
    }
    Float depthAt(int x, int y) const
    {
        Float edge[3];
        edges.at(x, y, edge);
        return weights.depth(edge[1], edge[2]);
    }
    Float clipW(const BlockWeights& w) const { return weights.clipW(w); }

private:
    Triangle triangle;
    TriangleBatch batch;
    TriangleEdges edges;
    TriangleWeights weights;
};

bool isClockwise(const Corners& c)
{
    return (std::int64_t{c[1].x} - c[0].x) * (std::int64_t{c[2].y} - c[0].y) >
           (std::int64_t{c[2].x} - c[0].x) * (std::int64_t{c[1].y} - c[0].y);
}

// The exact values at a pixel centre, from exact edge values, for the 1/w that the triangle has.
struct Reference
{
    long double linear[3], perspective[3], w;

    Reference(const Triangle& t, int x, int y)
    {
        long double e[3], area = 0, sum = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const std::int64_t px = x * 256 + 128, py = y * 256 + 128;
            e[k] = static_cast<long double>((std::int64_t{t.x[b]} - t.x[a]) * (py - t.y[a]) -
                                            (std::int64_t{t.y[b]} - t.y[a]) * (px - t.x[a]));
            area += e[k];
            sum += e[k] * static_cast<long double>(t.invW[k]);
        }
        for (int k = 0; k < 3; ++k) {
            linear[k] = e[k] / area;
            perspective[k] = e[k] * static_cast<long double>(t.invW[k]) / sum;
        }
        w = area / sum;
    }
    static double mix(const long double (&weight)[3], const float (&v)[3])
    {
        long double sum = 0;
        for (int k = 0; k < 3; ++k) sum += weight[k] * static_cast<long double>(v[k]);
        return static_cast<double>(sum);
    }
};

// Calls visit(block x, block y, coverage) for the blocks of a triangle within a rectangle.
template <class Visit>
void forEachBlock(const Corners& c, const Rectangle& pixels, const Visit& visit)
{
    const ExactTriangle exact(c);
    for (int y = pixels.y0 & -kBlockHeight; y < pixels.y1; y += kBlockHeight) {
        for (int x = pixels.x0 & -kBlockWidth; x < pixels.x1; x += kBlockWidth) {
            unsigned coverage = 0;
            for (int lane = 0; lane < kLanes; ++lane) {
                coverage |= (exact.covers(x + laneX(lane), y + laneY(lane)) ? 1u : 0u) << lane;
            }
            if (coverage != 0) visit(x, y, coverage);
        }
    }
}

// The worst errors of a triangle's interpolated value, relative to the largest corner's.
struct Errors
{
    double perspective = 0, affine = 0, outsideRange = 0, depth = 0, w = 0;
    bool finite = true;
};

Errors measure(const Corners& c, const float (&z)[3], const float (&w)[3], const float (&v)[3], const Rectangle& pixels)
{
    Errors errors;
    const Triangle t = makeTriangle(c, z, w);
    const Weights weights(t);
    CornerComponents<1> corners;
    corners.set(&v[0], &v[1], &v[2]);
    const double largest = std::fmax(std::fabs(v[0]), std::fmax(std::fabs(v[1]), std::fabs(v[2])));
    const double low = std::fmin(v[0], std::fmin(v[1], v[2])), high = std::fmax(v[0], std::fmax(v[1], v[2]));
    const float lowZ = std::fmin(z[0], std::fmin(z[1], z[2])), highZ = std::fmax(z[0], std::fmax(z[1], z[2]));
    forEachBlock(c, pixels, [&](int x, int y, unsigned coverage) {
        const BlockWeights block = weights.at(x, y, coverage);
        const Float perspective = corners.perspective(0, block), affine = corners.affine(0, block);
        const Float depth = weights.depthAt(x, y), clipW = weights.clipW(block);
        for (int lane = 0; lane < kLanes; ++lane) {
            errors.finite = errors.finite && std::isfinite(perspective[lane]) && std::isfinite(affine[lane]);
            if ((coverage >> lane & 1u) == 0) continue;
            const Reference r(t, x + laneX(lane), y + laneY(lane));
            const double p = static_cast<double>(perspective[lane]);
            const auto worse = [](double& worst, double error) { worst = std::fmax(worst, std::fabs(error)); };
            worse(errors.perspective, (p - Reference::mix(r.perspective, v)) / largest);
            worse(errors.affine, (static_cast<double>(affine[lane]) - Reference::mix(r.linear, v)) / largest);
            worse(errors.outsideRange, std::fmax(0.0, std::fmax(low - p, p - high)) / largest);
            worse(errors.depth, static_cast<double>(depth[lane]) - Reference::mix(r.linear, z));
            worse(errors.w, (static_cast<double>(clipW[lane]) - static_cast<double>(r.w)) / static_cast<double>(r.w));
            errors.finite = errors.finite && depth[lane] >= lowZ && depth[lane] <= highZ;  // never beyond the corners
        }
    });
    return errors;
}

void keepWorst(Errors& worst, const Errors& e)
{
    worst.perspective = std::fmax(worst.perspective, e.perspective);
    worst.affine = std::fmax(worst.affine, e.affine);
    worst.outsideRange = std::fmax(worst.outsideRange, e.outsideRange);
    worst.depth = std::fmax(worst.depth, e.depth);
    worst.w = std::fmax(worst.w, e.w);
    worst.finite = worst.finite && e.finite;
}

struct TwoKinds
{
    SV_POSITION position;
    TEXCOORD<0, float4> perspective;
    noperspective<TEXCOORD<1, float4>> affine;
};

struct TwoKindsFromPixels
{
    FromPixels base;
    TwoKinds operator()(const TestVertexData& v) const
    {
        const Interpolated i = base(v);
        return {i.position, i.value, v.value};
    }
};

struct ShowBoth
{
    float4 operator()(const TwoKinds& i) const
    {
        return float4(i.perspective.x, i.perspective.y, i.affine.x, i.affine.y);
    }
};

struct Derivatives
{
    float4 operator()(const Interpolated& i) const
    {
        return float4(ddx(i.value.x), ddy(i.value.x), ddx(i.value.y), ddy(i.value.y));
    }
};

struct PositionOnly
{
    SV_POSITION position;
};
struct PositionOnlyVertex
{
    FromPixels base;
    PositionOnly operator()(const TestVertexData& v) const { return {base(v).position}; }
};
struct PositionOnlyFragment
{
    float4 operator()(const PositionOnly& i) const { return i.position; }
};

}  // namespace

TEST_CASE("interpolate: errors over random triangles, w ratios up to 1e4 (S-401, S-403)")
{
    Random random(60);
    const Rectangle pixels = {0, 0, 48, 32};
    Errors worst;
    for (int trial = 0; trial < trials(6000); ++trial) {
        Corners c = randomTriangle(random, 48, 32);
        if (!isClockwise(c)) std::swap(c[1], c[2]);
        if (!isClockwise(c)) continue;
        float z[3], w[3], v[3];
        for (int k = 0; k < 3; ++k) {
            z[k] = random.real(0, 1);
            w[k] = random.real(1, 2);
            w[k] = std::ldexp(w[k], random.between(-6, 6));
            v[k] = random.real(-1, 1);
        }
        keepWorst(worst, measure(c, z, w, v, pixels));
    }
    CHECK(worst.finite);
    measured("error of u, of 1", worst.perspective, 8 * kUlp);
    CHECK(worst.affine <= 8 * kUlp);
    measured("beyond the corners' range, of 1", worst.outsideRange, 4 * kUlp);
    CHECK(worst.depth <= 4 * kUlp);
    CHECK(worst.w <= 8 * kUlp);
}

TEST_CASE("interpolate: two pixels far from the origin, w ratio 1e4 (S-401)")
{
    Random random(61);
    Errors worst;
    for (int trial = 0; trial < trials(2000); ++trial) {
        const int x = 3800 * 256, y = 2100 * 256;
        Corners c;
        for (Point& p : c) p = {x + random.between(0, 512), y + random.between(0, 512)};
        if (!isClockwise(c)) std::swap(c[1], c[2]);
        if (!isClockwise(c)) continue;
        const float ratio = random.chance(2) ? 1e4f : 1e-4f;
        keepWorst(worst, measure(c, {0.25f, 0.5f, 0.75f}, {1.0f, ratio, 1.0f}, {0.0f, 1.0f, random.real(0, 1)},
                                 {3796, 2096, 3808, 2108}));
    }
    CHECK(worst.finite);
    measured("error of u, of 1", worst.perspective, 8 * kUlp);
    CHECK(worst.outsideRange <= 4 * kUlp);
}

TEST_CASE("interpolate: the last pixels of a triangle of 16384 px (S-412)")
{
    Errors worst;
    const int end = 16384 * 256;
    const Corners cases[] = {{{{0, 0}, {end, 0}, {0, end}}},
                             {{{0, 0}, {end, 256 * 3}, {0, 256 * 7}}},
                             {{{-end, -end}, {end, -end}, {end, end}}}};
    for (const Corners& c : cases) {
        REQUIRE(isClockwise(c));
        for (const float ratio : {1.0f, 3.0f, 1e4f}) {
            for (const Rectangle& pixels : {Rectangle{16340, 0, 16384, 16}, Rectangle{0, 16340, 8, 16384},
                                            Rectangle{8150, 8150, 8200, 8200}, Rectangle{16352, 16352, 16384, 16384}}) {
                keepWorst(worst, measure(c, {0, 1, 0.5f}, {1.0f, ratio, 2.0f}, {0.0f, 1.0f, 0.5f}, pixels));
            }
        }
    }
    CHECK(worst.finite);
    measured("error of u, of 1", worst.perspective, 8 * kUlp);
    CHECK(worst.affine <= 8 * kUlp);
    CHECK(worst.depth <= 4 * kUlp);
}

TEST_CASE("interpolate: the smallest area there is, and slivers (S-304)")
{
    Errors worst;
    worst.finite = true;
    const Corners smallest = {{{1920, 1920}, {1921, 1920}, {1920, 1921}}};
    keepWorst(worst, measure(smallest, {0, 1, 0.5f}, {1, 2, 4}, {3, 5, 9}, {0, 0, 16, 16}));
    const Corners sliver = {{{0, 2176}, {4096, 2176}, {4096, 2177}}};
    keepWorst(worst, measure(sliver, {0, 1, 0.5f}, {1, 2, 4}, {3, 5, 9}, {0, 0, 16, 16}));
    CHECK(worst.finite);  // helper lanes too
    measured("error of u", worst.perspective, 8 * kUlp);
    CHECK(worst.outsideRange <= 4 * kUlp);
}

TEST_CASE("interpolate: a value that is equal at all corners comes out unchanged, helper lanes included (S-402)")
{
    Random random(62);
    int wrong = 0;
    for (int trial = 0; trial < trials(3000); ++trial) {
        Corners c = randomTriangle(random, 32, 32);
        if (!isClockwise(c)) std::swap(c[1], c[2]);
        if (!isClockwise(c)) continue;
        const float value = random.real(-100, 100);
        const Weights weights(makeTriangle(
            c, {0.3f, 0.3f, 0.3f}, {random.real(0.001f, 1000), random.real(0.001f, 1000), random.real(0.001f, 1000)}));
        CornerComponents<1> corners;
        corners.set(&value, &value, &value);
        forEachBlock(c, {0, 0, 32, 32}, [&](int x, int y, unsigned coverage) {
            const BlockWeights block = weights.at(x, y, coverage);
            wrong += any(corners.perspective(0, block) != value) || any(corners.affine(0, block) != value);
            wrong += any(weights.depthAt(x, y) != 0.3f);
        });
    }
    measured("values that changed", wrong, 0);
}

TEST_CASE("interpolate: with equal w at all corners perspective is affine (S-404)")
{
    Random random(63);
    double worst = 0.0;
    for (int trial = 0; trial < trials(3000); ++trial) {
        Corners c = randomTriangle(random, 32, 32);
        if (!isClockwise(c)) std::swap(c[1], c[2]);
        if (!isClockwise(c)) continue;
        const float w = random.real(0.001f, 1000);
        const Weights weights(makeTriangle(c, {0, 0, 0}, {w, w, w}));
        const float v[3] = {random.real(0, 1), random.real(0, 1), random.real(0, 1)};
        CornerComponents<1> corners;
        corners.set(&v[0], &v[1], &v[2]);
        forEachBlock(c, {0, 0, 32, 32}, [&](int x, int y, unsigned coverage) {
            const BlockWeights block = weights.at(x, y, coverage);
            const Float difference = abs(corners.perspective(0, block) - corners.affine(0, block));
            for (int lane = 0; lane < kLanes; ++lane) {
                if ((coverage >> lane & 1u) != 0) worst = std::fmax(worst, static_cast<double>(difference[lane]));
            }
        });
    }
    measured("perspective less affine, of 1", worst, 2 * 0x1p-23);  // ulps of a value up to 1
    CHECK(worst > 0.0);                                             // it is two computations
}

TEST_CASE("interpolate: very large, very small and very different w (S-407)")
{
    Random random(64);
    const Rectangle pixels = {0, 0, 16, 16};
    Errors worst;
    for (int trial = 0; trial < trials(3000); ++trial) {
        // Corners on pixel centres: there the weight of one corner is all there is.
        Corners c;
        for (Point& p : c) p = {random.between(0, 15) * 256 + 128, random.between(0, 15) * 256 + 128};
        if (!isClockwise(c)) std::swap(c[1], c[2]);
        if (!isClockwise(c)) continue;
        const int base = random.between(-99, 120);
        float w[3];
        for (float& one : w) {
            one = random.real(1, 2);
            one = std::ldexp(one, base + random.between(0, 6));
        }
        keepWorst(worst, measure(c, {0, 1, 0.5f}, w, {random.real(0, 1), random.real(0, 1), 1.0f}, pixels));
    }
    CHECK(worst.finite);
    measured("error of u, of 1", worst.perspective, 8 * kUlp);

    // Any ratio that two floats can have: finite and within the corners' range, whatever the precision.
    Errors extreme;
    for (int trial = 0; trial < trials(3000); ++trial) {
        Corners c;
        for (Point& p : c) p = {random.between(0, 15) * 256 + 128, random.between(0, 15) * 256 + 128};
        if (!isClockwise(c)) std::swap(c[1], c[2]);
        if (!isClockwise(c)) continue;
        float w[3];
        for (float& one : w) one = random.chance(2) ? 3e38f : random.chance(2) ? kSmallestW : random.real(1, 2);
        keepWorst(extreme, measure(c, {0, 1, 0.5f}, w, {random.real(0, 1), random.real(0, 1), 1.0f}, pixels));
    }
    CHECK(extreme.finite);
    measured("beyond the corners' range at any w", extreme.outsideRange, 8 * kUlp);
}

TEST_CASE("interpolate: SV_POSITION holds the pixel centre, depth and w, with and without a depth test")
{
    const auto check = [&]<RenderState state>() {
        Framebuffer target = makeTarget(20, 12);
        Mesh mesh;
        addTriangle(mesh, {{-8, -8, 0.25f, 1}}, {{40, -8, 0.75f, 4}}, {{-8, 40, 0.5f, 2}});
        drawPixels<state>(target, mesh, Position{});
        int wrong = 0;
        for (int y = 0; y < 12; ++y) {
            for (int x = 0; x < 20; ++x) {
                const glm::vec4 p = pixel(target, x, y);
                const double b1 = (x + 8.5) / 48, b2 = (y + 8.5) / 48, b0 = 1 - b1 - b2;
                wrong += p.x != static_cast<float>(x) + 0.5f || p.y != static_cast<float>(y) + 0.5f;
                wrong += std::fabs(p.z - (0.25 + b1 * 0.5 + b2 * 0.25)) > 4 * kUlp;
                wrong += std::fabs(p.w - 1 / (b0 + b1 / 4 + b2 / 2)) > 16 * kUlp * 4;
            }
        }
        CHECK(wrong == 0);
    };
    check.operator()<kDepthTested>();
    check.operator()<kPaint>();
}

TEST_CASE("interpolate: interpolators of nothing but a position")
{
    Framebuffer target = makeTarget(8, 8);
    const Viewport viewport = exactViewport(8, 8);
    const Mesh mesh = meshOf({{{{-2560, -2560}, {25600, -2560}, {-2560, 25600}}}});
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    frame.setViewport(viewport);
    frame.draw(mesh, PositionOnlyVertex{FromPixels(viewport)}, PositionOnlyFragment{}, kDepthTested);
    checkInvariants(target, frame.run());
    CHECK(pixel(target, 3, 5) == glm::vec4(3.5f, 5.5f, 0.5f, 1.0f));
}

TEST_CASE("interpolate: perspective and noperspective side by side")
{
    // A quad like a floor: w goes from 1 to 8 across.
    Framebuffer target = makeTarget(32, 32);
    const Viewport viewport = exactViewport(32, 32);
    Mesh mesh;
    const TestVertex a = {{0, 0, 0.5f, 1}, {0, 0, 0, 0}}, b = {{32, 0, 0.5f, 8}, {1, 0, 0, 0}};
    const TestVertex c = {{32, 32, 0.5f, 8}, {1, 1, 0, 0}}, d = {{0, 32, 0.5f, 1}, {0, 1, 0, 0}};
    addTriangle(mesh, a, b, c);
    addTriangle(mesh, a, c, d);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(-1.0f));
    frame.setViewport(viewport);
    frame.draw(mesh, TwoKindsFromPixels{FromPixels(viewport)}, ShowBoth{}, kPaint);
    checkInvariants(target, frame.run());
    double worst = 0.0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const glm::vec4 v = pixel(target, x, y);
            const double s = (x + 0.5) / 32, t = (y + 0.5) / 32;
            const double u = s / 8 / (1 - s + s / 8);
            worst = std::fmax(worst, std::fabs(v.x - u));
            worst = std::fmax(worst, std::fabs(v.z - s));
            worst = std::fmax(worst, std::fabs(v.w - t));
        }
    }
    CHECK(worst <= 8 * kUlp);
}

TEST_CASE("interpolate: derivatives of a linear value are its slope, at the triangle's edges too (S-502)")
{
    Random random(65);
    Framebuffer target = makeTarget(40, 40);
    int wrong = 0, drawn = 0;
    for (int trial = 0; trial < trials(400); ++trial) {
        const float perX = random.real(-2, 2), perY = random.real(-2, 2), perX2 = random.real(-0.1f, 0.1f);
        Corners c = randomTriangle(random, 40, 40, 100);
        Mesh mesh;
        const auto vertex = [&](Point p) -> TestVertex {
            const glm::vec4 position = pixelPosition(p);
            return {position, {position.x * perX + position.y * perY, position.x * perX2, 0, 1}};
        };
        addTriangle(mesh, vertex(c[0]), vertex(c[1]), vertex(c[2]));
        const Statistics statistics = drawPixels<kPaint>(target, mesh, Derivatives{});
        wrong += statistics.invalidColors != 0;
        const ExactTriangle exact(c);
        const double area = std::fabs((double(c[1].x) - c[0].x) * (double(c[2].y) - c[0].y) -
                                      (double(c[2].x) - c[0].x) * (double(c[1].y) - c[0].y)) /
                            65536;
        if (area < 0.5) continue;  // corners rounded to floats have another slope
        exact.forEachPixel({0, 0, 40, 40}, [&](int x, int y) {
            const glm::vec4 v = pixel(target, x, y);
            // Values up to a few hundred, extrapolated by up to one pixel: weights up to 40 / height.
            const double tolerance = 2e-3 / std::fmin(1.0, area);
            ++drawn;
            wrong += std::fabs(v.x - perX) > tolerance || std::fabs(v.y - perY) > tolerance;
            wrong += std::fabs(v.z - perX2) > tolerance || std::fabs(v.w) > tolerance;
        });
    }
    measured("derivatives off", wrong, 0);
    CHECK(drawn > 1000);
}

TEST_CASE("interpolate: helper lanes behind the horizon stay finite (S-501)")
{
    // Floors that end just before their horizon: one pixel further 1/w is zero or negative.
    Random random(66);
    Framebuffer target = makeTarget(64, 64);
    int wrong = 0, drawn = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        const float horizon = random.real(4, 40), far = std::ldexp(1.0f, random.between(3, 40));
        // The steeper 1/w falls off, the nearer the horizon is beyond the far edge.
        Mesh mesh;
        const TestVertex nearLeft = {{random.real(-60, 0), 64, 0.0f, 1}, {0, 0, 0, 1}};
        const TestVertex nearRight = {{random.real(64, 120), 64, 0.0f, 1}, {1, 0, 0, 1}};
        const TestVertex farLeft = {{random.real(0, 30), horizon, 0.0f, far}, {0, 1, 0, 1}};
        const TestVertex farRight = {{random.real(34, 64), horizon + random.real(0, 1), 0.0f, far}, {1, 1, 0, 1}};
        addTriangle(mesh, nearLeft, farLeft, farRight);
        addTriangle(mesh, nearLeft, farRight, nearRight);
        const Statistics statistics = drawPixels<kPaint>(target, mesh, Derivatives{});
        wrong += statistics.invalidColors != 0 || !allFinite(target) || !addsUp(statistics);
        drawn += statistics.pixelsShaded > 500;
    }
    measured("lanes not finite or out of range", wrong, 0);
    CHECK(drawn == trials(1000));
}

TEST_CASE("interpolate: NaN, infinity and 1e38 at one corner touch that triangle's pixels alone (S-405)")
{
    // Three triangles that share quads of pixels and blocks.
    const Corners left = {{{0, 0}, {5000, 300}, {700, 8192}}}, middle = {{{5000, 300}, {5900, 7800}, {700, 8192}}};
    const Corners right = {{{5000, 300}, {8192, 100}, {5900, 7800}}};
    const glm::vec4 color = {0.25f, 0.5f, 0.75f, 1.0f};
    Mesh clean;
    addTriangle(clean, left, color);
    addTriangle(clean, middle, color);
    addTriangle(clean, right, color);
    Framebuffer without = makeTarget(32, 32), with = makeTarget(32, 32);
    drawPixels<kPaint>(without, clean, Value{});
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 1e38f, -3.4e38f}) {
        Mesh mesh = clean;
        mesh.tangents[4].y = bad;
        if (std::fabs(bad) > 3e38f) mesh.tangents[3].y = -bad;  // the difference of the two overflows
        const Statistics statistics = drawPixels<kPaint>(with, mesh, Value{});
        checkInvariants(with, statistics);
        if (bad == 1e38f) CHECK(statistics.invalidColors == 0);
        if (!std::isfinite(bad)) CHECK(statistics.invalidColors != 0);
        const ExactTriangle exact(middle);
        int wrong = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                if (!exact.covers(x, y)) wrong += pixel(with, x, y) != pixel(without, x, y);
            }
        }
        measured("other pixels that changed", wrong, 0);
    }
}

TEST_CASE("interpolate: subnormal values are kept (S-406)")
{
    Framebuffer target = makeTarget(16, 16);
    Mesh mesh;
    const Corners c = {{{-2560, -2560}, {25600, -2560}, {-2560, 25600}}};
    addTriangle(mesh, c, glm::vec4(1e-40f, -3e-42f, 1.4e-45f, 0.0f));
    drawPixels<kPaint>(target, mesh, Value{});
    CHECK(pixel(target, 7, 7) == glm::vec4(1e-40f, -3e-42f, 1.4e-45f, 0.0f));
}

TEST_CASE("interpolate: moved by whole pixels, values and depth have the same bits (S-310)")
{
    Random random(67);
    Framebuffer here = makeTarget(128, 128, Format::rgba32f, Store::keep);
    Framebuffer there = makeTarget(128, 128, Format::rgba32f, Store::keep);
    int wrong = 0, drawn = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        const int dx = random.between(0, 63), dy = random.between(0, 63);
        Mesh mesh, moved;
        TestVertex v[3], m[3];
        for (int k = 0; k < 3; ++k) {
            const Point p = {random.between(0, 64 * 256), random.between(0, 64 * 256)};
            // w a power of two, so that no rounding happens before the pixel grid.
            const float w = std::ldexp(1.0f, random.between(-3, 3)),
                        z = static_cast<float>(random.between(0, 256)) / 256;
            v[k] = {pixelPosition(p, z, w), {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1), 1}};
            m[k] = v[k];
            m[k].position = pixelPosition({p.x + dx * 256, p.y + dy * 256}, z, w);
        }
        addTriangle(mesh, v[0], v[1], v[2]);
        addTriangle(moved, m[0], m[1], m[2]);
        const int sizes[] = {16, 32, 64, 128};
        drawPixels<kDepthTested>(here, mesh, Value{}, {1, sizes[random.between(0, 3)]});
        drawPixels<kDepthTested>(there, moved, Value{}, {1, sizes[random.between(0, 3)]});
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const auto at = static_cast<std::size_t>(y * 128 + x),
                           to = static_cast<std::size_t>((y + dy) * 128 + x + dx);
                wrong += here.color32f()[at] != there.color32f()[to] || here.depth()[at] != there.depth()[to];
                drawn += here.color32f()[at].w != 0.0f;
            }
        }
    }
    measured("bits that differ", wrong, 0);
    CHECK(drawn > 10000);
}
