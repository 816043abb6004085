// E-25: smooth edges by more samples.
#include <numbers>

#include "experiments.h"
#include "hlsl/intrinsics.h"
#include "small_frame.h"

namespace relief::experiments {

namespace {

constexpr int kSide = 64;  // pixels of the finished picture

// The part of a pixel on one side of a line that passes its centre at `distance`, with the normal (cosine, sine).
double exactCoverage(double cosine, double sine, double distance)
{
    const double a = std::fmax(std::abs(cosine), std::abs(sine)), b = std::fmin(std::abs(cosine), std::abs(sine));
    const double t = distance + 0.5 * (a + b);
    if (t <= 0.0) return 0.0;
    if (t >= a + b) return 1.0;
    if (t < b) return t * t / (2.0 * a * b);
    if (t <= a) return (t - 0.5 * b) / a;
    return 1.0 - (a + b - t) * (a + b - t) / (2.0 * a * b);
}

// --- in doubles: a grid of n x n samples against every line ---

Error gridError(int n, int angles, int offsets)
{
    ErrorSum sum;
    for (int i = 0; i < angles; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / angles, c = std::cos(angle), s = std::sin(angle);
        const double reach = 0.5 * (std::abs(c) + std::abs(s));
        for (int k = 0; k < offsets; ++k) {
            const double distance = reach * (2.0 * (k + 0.5) / offsets - 1.0);
            int inside = 0;
            for (int y = 0; y < n; ++y) {
                for (int x = 0; x < n; ++x)
                    inside += c * ((x + 0.5) / n - 0.5) + s * ((y + 0.5) / n - 0.5) < distance ? 1 : 0;
            }
            sum.add(static_cast<double>(inside) / (n * n) - exactCoverage(c, s, distance), reach);
        }
    }
    return sum.result();
}

// --- by the engine: a picture n times as wide and high, averaged ---

struct VertexData
{
    POSITION position;
};
struct Interpolators
{
    SV_POSITION position;
};
struct VertexProgram
{
    Interpolators operator()(VertexData v) const { return {v.position}; }
};
struct FragmentProgram
{
    float4 operator()(Interpolators) const { return float4(1.0f); }
};

// All on one side of a line through the picture's middle.
struct HalfPlane
{
    Mesh mesh;
    double cosine, sine;

    explicit HalfPlane(double angle) : cosine(std::cos(angle)), sine(std::sin(angle))
    {
        const auto corner = [&](double along, double across) {
            const double x = -sine * along - cosine * across, y = cosine * along - sine * across;
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(-y), 0.0f});
        };
        corner(-3.0, 0.0);
        corner(3.0, 0.0);
        corner(0.0, 6.0);
        mesh.name = "half plane";
        mesh.indices = {0, 1, 2};
    }
};

struct Supersampled
{
    int n;
    std::shared_ptr<SmallFrame> large;
    std::vector<float> coverage = std::vector<float>(kSide * kSide);

    explicit Supersampled(int samples) : n(samples), large(smallFrame(kSide * samples, kSide * samples)) {}

    void draw(const HalfPlane& half)
    {
        large->frame.reset();
        large->frame.clear({0, 0, 0, 1});
        large->frame.draw(half.mesh, VertexProgram{}, FragmentProgram{}, RenderState{.cull = Cull::none});
        large->frame.run();
        const glm::vec4* pixels = large->target.color32f().data();
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                float sum = 0.0f;
                for (int k = 0; k < n; ++k) {
                    const glm::vec4* row = pixels + (y * n + k) * kSide * n + x * n;
                    for (int i = 0; i < n; ++i) sum += row[i].x;
                }
                coverage[static_cast<std::size_t>(y * kSide + x)] = sum / static_cast<float>(n * n);
            }
        }
    }

    // Of the pixels that the line passes.
    void addErrors(const HalfPlane& half, ErrorSum& sum) const
    {
        const double reach = 0.5 * (std::abs(half.cosine) + std::abs(half.sine));
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const double across =
                    half.cosine * (x + 0.5 - kSide / 2) + half.sine * (y + 0.5 - kSide / 2);  // from the line
                if (std::abs(across) >= reach) continue;
                sum.add(static_cast<double>(coverage[static_cast<std::size_t>(y * kSide + x)]) -
                        exactCoverage(half.cosine, half.sine, -across));
            }
        }
    }
};

