// E-04: a normal map baked beforehand, against slopes taken from heights in the fragment program.
#include "experiments.h"
#include "height_wave.h"
#include "lane_kernel.h"
#include "relief/texture/normal_map.h"
#include "relief/texture/sampler.h"

namespace relief::experiments {

namespace {

// The texel centres, or four points for each along u: magnified.
Columns points(bool magnified)
{
    Columns uv(2);
    for (int i = 0; i < 4 * kWaveTexels; ++i) {
        uv[0].push_back(static_cast<float>(magnified ? (i + 0.5) / 4.0 : i / 4 + 0.5));
        uv[1].push_back(static_cast<float>(i % 100 + 0.5));
    }
    return uv;
}

template <class Kernel>
Error errorOf(const Kernel& kernel, const HeightWave& wave, bool magnified)
{
    const Columns uv = points(magnified), normals = evaluate<2>(uv, kernel);
    ErrorSum sum;
    for (std::size_t i = 0; i < uv[0].size(); ++i) {
        const double u = uv[0][i], v = uv[1][i];
        sum.add(degreesBetween(vectorAt(normals, i), Vector{-wave.slopeU(u, v), -wave.slopeV(u, v), 1.0}));
    }
    return sum.result();
}

// In the fragment program: central differences over `delta` texels.
struct OnTheFly
{
    std::shared_ptr<const Texture> texture;
    sampler2D sampler;
    Float scale, delta;

    OnTheFly(const HeightWave& wave, int bits, double d)
        : texture(waveTexture(wave, bits)),
          sampler{.texture = texture.get(), .filter = Filter::bilinear, .mipmaps = false},
          scale(wave.scale() / d),
          delta(d * 0.5 / kWaveTexels)
    {
    }
    float3 operator()(Float u, Float v) const
    {
        const float2 uv = float2(u, v) * (1.0f / kWaveTexels);
        const auto height = [&](const float2& at) { return tex2D(sampler, at).x; };
        const Float hu = height(uv + float2(delta, 0)) - height(uv - float2(delta, 0));
        const Float hv = height(uv + float2(0, delta)) - height(uv - float2(0, delta));
        return normalize(float3(-hu * scale, -hv * scale, 1.0f));
    }
};

enum class Source
{
    heights8,
    heights16,
    analytic
};
enum class Stored
{
    rgb8,
    rgb16
};

// The normals of all texels, from heights as the importer takes them, or as they truly are.
MipLevel bakedNormals(const HeightWave& wave, Source source)
{
    HeightField heights{kWaveTexels, kWaveTexels, {}};
    MipLevel exact(TexelFormat::rgba32Float, kWaveTexels, kWaveTexels);
    for (int y = 0; y < kWaveTexels; ++y) {
        for (int x = 0; x < kWaveTexels; ++x) {
            const double u = x + 0.5, v = y + 0.5, su = wave.slopeU(u, v), sv = wave.slopeV(u, v);
            const double length = std::sqrt(su * su + sv * sv + 1.0);
            const double n[4] = {-su / length, -sv / length, 1.0 / length, 0.0};
            for (int i = 0; i < 4; ++i) exact.texel<float>(x, y)[i] = static_cast<float>(n[i]);
            heights.values.push_back(
                static_cast<float>(quantized(wave.height(u, v), source == Source::heights8 ? 8 : 16)));
        }
    }
    exact.fillFrame();
    if (source == Source::analytic) return exact;
    return normalsFromHeights(heights, static_cast<float>(wave.scale() / kWaveTexels), NormalFilter::sobel);
}

std::shared_ptr<const Texture> bakedTexture(const HeightWave& wave, Source source, Stored stored)
{
    const MipLevel normals = bakedNormals(wave, source);
    std::vector<std::uint8_t> eight;
    std::vector<std::uint16_t> sixteen;
    for (int y = kWaveTexels - 1; y >= 0; --y) {
        for (int x = 0; x < kWaveTexels; ++x) {
            for (int i = 0; i < 4; ++i) {
                const double code = static_cast<double>(normals.texel<float>(x, y)[i]) * 0.5 + 0.5;
                eight.push_back(static_cast<std::uint8_t>(code * 255.0 + 0.5));
                sixteen.push_back(static_cast<std::uint16_t>(code * 65535.0 + 0.5));
            }
        }
    }
    Expected<Texture> texture = stored == Stored::rgb8
                                    ? Texture::fromRgba8(kWaveTexels, kWaveTexels, eight, ColorSpace::linear)
                                    : Texture::fromRgba16(kWaveTexels, kWaveTexels, sixteen, ColorSpace::linear);
    return std::make_shared<const Texture>(std::move(*texture));
}

struct Baked
{
    std::shared_ptr<const Texture> texture;
    sampler2D sampler;

