// E-10: how much a texture coordinate changes from one pixel to the next.
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/derivatives.h"
#include "relief/texture/sampler.h"

namespace relief::experiments {

namespace {

// Linear on screen: at + right x + down y.
struct Linear
{
    double at, right, down;
    Float lanes(Float x, Float y) const { return Float(right) * x + Float(down) * y + Float(at); }
    double operator()(double x, double y) const { return at + right * x + down * y; }
};

// A textured ground: 1/w and the coordinates over w, in texels. The horizon, where 1/w is 0, goes through pixel (0, 0),
// and the ground lies on its side towards `azimuth`: 0 is down, 90 degrees to the right.
struct Ground
{
    Linear u, v, q;
    explicit Ground(double azimuth)
    {
        constexpr double texels = 64.0, focalLength = 512.0;  // the latter in pixels
        const double c = std::cos(azimuth), s = std::sin(azimuth);
        q = {0.0, s, c};
        u = {0.0, texels * c, -texels * s};
        v = {texels * focalLength, 0.0, 0.0};
    }
};

// Kernels: from pixels to (du/dx, dv/dx, du/dy, dv/dy).
const auto fine = [](const Ground& g) {
    return [g](Float x, Float y) {
        const Float w = 1.0f / g.q.lanes(x, y), u = g.u.lanes(x, y) * w, v = g.v.lanes(x, y) * w;
        return float4(ddx(u), ddx(v), ddy(u), ddy(v));
    };
};
const auto coarse = [](const Ground& g) {
    return [g](Float x, Float y) {
        const Float w = 1.0f / g.q.lanes(x, y), u = g.u.lanes(x, y) * w, v = g.v.lanes(x, y) * w;
        return float4(ddx_coarse(u), ddx_coarse(v), ddy_coarse(u), ddy_coarse(v));
    };
};
const auto analytic = [](const Ground& g) {  // the quotient rule: (a / q)' = (a' - a / q q') / q
    return [g](Float x, Float y) {
        const Float w = 1.0f / g.q.lanes(x, y), u = g.u.lanes(x, y) * w, v = g.v.lanes(x, y) * w;
        return float4((Float(g.u.right) - u * Float(g.q.right)) * w, (Float(g.v.right) - v * Float(g.q.right)) * w,
                      (Float(g.u.down) - u * Float(g.q.down)) * w, (Float(g.v.down) - v * Float(g.q.down)) * w);
    };
};

double levelOf(double ux, double vx, double uy, double vy)
{
    return std::log2(std::fmax(std::hypot(ux, vx), std::hypot(uy, vy)));
}

double exactLevel(const Ground& g, double x, double y)
{
    const double q = g.q(x, y), u = g.u(x, y) / q, v = g.v(x, y) / q;
    return levelOf((g.u.right - u * g.q.right) / q, (g.v.right - v * g.q.right) / q, (g.u.down - u * g.q.down) / q,
                   (g.v.down - v * g.q.down) / q);
}

// Quads, each four rows: upper left, upper right, lower left, lower right.
void addQuad(Columns& pixels, double x, double y)
{
    for (int i = 0; i < 4; ++i) {
        pixels[0].push_back(static_cast<float>(x + i % 2));
        pixels[1].push_back(static_cast<float>(y + i / 2));
    }
}

// Quads whose upper left pixels are 1, 2, 4 ... 256 pixels from the horizon, beside its middle and far to the side.
Columns quadsAt(double azimuth)
{
    Columns pixels(2);
    for (double distance = 1.0; distance <= 256.0; distance *= 2.0) {
        for (int side = -2; side <= 1; ++side) {
            const double along = 100.0 * side + 50.0, c = std::cos(azimuth), s = std::sin(azimuth);
            addQuad(pixels, s * distance + c * along, c * distance - s * along);
        }
    }
    while (pixels[0].size() % 16 != 0) addQuad(pixels, 1.0, 256.0);
    return pixels;
}

template <class Kernel>
Error errorOf(Kernel kernel, int azimuths)
{
    ErrorSum sum;
    for (int i = 0; i < azimuths; ++i) {
        const double azimuth = (i + 0.5) / azimuths * std::numbers::pi / 2.0;
        const Ground ground(azimuth);
        const Columns pixels = quadsAt(azimuth), change = evaluate<2>(pixels, kernel(ground));
        for (std::size_t row = 0; row < pixels[0].size(); ++row) {
            sum.add(levelOf(change[0][row], change[1][row], change[2][row], change[3][row]) -
                    exactLevel(ground, pixels[0][row], pixels[1][row]));
        }
    }
    return sum.result();
}

// Of the upper left pixel of a quad straight below a level horizon.
template <class Kernel>
double levelErrorBelow(Kernel kernel, double distance)
{
    const Ground ground(0.0);
    Columns pixels(2);
    for (int i = 0; i < 4; ++i) addQuad(pixels, 0.0, distance);
    const Columns change = evaluate<2>(pixels, kernel(ground));
    return std::abs(levelOf(change[0][0], change[1][0], change[2][0], change[3][0]) -
                    exactLevel(ground, 0.0, distance));
}

// The same of the level that tex2D would take.
double sampledLevelError(double distance)
{
    static const std::vector<std::uint8_t> pixels(64 * 64 * 4, 255);
    static const Texture texture = *Texture::fromRgba8(64, 64, pixels, ColorSpace::linear);
    const Ground ground(0.0);
    Columns quad(2);
    for (int i = 0; i < 4; ++i) addQuad(quad, 0.0, distance);
    const Columns level = evaluate<2>(quad, [&](Float x, Float y) {
        const Float w = 1.0f / ground.q.lanes(x, y);
        const float2 uv = {ground.u.lanes(x, y) * w / 64.0f, ground.v.lanes(x, y) * w / 64.0f};
        return calculateLevelOfDetailUnclamped({.texture = &texture}, uv);
    });
    return std::abs(level[0][0] - exactLevel(ground, 0.0, distance));
}

// Where 1/w does not change, the quad's own difference is every pixel's: what coarse is off fine there.
double coarseOnAnAffineGround()
{
    Ground ground(0.0);
    ground.q = {1.0, 0.0, 0.0};
    ground.v = {3.0, 0.25, 8.0};
    Columns pixels(2);
    for (int i = 0; i < 64; ++i) addQuad(pixels, 2.0 * i, 3.0 * i);
    const Columns a = evaluate<2>(pixels, fine(ground)), b = evaluate<2>(pixels, coarse(ground));
    double worst = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t row = 0; row < a[c].size(); ++row)
            worst = std::fmax(worst, std::abs(static_cast<double>(a[c][row]) - b[c][row]));
    }
    return worst;
}

