// E-25: smooth edges by more samples.
#include <numbers>

#include "experiments.h"
#include "relief/hlsl/intrinsics.h"
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

// --- in doubles: samples against every line ---

using Positions = std::vector<glm::dvec2>;  // from the pixel's centre

Positions gridOf(int n)
{
    Positions positions;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) positions.push_back({(x + 0.5) / n - 0.5, (y + 0.5) / n - 0.5});
    }
    return positions;
}
Positions patternOf(int samples)
{
    Positions positions;
    for (int s = 0; s < samples; ++s) {
        const auto [x, y] = samplePattern(samples)->position[static_cast<std::size_t>(s)];
        positions.push_back({x / 256.0, y / 256.0});
    }
    return positions;
}

Error errorOf(const Positions& positions, int angles, int offsets)
{
    ErrorSum sum;
    for (int i = 0; i < angles; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / angles, c = std::cos(angle), s = std::sin(angle);
        const double reach = 0.5 * (std::abs(c) + std::abs(s));
        for (int k = 0; k < offsets; ++k) {
            const double distance = reach * (2.0 * (k + 0.5) / offsets - 1.0);
            int inside = 0;
            for (const glm::dvec2& p : positions) inside += c * p.x + s * p.y < distance ? 1 : 0;
            sum.add(static_cast<double>(inside) / static_cast<double>(positions.size()) - exactCoverage(c, s, distance),
                    reach);
        }
    }
    return sum.result();
}

// --- by the engine: with so many samples a pixel, or a picture n times as wide and high, averaged ---

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

struct Smooth
{
    int samples = 1;  // a pixel
    int n = 1;        // times as wide and high
};

struct SmoothPicture
{
    int n;
    std::shared_ptr<SmallFrame> large;
    std::vector<float> coverage = std::vector<float>(kSide * kSide);

    explicit SmoothPicture(Smooth how)
        : n(how.n), large(smallFrame(kSide * n, kSide * n, Format::rgba32f, {.threads = 1}, how.samples))
    {
    }

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
Error engineError(Smooth how, int angles, double steepest)
{
    SmoothPicture picture(how);
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
        "With one sample a pixel is inside a triangle or not: edges are stairs. Several samples a pixel make them "
        "smooth "
        "(multisampling: coverage and depth at each, the program once), and so does a picture drawn n times as wide "
        "and "
        "high, and averaged (supersampling: everything n * n times). How far is a pixel's coverage from the exact "
        "area, "
        "over the pixels that an edge passes, in all directions? Averaging is in the times.";
    e.item = "finished pixel";
    e.unit = "parts of a pixel";
    const int angles = effort.samples(720, 240);
    struct Named
    {
        std::string name;
        Smooth how;
    };
    for (const Named& named : {Named{"1 sample", {1, 1}},
                               {"2 samples", {2, 1}},
                               {"4 samples", {4, 1}},
                               {"8 samples", {8, 1}},
                               {"2x2 pixels", {1, 2}},
                               {"4x4 pixels", {1, 4}},
                               {"8x8 pixels", {1, 8}}}) {
        const Smooth how = named.how;
        const auto picture = std::make_shared<SmoothPicture>(how);
        const auto half = std::make_shared<const HalfPlane>(0.3);
        const double samples = how.samples * how.n * how.n;
        e.variants.push_back({named.name,
                              "",
                              [=] {
                                  return Outcome(
                                      engineError(how, angles, 45.0),
                                      {{"RMS within 5 degrees of an axis", engineError(how, angles, 5.0).rms},
                                       {"levels", samples + 1.0},
                                       {"bytes of colour, in tiles", 4.0 * samples}});
                              },
                              {[=] { picture->draw(*half); }, kSide * kSide}});
    }
    struct Reference
    {
        std::string name;
        Positions positions;
        Smooth how;
        double max, rms;
    };
    for (const Reference& r : {Reference{"1 sample: ", gridOf(1), {1, 1}, .499749, .246875},
                               {"4 samples: ", patternOf(4), {4, 1}, .307683, .0917425},
                               {"8 samples: ", patternOf(8), {8, 1}, .226426, .0572788},
                               {"4x4 pixels: ", gridOf(4), {1, 4}, .123286, .0304055},
                               {"8x8 pixels: ", gridOf(8), {1, 8}, .0605561, .0106820}}) {
        const int offsets = effort.samples(2000, 500);
        e.checks.push_back(
            {r.name + "largest", r.max, [=] { return errorOf(r.positions, 720, offsets).max; }, 0.02 * r.max});
        e.checks.push_back(
            {r.name + "RMS", r.rms, [=] { return errorOf(r.positions, 720, offsets).rms; }, 0.02 * r.rms});
        e.checks.push_back({"the engine, " + r.name + "RMS", r.rms,
                            [=] { return engineError(r.how, angles, 45.0).rms; }, 0.02 * r.rms});
    }
    e.finding = [](const Rows& rows) {
        const Row &one = rows("1 sample"), &four = rows("4 samples"), &eight = rows("8 samples"),
                  &grid4 = rows("2x2 pixels"), &grid16 = rows("4x4 pixels"), &grid64 = rows("8x8 pixels");
        const auto rms = [](const Row& row) { return number(row.outcome.error.rms, 3); };
        const auto nearAxis = [](const Row& row) { return number(row.fact("RMS within 5 degrees of an axis"), 3); };
        return "One sample is " + rms(one) + " of a pixel off, 4 are " + rms(four) + ", 8 are " + rms(eight) +
               "; pictures of twice, four times and eight times the size " + rms(grid4) + ", " + rms(grid16) + " and " +
               rms(grid64) + ". Along an axis a grid helps least, since its samples stand in line: 4 in a square are " +
               nearAxis(grid4) + " off there, the pattern's 4 " + nearAxis(four) + ". A pixel takes " +
               number(one.fastest, 1) + " ns with one sample, " + number(four.fastest, 1) + " with 4, " +
               number(eight.fastest, 1) + " with 8; " + number(grid4.fastest, 1) + ", " + number(grid16.fastest, 1) +
               " and " + number(grid64.fastest, 1) +
               " in larger pictures, and there the program runs for each of them.";
    };
    return e;
}

}  // namespace relief::experiments
