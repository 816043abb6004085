// E-26: what a fragment's inputs lose when they are kept as halves.
#include <bit>
#include <numbers>

#include "experiments.h"
#include "half.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"

namespace relief::experiments {

namespace {

constexpr double kTexels = 1024.0;  // of the texture

// A fragment's inputs, kept in memory between two passes.
struct Inputs
{
    double u, v;
    Vector normal;
};

// uv in 0 ... range, and unit vectors in all directions.
std::vector<Inputs> inputs(std::size_t count, double range)
{
    std::mt19937 random(26);
    std::vector<Inputs> all;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = uniform(random) * range, v = uniform(random) * range;
        const double z = 2.0 * uniform(random) - 1.0, around = 2.0 * std::numbers::pi * uniform(random),
                     r = std::sqrt(1.0 - z * z);
        all.push_back({u, v, {r * std::cos(around), r * std::sin(around), z}});
    }
    return all;
}

float halves(double low, double high)
{
    const Int a = toHalf(static_cast<float>(low)), b = toHalf(static_cast<float>(high));
    return std::bit_cast<float>(a[0] | b[0] << 16);
}
Float low(Float word)
{
    return fromHalf(asInt(word));
}
Float high(Float word)
{
    return fromHalf(shiftRightLogical(asInt(word), 16));
}

// --- ways to keep them: words of a fragment, and the kernel that reads them ---

struct Floats
{
    static constexpr std::size_t kWords = 5;
    static void pack(const Inputs& i, Columns& c)
    {
        const double numbers[] = {i.u, i.v, i.normal.x, i.normal.y, i.normal.z};
        for (std::size_t k = 0; k < kWords; ++k) c[k].push_back(static_cast<float>(numbers[k]));
    }
    template <class Use>
    static auto kernel(Use use)
    {
        return [use](Float u, Float v, Float x, Float y, Float z) { return use(float2(u, v), float3(x, y, z)); };
    }
};

struct Halves
{
    static constexpr std::size_t kWords = 3;
    static void pack(const Inputs& i, Columns& c)
    {
        c[0].push_back(halves(i.u, i.v));
        c[1].push_back(halves(i.normal.x, i.normal.y));
        c[2].push_back(halves(i.normal.z, 0.0));
    }
    template <class Use>
    static auto kernel(Use use)
    {
        return [use](Float uv, Float xy, Float z) {
            return use(float2(low(uv), high(uv)), float3(low(xy), high(xy), low(z)));
        };
    }
};

struct HalfNormals
{
    static constexpr std::size_t kWords = 4;
    static void pack(const Inputs& i, Columns& c)
    {
        c[0].push_back(static_cast<float>(i.u));
        c[1].push_back(static_cast<float>(i.v));
        c[2].push_back(halves(i.normal.x, i.normal.y));
        c[3].push_back(halves(i.normal.z, 0.0));
    }
    template <class Use>
    static auto kernel(Use use)
    {
        return
            [use](Float u, Float v, Float xy, Float z) { return use(float2(u, v), float3(low(xy), high(xy), low(z))); };
    }
};

// uv as 16-bit fractions of the texture: what lies beyond a repetition is dropped.
struct Fractions
{
    static constexpr std::size_t kWords = 3;
    static void pack(const Inputs& i, Columns& c)
    {
        const auto code = [](double x) {
            return static_cast<std::uint32_t>((x - std::floor(x)) * 65536.0 + 0.5) & 65535u;
        };
        c[0].push_back(std::bit_cast<float>(code(i.u) | code(i.v) << 16));
        c[1].push_back(halves(i.normal.x, i.normal.y));
        c[2].push_back(halves(i.normal.z, 0.0));
    }
    template <class Use>
    static auto kernel(Use use)
    {
        return [use](Float uv, Float xy, Float z) {
            const Float u = Float(asInt(uv) & 65535), v = Float(shiftRightLogical(asInt(uv), 16));
            return use(float2(u, v) * 0x1p-16f, float3(low(xy), high(xy), low(z)));
        };
    }
};

// What the fragment needs: texels, and the light that falls on it.
constexpr auto lit = [](const float2& uv, const float3& normal) {
    return float3(uv.x * static_cast<float>(kTexels), uv.y * static_cast<float>(kTexels),
                  saturate(dot(normal, float3(0.36f, 0.48f, 0.8f))));
};
constexpr auto direction = [](const float2&, const float3& normal) { return normal; };

template <class Way>
Columns packed(const std::vector<Inputs>& all)
{
    Columns c(Way::kWords);
    for (const Inputs& i : all) Way::pack(i, c);
    return c;
}

// Texels, the shorter way around a texture that repeats.
double texelsOff(double measured, double exact)
{
    const double off = measured / kTexels - exact;
    return (off - std::round(off)) * kTexels;
}

struct Measured
{
    Error texels;
    double codes, degrees;  // worst
};

template <class Way>
Measured measured(std::size_t count, double range)
{
    const std::vector<Inputs> all = inputs(count, range);
    const Columns words = packed<Way>(all), results = evaluate<Way::kWords>(words, Way::kernel(lit)),
                  normals = evaluate<Way::kWords>(words, Way::kernel(direction));
    ErrorSum texels;
    double codes = 0.0, degrees = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        texels.add(texelsOff(results[0][i], all[i].u));
        texels.add(texelsOff(results[1][i], all[i].v));
        const Vector& n = all[i].normal;
        codes = std::fmax(codes, 255.0 * std::abs(results[2][i] - std::fmax(0.36 * n.x + 0.48 * n.y + 0.8 * n.z, 0.0)));
        degrees = std::fmax(degrees, degreesBetween(vectorAt(normals, i), n));
    }
    return {texels.result(), codes, degrees};
}

