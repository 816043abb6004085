// E-12: texture filters on a zone plate and on a checkered plane.
#include <complex>
#include <numbers>

#include "exact_srgb.h"
#include "experiments.h"
#include "lane_kernel.h"
#include "zone_and_plane.h"

namespace relief::experiments {

namespace {

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
    const FetchCounters before = shading.fetches;
    const Columns colors = evaluate<2>(exact.uv, kernel(sampler));
    const double taps = static_cast<double>(shading.fetches.taps - before.taps),
                 count = static_cast<double>(exact.pixels.size());
    ErrorSum all, ellipse, scenes[5];
    double differences = 0.0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
        const double value = static_cast<double>(colors[static_cast<std::size_t>(exact.pixels[i].channel)][i]);
        const double error = 255.0 * (encodedSrgb(value) - encodedSrgb(exact.box[i]));
        all.add(error);
        scenes[i / 16 % 5].add(error);
        ellipse.add(255.0 * (encodedSrgb(value) - encodedSrgb(exact.ellipse[i])));
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
        "checkered plane that is tilted away by 60 to 89.5 degrees (2 to 4 texels across a pixel), and what does a "
        "sample cost? The reference is the finest level, supersampled; beside it stands an elliptically weighted "
        "average, which is a little softer.";
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
    // pixel it does not: there a coarser level, which fewer samples ask for, can be nearer the mean than level 0.
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
                                                   "long, which seems to make up for the blur of the levels. "
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
