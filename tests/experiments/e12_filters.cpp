// E-12: texture filters on a zone plate and on a checkered plane.
#include <complex>
#include <numbers>

#include "experiments.h"
#include "lane_kernel.h"
#include "texture/sampler.h"

namespace relief::experiments {

namespace {

constexpr int kSide = 256;
constexpr double kPi = std::numbers::pi;

// Red is a zone plate, rings up to half a cycle per texel at the edge; green a checkerboard of 8x8 texels.
struct Patterns
{
    Texture texture;
    std::vector<double> values[2];

    Patterns() : texture(*Texture::fromRgba8(kSide, kSide, pixels(), ColorSpace::linear))
    {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                for (int c = 0; c < 2; ++c) values[c].push_back(static_cast<double>(texture.texel(x, y)[c]));
            }
        }
    }
    static std::vector<std::uint8_t> pixels()
    {
        std::vector<std::uint8_t> all;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const double dx = x - 127.5, dy = y - 127.5,
                             rings = 0.5 + 0.5 * std::cos(kPi * (dx * dx + dy * dy) / 256);
                all.insert(all.end(), {static_cast<std::uint8_t>(rings * 255.0 + 0.5),
                                       static_cast<std::uint8_t>(((x ^ y) & 8) != 0 ? 255 : 0), 0, 255});
            }
        }
        return all;
    }
    double texel(int channel, int x, int y) const
    {
        return values[channel][static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
    }
    double bilinear(int channel, double u, double v) const
    {
        const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), fx = u - 0.5 - x, fy = v - 0.5 - y;
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        return (texel(channel, i, j) * (1 - fx) + texel(channel, i + 1, j) * fx) * (1 - fy) +
               (texel(channel, i, j + 1) * (1 - fx) + texel(channel, i + 1, j + 1) * fx) * fy;
    }
};

const Patterns& patterns()
{
    static const Patterns all;
    return all;
}

// What a pixel sees: the zone plate face on, or the plane under a tilt, each at several minifications.
struct View
{
    int channel = 0;
    double texels = 1.0;  // per pixel, across
    double tilt = 0.0;    // radians
    double x = 0.0, y = 0.0, u = 0.0, v = 0.0;

    struct Point
    {
        double u, v;
    };
    Point operator()(double dx, double dy) const  // from the pixel's centre
    {
        constexpr double focalLength = 2000.0;  // pixels
        const double px = (x + dx) / focalLength, py = (y + dy) / focalLength, c = std::cos(tilt), s = std::sin(tilt);
        const double t = c / (py * s + c), across = t * px, along = t * py * c - (t - 1.0) * s;
        return {u + across * focalLength * texels, v + along * focalLength * texels};
    }
};

constexpr const char* kScenes[] = {"zone plate", "60 degrees", "80 degrees", "88 degrees", "89.5 degrees"};
constexpr double kTilts[] = {0.0, 60.0, 80.0, 88.0, 89.5};

// Pixels in blocks of 4x4, quad by quad; every scene in turn.
std::vector<View> views(std::size_t count)
{
    constexpr double zoneTexels[] = {1.0, 2.5, 6.0, 15.0, 32.0, 64.0}, planeTexels[] = {2.0, 3.0, 4.0};
    std::vector<View> all;
    std::mt19937 random(3);
    const auto between = [&random](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    for (std::size_t block = 0; all.size() < count; ++block) {
        View corner;
        const std::size_t scene = block % 5, turn = block / 5;
        corner.channel = scene == 0 ? 0 : 1;
        corner.texels = scene == 0 ? zoneTexels[turn % 6] : planeTexels[turn % 3];
        corner.tilt = kTilts[scene] * kPi / 180.0;
        corner.x = between(-100.0, 100.0);
        corner.y = between(-8.0, 8.0);
        corner.u = between(0.0, kSide);
        corner.v = between(0.0, kSide);
        for (int i = 0; i < 16; ++i) {
            View pixel = corner;
            pixel.x += i % 2 + i / 4 % 2 * 2;
            pixel.y += i / 2 % 2 + i / 8 * 2;
            all.push_back(pixel);
        }
    }
    return all;
}

// The mean of level 0 over the square of the pixel: n x n samples, each somewhere in its own cell.
double supersampled(const View& view, int n, std::mt19937& random)
{
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const double jx = static_cast<double>(random()) / 4294967296.0,
                     jy = static_cast<double>(random()) / 4294967296.0;
        const View::Point p = view((i % n + jx) / n - 0.5, (i / n + jy) / n - 0.5);
        sum += patterns().bilinear(view.channel, p.u, p.v);
    }
    return sum / (n * n);
}