template <class Way>
void add(Experiment& e, const std::string& name, Effort effort)
{
    const auto timed = std::make_shared<const Columns>(packed<Way>(inputs(kStreamedItems, 1.0)));
    e.variants.push_back(laneVariant<Way::kWords>(name, "", timed, Way::kernel(lit), [=] {
        const auto count = static_cast<std::size_t>(effort.samples(1 << 18, 1 << 12));
        const Measured one = measured<Way>(count, 1.0), eight = measured<Way>(count, 8.0);
        return Outcome(one.texels, {{"bytes per fragment", Way::kWords * 4.0},
                                    {"worst texels, uv to 8", eight.texels.max},
                                    {"worst degrees", one.degrees},
                                    {"worst codes of light", one.codes}});
    }));
}

// The worst error of a half in low ... high, in texels.
double halfTexels(double lowest, double highest)
{
    const auto u = randomColumns({{lowest, highest}}, 1 << 14);
    const Columns halfU = evaluate<1>(*u, [](Float x) { return fromHalf(toHalf(x)); });
    double worst = 0.0;
    for (std::size_t i = 0; i < halfU[0].size(); ++i)
        worst =
            std::fmax(worst, kTexels * std::abs(static_cast<double>(halfU[0][i]) - static_cast<double>((*u)[0][i])));
    return worst;
}

}  // namespace

Experiment halfInterpolants(Effort effort)
{
    Experiment e;
    e.id = "E-26";
    e.title = "Interpolants as halves";
    e.question =
        "A half has 11 significant bits and takes half the memory of a float. A renderer that keeps each fragment's "
        "texture coordinate and normal between two passes could store them so. How many texels of a 1024 texture does "
        "that move a fragment, and its normal how far, and what does reading them back cost? Halves are unpacked in "
        "integers here, since not every processor has an instruction for it; beyond 65504 there are none.";
    e.item = "fragment";
    e.unit = "texels";
    add<Floats>(e, "floats", effort);
    add<HalfNormals>(e, "normal in halves", effort);
    add<Halves>(e, "all in halves", effort);
    add<Fractions>(e, "uv as fractions", effort);

    constexpr double kHalves[][3] = {{.25, .5, .125}, {.5, 1, .25}, {1, 2, .5}};
    for (const auto& row : kHalves)
        e.checks.push_back({"texels, halves from " + number(row[0], 2) + " to " + number(row[1], 2), row[2],
                            [from = row[0], to = row[1]] { return halfTexels(from, to); }, 1e-3 * row[2]});
    // Three components from 0.5 on, each off by half a step of 2^-11, all at right angles to the normal: never reached.
    // Of directions in rings (E-16) the worst is 0.0216786; random ones find worse.
    e.checks.push_back({"degrees, normals of halves", std::sqrt(3.0) * 0x1p-12 * 180.0 / std::numbers::pi,
                        [] { return measured<Halves>(1 << 15, 1.0).degrees; }, 0.0, true});
    e.checks.push_back({"bits of 70000 as a half, infinite", 0x7c00, [] { return toHalf(70000.0f)[0]; }, 0.0});
    // Steps of a float coordinate, in texels of a texture of 1024 and of one of 16384.
    constexpr double kSteps[][3] = {{1, 1.2207e-4, .00195313}, {256, .03125, .5}, {4096, .5, 8},
                                    {65536, 8, 128},           {1e6, 64, 1024},   {1e7, 1024, 16384}};
    for (const auto& row : kSteps) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double side = k == 0 ? 1024.0 : 16384.0;
            e.checks.push_back(
                {"texels of " + number(side, 0) + " that a float step is at " + number(row[0], 0), row[k + 1],
                 [=, u = static_cast<float>(row[0])] {
                     return side * (static_cast<double>(std::nextafter(u, HUGE_VALF)) - static_cast<double>(u));
                 },
                 1e-4 * row[k + 1]});
        }
    }
    e.finding = [](const Rows& rows) {
        const Row &floats = rows("floats"), &all = rows("all in halves"), &normal = rows("normal in halves"),
                  &fraction = rows("uv as fractions");
        const auto beside = [&floats](const Row& row) {
            return *row.streaming < 0.97 * *floats.streaming ? "less" : "no less";
        };
        const std::string times = floats.streaming
                                      ? " Read from memory that the first-level cache does not hold, floats take " +
                                            number(*floats.streaming, 2) + " ns and halves " +
                                            number(*all.streaming, 2) + ", which is " + beside(all) + "."
                                      : "";
        return "A texture coordinate in halves is up to " + number(all.outcome.error.max, 2) + " texels off, and " +
               number(all.fact("worst texels, uv to 8"), 1) +
               " where the texture repeats 8 times: visible as wobble. A normal in halves is at most " +
               number(normal.fact("worst degrees"), 3) + " degrees off, " +
               number(normal.fact("worst codes of light"), 2) +
               " codes of brightness: harmless. As 16-bit fractions coordinates need no more memory than halves and "
               "are within " +
               number(fraction.outcome.error.max, 4) + " texels. In the cache, reading takes " +
               number(floats.fastest, 2) + " ns in floats, " + number(all.fastest, 2) + " in halves and " +
               number(fraction.fastest, 2) + " with fractions." + times;
    };
    return e;
}

}  // namespace relief::experiments