// Over lines in so many directions; `steepest`: those within so many degrees of an axis only.
Error engineError(int n, int angles, double steepest)
{
    Supersampled picture(n);
    ErrorSum sum;
    for (int i = 0; i < angles; ++i) {
        const double degrees = 360.0 * (i + 0.37) / angles, fromAxis = std::fmod(degrees + 45.0, 90.0) - 45.0;
        if (std::abs(fromAxis) > steepest) continue;
        const HalfPlane half(degrees * std::numbers::pi / 180.0);
        picture.draw(half);
        picture.addErrors(half, sum);
    }
    return sum.result();
}

}  // namespace

Experiment supersampling(Effort effort)
{
    Experiment e;
    e.id = "E-25";
    e.title = "Smooth edges by more samples";
    e.question =
        "With one sample a pixel is inside a triangle or not: edges are stairs. The engine has no multisampling; a "
        "picture drawn n times as wide and high, and averaged, is smooth. How far is a pixel's coverage from the "
        "exact area, over the pixels that an edge passes, in all directions? Averaging is in the times.";
    e.item = "finished pixel";
    e.unit = "parts of a pixel";
    const int angles = effort.samples(720, 240);
    for (const int n : {1, 2, 4, 8}) {
        const auto picture = std::make_shared<Supersampled>(n);
        const auto half = std::make_shared<const HalfPlane>(0.3);
        e.variants.push_back({std::to_string(n) + "x" + std::to_string(n),
                              "",
                              [=] {
                                  return Outcome(engineError(n, angles, 45.0),
                                                 {{"RMS within 5 degrees of an axis", engineError(n, angles, 5.0).rms},
                                                  {"levels", n * n + 1.0},
                                                  {"bytes of colour", 4.0 * n * n}});
                              },
                              {[=] { picture->draw(*half); }, kSide * kSide}});
    }
    struct Reference
    {
        int n;
        double max, rms;
    };
    for (const Reference& r : {Reference{1, .499749, .246875}, {4, .123286, .0304055}, {8, .0605561, .0106820}}) {
        const std::string grid = "a grid of " + std::to_string(r.n) + "x" + std::to_string(r.n) + ": ";
        const int offsets = effort.samples(2000, 500);
        e.checks.push_back({grid + "largest", r.max, [=] { return gridError(r.n, 720, offsets).max; }, 0.02 * r.max});
        e.checks.push_back({grid + "RMS", r.rms, [=] { return gridError(r.n, 720, offsets).rms; }, 0.02 * r.rms});
        e.checks.push_back(
            {"the engine, " + grid + "RMS", r.rms, [=] { return engineError(r.n, angles, 45.0).rms; }, 0.02 * r.rms});
    }
    e.finding = [](const Rows& rows) {
        const Row &one = rows("1x1"), &two = rows("2x2"), &four = rows("4x4"), &eight = rows("8x8");
        return "One sample is " + number(one.outcome.error.rms, 3) + " of a pixel off, 4 samples " +
               number(two.outcome.error.rms, 3) + ", 16 " + number(four.outcome.error.rms, 4) + ", 64 " +
               number(eight.outcome.error.rms, 4) +
               ": twice the width and height leave a third of the error, or less. "
               "Along an axis a grid helps least, since its samples stand in line: 16 samples are " +
               number(four.fact("RMS within 5 degrees of an axis"), 3) + " off there. A pixel takes " +
               number(one.fastest, 1) + ", " + number(two.fastest, 1) + ", " + number(four.fastest, 1) + " and " +
               number(eight.fastest, 1) + " ns.";
    };
    return e;
}

}  // namespace relief::experiments