// Elliptically weighted average (Heckbert 1989): a Gaussian over the ellipse of texels that a round pixel covers.
double ellipticallyWeighted(const View& view)
{
    const View::Point p = view(0, 0), r = view(0.5, 0), l = view(-0.5, 0), d = view(0, 0.5), t = view(0, -0.5);
    const double ux = r.u - l.u, vx = r.v - l.v, uy = d.u - t.u, vy = d.v - t.v;
    const double a = vx * vx + vy * vy + 1.0, b = -2.0 * (ux * vx + uy * vy), c = ux * ux + uy * uy + 1.0;
    const double f = a * c - b * b / 4.0, reachU = std::sqrt(c), reachV = std::sqrt(a);
    double sum = 0.0, weights = 0.0;
    for (int y = static_cast<int>(std::ceil(p.v - 0.5 - reachV)); y <= p.v - 0.5 + reachV; ++y) {
        for (int x = static_cast<int>(std::ceil(p.u - 0.5 - reachU)); x <= p.u - 0.5 + reachU; ++x) {
            const double du = x + 0.5 - p.u, dv = y + 0.5 - p.v, q = (a * du * du + b * du * dv + c * dv * dv) / f;
            if (q > 1.0) continue;
            const double weight = std::exp(-2.0 * q);
            sum += weight * patterns().texel(view.channel, x, y);
            weights += weight;
        }
    }
    return sum / weights;
}

double encoded(double linear)
{
    const double x = std::fmin(std::fmax(linear, 0.0), 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}
double lightness(double linear)  // CIE L*: of greys, all that a CIE76 difference consists of
{
    const double cubed = 216.0 / 24389.0;
    return linear > cubed ? 116.0 * std::cbrt(linear) - 16.0 : linear * 24389.0 / 27.0;
}

struct Reference
{
    std::vector<View> pixels;
    std::vector<double> box, ellipse;
    Columns uv{2};
};

Columns coordinates(const std::vector<View>& pixels)
{
    Columns uv(2);
    for (const View& pixel : pixels) {
        const View::Point p = pixel(0, 0);
        uv[0].push_back(static_cast<float>(p.u / kSide));
        uv[1].push_back(static_cast<float>(p.v / kSide));
    }
    return uv;
}

const Reference& reference(Effort effort)
{
    const auto make = [](std::size_t count, int samples) {
        Reference r;
        r.pixels = views(count);
        r.uv = coordinates(r.pixels);
        std::mt19937 random(7);
        for (const View& view : r.pixels) {
            r.box.push_back(supersampled(view, samples, random));
            r.ellipse.push_back(ellipticallyWeighted(view));
        }
        return r;
    };
    if (effort.full) {
        static const Reference full = make(16000, 48);
        return full;
    }
    static const Reference few = make(720, 16);
    return few;
}

auto kernel(const sampler2D& sampler)
{
    return [sampler](Float u, Float v) {
        const float4 color = tex2D(sampler, float2(u, v));
        return float2(color.x, color.y);
    };
}

Outcome outcomeOf(const sampler2D& sampler, const Reference& exact)
{
    const FetchCounters before = fetchCounters;
    const Columns colors = evaluate<2>(exact.uv, kernel(sampler));
    const double taps = static_cast<double>(fetchCounters.taps - before.taps),
                 count = static_cast<double>(exact.pixels.size());
    ErrorSum all, ellipse, scenes[5];
    double differences = 0.0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
        const double value = static_cast<double>(colors[static_cast<std::size_t>(exact.pixels[i].channel)][i]);
        const double error = 255.0 * (encoded(value) - encoded(exact.box[i]));
        all.add(error);
        scenes[i / 16 % 5].add(error);
        ellipse.add(255.0 * (encoded(value) - encoded(exact.ellipse[i])));
        differences += std::abs(lightness(value) - lightness(exact.box[i]));
    }
    const double perTap = sampler.filter == Filter::nearest ? 1.0 : sampler.filter == Filter::bilinear ? 4.0 : 8.0;
    Outcome outcome(all.result(), {{"texels read", perTap * (taps > 0.0 ? taps / count : 1.0)},
                                   {"mean ΔE", differences / count},
                                   {"RMS against EWA", ellipse.result().rms}});
    for (std::size_t s = 0; s < 5; ++s) outcome.facts.push_back({kScenes[s], scenes[s].result().rms});
    return outcome;
}

sampler2D sampler(Filter filter, bool mipmaps, int anisotropy)
{
    return {.texture = &patterns().texture, .filter = filter, .mipmaps = mipmaps, .maxAnisotropy = anisotropy};
}

// What is left of a sine of `frequency` cycles per texel, shown at so many texels per pixel: the mean over all phases,
// as a cosine in red and a sine in green together give it.
double amplitude(double frequency, double minification, bool mipmaps)
{
    constexpr int steps = 1 << 14;
    std::vector<float> pixels;
    for (int x = 0; x < kSide; ++x) {
        const std::complex<double> wave = std::polar(1.0, 2.0 * kPi * frequency * (x + 0.5));
        pixels.insert(pixels.end(), {static_cast<float>(wave.real()), static_cast<float>(wave.imag()), 0.0f, 1.0f});
    }
    const Texture waves = *Texture::fromRgbaFloat(kSide, 1, pixels);
    const sampler2D s = {.texture = &waves, .mipmaps = mipmaps};
    Columns u(1);
    for (int i = 0; i < steps; ++i) u[0].push_back(static_cast<float>((i + 0.5) / steps));
    const Float level = static_cast<float>(std::log2(minification));
    const Columns sampled = evaluate<1>(u, [&](Float x) {
        const float4 color = tex2Dlod(s, float4(x, Float(0.5f), Float(0.0f), level));
        return float2(color.x, color.y);
    });
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < u[0].size(); ++i)
        sum += std::complex<double>(sampled[0][i], sampled[1][i]) *
               std::polar(1.0 / steps, -2.0 * kPi * frequency * kSide * static_cast<double>(u[0][i]));
    return std::abs(sum);
}

}  // namespace