    Baked(const HeightWave& wave, Source source, Stored stored)
        : texture(bakedTexture(wave, source, stored)),
          sampler{.texture = texture.get(), .filter = Filter::bilinear, .mipmaps = false}
    {
    }
    float3 operator()(Float u, Float v) const
    {
        return normalize(tex2D(sampler, float2(u, v) * (1.0f / kWaveTexels)).xyz() * 2.0f - 1.0f);
    }
};

template <class MakeKernel>
void add(Experiment& e, const std::string& name, const std::string& parameter, double fetches, double texelBytes,
         MakeKernel make)
{
    e.variants.push_back(
        laneVariant<2>(name, parameter, randomColumns({{0.0, 256.0}, {0.0, 256.0}}), make(kWaveAlong), [=] {
            return Outcome(errorOf(make(kWaveAlong), kWaveAlong, true),
                           {{"RMS at texel centres", errorOf(make(kWaveAlong), kWaveAlong, false).rms},
                            {"RMS, wave across", errorOf(make(kWaveAcross), kWaveAcross, true).rms},
                            {"fetches", fetches},
                            {"bytes read", fetches * 4.0 * texelBytes}});
        }));
}

}  // namespace

Experiment bakedNormalMap(Effort)
{
    Experiment e;
    e.id = "E-04";
    e.title = "Baked normals against heights";
    e.question =
        "A normal map is the height map's slopes, taken once (here by the importer's Sobel filter) and stored as "
        "colours: one fetch in place of four, but rounded to the colours' bits. The same wave as in E-03, magnified "
        "four times.";
    e.item = "fragment";
    e.unit = "degrees";
    add(e, "heights, central", "8 bits, 1 texel", 4, 4, [](const HeightWave& w) { return OnTheFly(w, 8, 1.0); });
    add(e, "heights, central", "8 bits, 2 texels", 4, 4, [](const HeightWave& w) { return OnTheFly(w, 8, 2.0); });
    add(e, "heights, central", "16 bits, 1 texel", 4, 8, [](const HeightWave& w) { return OnTheFly(w, 16, 1.0); });
    const auto baked = [](Source source, Stored stored) {
        return [=](const HeightWave& w) { return Baked(w, source, stored); };
    };
    add(e, "baked, 8 bits", "8-bit heights", 1, 4, baked(Source::heights8, Stored::rgb8));
    add(e, "baked, 8 bits", "16-bit heights", 1, 4, baked(Source::heights16, Stored::rgb8));
    add(e, "baked, 8 bits", "true normals", 1, 4, baked(Source::analytic, Stored::rgb8));
    add(e, "baked, 16 bits", "16-bit heights", 1, 8, baked(Source::heights16, Stored::rgb16));
    add(e, "baked, 16 bits", "true normals", 1, 8, baked(Source::analytic, Stored::rgb16));

    // What is baked errs by what central differences two texels apart do at the texels, and by the colours' rounding:
    // 0.38 degrees of 8 bits at most (E-16).
    const auto atTexels = [](auto kernel) { return errorOf(kernel, kWaveAlong, false).max; };
    for (const auto& [source, bits, name] :
         {std::tuple{Source::heights8, 8, "8-bit heights"}, std::tuple{Source::heights16, 16, "16-bit heights"}}) {
        const double central = atTexels(OnTheFly(kWaveAlong, bits, 2.0));
        e.checks.push_back({std::string("baked to 8 bits from ") + name + ", largest at the texels", central + 0.37842,
                            [=, s = source] { return atTexels(Baked(kWaveAlong, s, Stored::rgb8)); }, 0.0, true});
        e.checks.push_back({std::string("baked to 16 bits from ") + name + ": what the rounding adds", 0.0,
                            [=, s = source] { return atTexels(Baked(kWaveAlong, s, Stored::rgb16)) - central; },
                            0.002});
    }
    e.finding = [](const Rows& rows) {
        const Row &fly = rows("heights, central", "8 bits, 1 texel"),
                  &wide = rows("heights, central", "8 bits, 2 texels"),
                  &coarse = rows("baked, 8 bits", "8-bit heights"), &fine = rows("baked, 8 bits", "16-bit heights"),
                  &deep = rows("baked, 16 bits", "16-bit heights");
        return "Baking takes one fetch in place of four: " + number(coarse.fastest, 2) + " ns against " +
               number(fly.fastest, 2) + ". Baked from 8-bit heights a map errs by " +
               number(coarse.outcome.error.rms, 3) + " degrees RMS, as differences over two texels do (" +
               number(wide.outcome.error.rms, 3) + "); from 16-bit heights by " + number(fine.outcome.error.rms, 3) +
               ", and what is left is the rounding of its own 8 bits: with 16 it is " +
               number(deep.outcome.error.rms, 3) + ". Bake from deep heights, even into 8-bit colours.";
    };
    return e;
}

}  // namespace relief::experiments