template <class Kernel>
void add(Experiment& e, const std::string& name, Kernel kernel, Effort effort,
         const std::shared_ptr<const Columns>& pixels)
{
    Variant v = laneVariant<2>(name, "", pixels, kernel(Ground(0.5)), [=] {
        return Outcome(errorOf(kernel, effort.samples(90, 9)), {{"levels at 1 px", levelErrorBelow(kernel, 1.0)},
                                                                {"at 16 px", levelErrorBelow(kernel, 16.0)},
                                                                {"at 256 px", levelErrorBelow(kernel, 256.0)}});
    });
    v.work.items /= 4.0;
    v.streaming.items /= 4.0;
    e.variants.push_back(std::move(v));
}

}  // namespace

Experiment derivatives(Effort effort)
{
    Experiment e;
    e.id = "E-10";
    e.title = "Derivatives of a texture coordinate";
    e.question =
        "A texture's level of detail comes from how much the coordinate changes from pixel to pixel. The engine, like "
        "graphics hardware, takes differences within quads of 2x2 pixels: fine ones by row and column, or coarse ones, "
        "one pair for the quad. The coordinate's plane equations would give the derivative at the pixel's own centre. "
        "How far off are the differences on a ground that runs to the horizon, and what does each cost?";
    e.item = "quad";
    e.unit = "levels";
    auto pixels = std::make_shared<Columns>(2);
    for (std::size_t i = 0; i < kStreamedItems / 4; ++i)
        addQuad(*pixels, 2.0 * static_cast<double>(i % 128), 1.0 + 2.0 * static_cast<double>(i / 128));
    add(e, "fine", fine, effort, pixels);
    add(e, "coarse", coarse, effort, pixels);
    add(e, "analytic", analytic, effort, pixels);

    // Distance from the horizon in pixels, and log2(1 + 1 / distance).
    constexpr double kReferences[][2] = {{1, 1},         {2, .584963},    {4, .321928},
                                         {8, .169925},   {16, .0874628},  {32, .0443941},
                                         {64, .0223678}, {128, .0112273}, {256, .00562455}};
    constexpr double kLevel = 1.0 / 256.0;
    for (const auto& [distance, levels] : kReferences) {
        const std::string at = " at " + number(distance, 0) + " px from the horizon";
        const double d = distance;
        e.checks.push_back({"fine" + at, levels, [d] { return levelErrorBelow(fine, d); }, kLevel});
        e.checks.push_back({"coarse" + at, levels, [d] { return levelErrorBelow(coarse, d); }, kLevel});
        e.checks.push_back({"analytic" + at, 0.0, [d] { return levelErrorBelow(analytic, d); }, kLevel});
        e.checks.push_back({"tex2D's level" + at, levels, [d] { return sampledLevelError(d); }, kLevel});
    }
    e.checks.push_back({"coarse less fine where w is constant, texels", 0.0, coarseOnAnAffineGround, 0.0});
    e.finding = [](const Rows& rows) {
        const Row &f = rows("fine"), &c = rows("coarse"), &a = rows("analytic");
        return "One pixel below the horizon a difference is " + number(f.fact("levels at 1 px"), 2) +
               " levels off, at 16 pixels " + number(f.fact("at 16 px"), 3) + ", at 256 " +
               number(f.fact("at 256 px"), 4) + ": log2(1 + 1/distance). Over all the quads fine has an RMS error of " +
               number(f.outcome.error.rms, 3) + " levels and coarse of " + number(c.outcome.error.rms, 3) +
               "; the plane equations are exact but for " + number(a.outcome.error.rms, 7) +
               ". Their time per quad: " + number(f.fastest, 2) + ", " + number(c.fastest, 2) + " and " +
               number(a.fastest, 2) +
               " ns. Differences need no plane equations, so they work for whatever a shader computed; where the "
               "coordinate is an interpolator, tex2Dgrad with the quotient rule is right up to the last row.";
    };
    return e;
}

}  // namespace relief::experiments