Experiment filters(Effort effort)
{
    Experiment e;
    e.id = "E-12";
    e.title = "Texture filters";
    e.question =
        "A pixel shows the mean of all the texels that it covers; a filter looks at a few texels of a mip level "
        "instead. How far from the mean are the filters, on a zone plate at 1 to 64 texels per pixel and on a "
        "checkered "
        "plane that is tilted away by 60 to 89.5 degrees (2 to 4 texels across a pixel), and what does a sample cost? "
        "The reference is the finest "
        "level, supersampled; beside it stands an elliptically weighted average, which is a little softer.";
    e.item = "sample";
    e.unit = "codes of 255";
    const auto timed = std::make_shared<const Columns>(coordinates(views(kStreamedItems)));
    const auto add = [&](const std::string& name, const std::string& parameter, const sampler2D& s) {
        e.variants.push_back(
            laneVariant<2>(name, parameter, timed, kernel(s), [=] { return outcomeOf(s, reference(effort)); }));
    };
    add("nearest", "no mips", sampler(Filter::nearest, false, 1));
    add("bilinear", "no mips", sampler(Filter::bilinear, false, 1));
    add("nearest", "", sampler(Filter::nearest, true, 1));
    add("bilinear", "", sampler(Filter::bilinear, true, 1));
    add("trilinear", "", sampler(Filter::trilinear, true, 1));
    for (const int n : {2, 4, 8, 16})
        add("anisotropic", "up to " + std::to_string(n), sampler(Filter::trilinear, true, n));

    // Texels per cycle and per pixel; the amplitude that is left with mip levels and without.
    struct Wave
    {
        double period, minification, trilinear, bilinear;
    };
    constexpr Wave kWaves[] = {{16, 1.5, .954562, .987215}, {16, 4, .734479, .987215}, {16, 8, .259678, .987215},
                               {8, 2, .748869, .949641},    {8, 4, .264765, .949641},  {8, 6, .109887, .949641},
                               {4, 1.5, .504055, .810569},  {4, 3, .118941, .810569},  {4, 6, 0, .810569}};
    for (const Wave& w : kWaves) {
        const std::string of =
            " of a wave of " + number(w.period, 0) + " texels at " + number(w.minification, 1) + " a pixel";
        e.checks.push_back({"trilinear amplitude" + of, w.trilinear,
                            [w] { return amplitude(1.0 / w.period, w.minification, true); }, 2e-3});
        e.checks.push_back({"amplitude without mips" + of, w.bilinear,
                            [w] { return amplitude(1.0 / w.period, w.minification, false); }, 1e-4});
    }
    // Each doubling of the samples comes closer to the mean, over all scenes. On planes at less than 2 texels across a
    // pixel it does not: there a coarser level, which fewer samples ask for, happens to be nearer the mean than level
    // 0.
    for (int n = 2; n <= 16; n *= 2) {
        const auto rms = [effort](int taps) {
            return outcomeOf(sampler(Filter::trilinear, true, taps), reference(effort)).error.rms;
        };
        e.checks.push_back({"RMS of up to " + std::to_string(n) + " samples, by that of half as many", 1.0,
                            [=] { return rms(n) / rms(n / 2); }, 0.0, true});
    }
    e.finding = [](const Rows& rows) {
        const Row &none = rows("bilinear", "no mips"), &tri = rows("trilinear"),
                  &full = rows("anisotropic", "up to 16");
        const double two = rows("anisotropic", "up to 2").fact(kScenes[1]),
                     four = rows("anisotropic", "up to 4").fact(kScenes[1]);
        const std::string lucky = two < four ? "More samples are not always better: at 60 degrees the error is " +
                                                   number(two, 1) + " with up to 2 and " + number(four, 1) +
                                                   " with up to 4, since two lie closer together than the footprint is "
                                                   "long, which makes up for the blur of the levels. "
                                             : "";
        return "Without mip levels the RMS error is " + number(none.outcome.error.rms, 1) + " codes, trilinear " +
               number(tri.outcome.error.rms, 1) + ", with up to 16 samples along the footprint " +
               number(full.outcome.error.rms, 1) + ". On the plane at 80 degrees trilinear is " +
               number(tri.fact(kScenes[2]), 1) + " off because it blurs, anisotropic " +
               number(full.fact(kScenes[2]), 1) + "; on the zone plate the two are alike. " + lucky +
               "A sample costs " + number(none.fastest, 1) + ", " + number(tri.fastest, 1) + " and " +
               number(full.fastest, 1) + " ns for " + number(full.fact("texels read"), 0) + " texels instead of 8.";
    };
    return e;
}

}  // namespace relief::experiments
