// E-14: how a coarser mip level is made of colours and of normals.
#include "exact_srgb.h"
#include "experiments.h"
#include "lane_kernel.h"
#include "relief/hlsl/intrinsics.h"
#include "relief/texture/color_space.h"
#include "relief/texture/normal_map.h"
#include "sine_normals.h"

namespace relief::experiments {

namespace {

constexpr int kSide = 128;

// --- colours: one-texel checkers on the left, random codes on the right; three channels ---

std::uint8_t codeAt(int x, int y, std::mt19937& random)
{
    if (x < kSide / 2) return (x + y) % 2 != 0 ? 255 : 0;
    return static_cast<std::uint8_t>(random() >> 24);
}

// `store` turns a code into what the level holds.
template <class Channel, class Store>
MipLevel pictureLevel(TexelFormat format, Store store)
{
    std::mt19937 random(9);
    MipLevel level(format, kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            for (int c = 0; c < 3; ++c) level.texel<Channel>(x, y)[c] = store(codeAt(x, y, random));
        }
    }
    return level;
}

// Codes decoded, averaged and encoded again: what graphics hardware does for textures of sRGB codes.
MipLevel coarserDecoded(const MipLevel& fine)
{
    MipLevel coarse(TexelFormat::rgba8, nextSide(fine.width()), nextSide(fine.height()));
    std::vector<float> row(static_cast<std::size_t>(coarse.width()) * 4 + 16);
    for (int y = 0; y < coarse.height(); ++y) {
        const std::uint8_t *a = fine.texel<std::uint8_t>(0, 2 * y), *b = fine.texel<std::uint8_t>(0, 2 * y + 1);
        const std::size_t numbers = static_cast<std::size_t>(coarse.width()) * 4;
        for (std::size_t i = 0; i < numbers; ++i) {
            const std::size_t at = i / 4 * 8 + i % 4;
            row[i] =
                0.25f * (srgbToLinear(a[at]) + srgbToLinear(a[at + 4]) + srgbToLinear(b[at]) + srgbToLinear(b[at + 4]));
        }
        for (std::size_t i = 0; i < numbers; i += kLanes)
            (linearToSrgb(Float::load(&row[i])) * 255.0f + 0.5f).store(&row[i]);
        std::uint8_t* out = coarse.texel<std::uint8_t>(0, y);
        for (std::size_t i = 0; i < numbers; ++i) out[i] = static_cast<std::uint8_t>(row[i]);
    }
    return coarse;
}

// --- normals: two waves across each other ---

MipLevel normalLevel()
{
    MipLevel level(TexelFormat::rgba32Float, kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double right = 0.6 * std::sin(0.7 * x + 0.2 * y), up = 0.4 * std::sin(0.5 * y - 0.3 * x);
            const double length = std::sqrt(right * right + up * up + 1.0);
            float* n = level.texel<float>(x, y);
            n[0] = static_cast<float>(-right / length);
            n[1] = static_cast<float>(-up / length);
            n[2] = static_cast<float>(1.0 / length);
        }
    }
    return level;
}

// The exact mean of each texel's part of level 0, in double, in the level of that number.
std::vector<Vector> means(const std::vector<Vector>& finest, int level)
{
    const int side = kSide >> level, part = 1 << level;
    std::vector<Vector> all(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), {0, 0, 0});
    const double share = 1.0 / (part * part);
    for (int i = 0; i < kSide * kSide; ++i) {
        const Vector& v = finest[static_cast<std::size_t>(i)];
        Vector& mean = all[static_cast<std::size_t>((i / kSide / part) * side + i % kSide / part)];
        mean = {mean.x + v.x * share, mean.y + v.y * share, mean.z + v.z * share};
    }
    return all;
}

template <class Decode>
std::vector<Vector> values(const MipLevel& level, Decode decode)
{
    std::vector<Vector> all;
    for (int y = 0; y < level.height(); ++y) {
        for (int x = 0; x < level.width(); ++x) all.push_back(decode(level, x, y));
    }
    return all;
}

// The chain from a level by `coarser`, each level against the means of the finest; `errorOf` adds up a texel's errors.
template <class Coarser, class Decode, class ErrorOf>
Error chainError(const MipLevel& finest, const std::vector<Vector>& exact, Coarser coarser, Decode decode,
                 ErrorOf errorOf, int levels)
{
    ErrorSum sum;
    MipLevel level = finest;
    for (int k = 1; k <= levels; ++k) {
        level = coarser(level);
        const std::vector<Vector> mean = means(exact, k), made = values(level, decode);
        for (std::size_t i = 0; i < mean.size(); ++i) errorOf(sum, made[i], mean[i], std::pow(4.0, k));
    }
    return sum.result();
}

void codesOff(ErrorSum& sum, const Vector& made, const Vector& mean, double weight)
{
    sum.add(255.0 * (encodedSrgb(made.x) - encodedSrgb(mean.x)), weight);
    sum.add(255.0 * (encodedSrgb(made.y) - encodedSrgb(mean.y)), weight);
    sum.add(255.0 * (encodedSrgb(made.z) - encodedSrgb(mean.z)), weight);
}

// Of Lambert's N.L under four lights, 40 degrees from upright. The mean of N.L is the mean normal's.
void brightnessOff(ErrorSum& sum, const Vector& made, const Vector& mean, double weight)
{
    for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const auto lit = [sideways = 0.642788, up = 0.766044, lx = x, ly = y](const Vector& n) {
            return sideways * (lx * n.x + ly * n.y) + up * n.z;
        };
        sum.add(255.0 * (lit(made) - lit(mean)), weight);
    }
}

template <class Channel, class FromChannel>
auto decodeBy(FromChannel from)
{
    return [from](const MipLevel& level, int x, int y) {
        const Channel* t = level.texel<Channel>(x, y);
        return Vector{from(t[0]), from(t[1]), from(t[2])};
    };
}

template <class Coarser, class Decode, class ErrorOf>
Variant variant(const std::string& name, const std::string& parameter, const MipLevel& finest,
                const std::vector<Vector>& exact, Coarser coarser, Decode decode, ErrorOf errorOf, double bytes,
                Effort effort)
{
    const auto level = std::make_shared<const MipLevel>(finest);
    return {name,
            parameter,
            [=] {
                const auto errorTo = [&](int levels) {
                    return chainError(*level, exact, coarser, decode, errorOf, levels);
                };
                return Outcome(errorTo(effort.samples(7, 4)), {{"bytes per texel", bytes},
                                                               {"RMS of level 1", errorTo(1).rms},
                                                               {"of levels 1 to 3", errorTo(3).rms}});
            },
            {[level, coarser] {
                 const MipLevel coarse = coarser(*level);
                 asm volatile("" : : "r"(coarse.texels()) : "memory");
             },
             kSide * kSide / 4.0}};
}

}  // namespace

Experiment mipGeneration(Effort effort)
{
    Experiment e;
    e.id = "E-14";
    e.title = "Making mip levels";
    e.question =
        "A coarser texel is the mean of those that it covers: of linear light, not of sRGB codes. Of normals the mean "
        "is shorter than 1, and making it unit length again is usual. How wrong do the levels of checkers and noise "
        "become in other ways than the engine's, which decodes to 16 bits once, and what does a texel cost to make? "
        "For normals, an error is one of Lambert's brightness.";
    e.item = "texel";
    e.unit = "codes of 255";
    const auto same = [](std::uint8_t code) { return code; };
    const MipLevel codes = pictureLevel<std::uint8_t>(TexelFormat::rgba8, same);
    const MipLevel linear16 =
        pictureLevel<std::uint16_t>(TexelFormat::rgba16, [](std::uint8_t code) { return srgbToLinear16(code); });
    const MipLevel linear8 = pictureLevel<std::uint8_t>(TexelFormat::rgba8, [](std::uint8_t code) {
        return static_cast<std::uint8_t>(255.0 * decodeSrgb(code / 255.0) + 0.5);
    });
    const auto fromCode = decodeBy<std::uint8_t>([](std::uint8_t c) { return decodeSrgb(c / 255.0); });
    const std::vector<Vector> light = values(codes, fromCode);
    const auto by = [](TexelFormat format) {
        return [format](const MipLevel& fine) { return coarserLevel(format, fine); };
    };
    e.variants.push_back(variant("colours", "linear, 16 bits", linear16, light, by(TexelFormat::rgba16),
                                 decodeBy<std::uint16_t>([](std::uint16_t c) { return c / 65535.0; }), codesOff, 8,
                                 effort));
    e.variants.push_back(variant("colours", "linear, 8 bits", linear8, light, by(TexelFormat::rgba8),
                                 decodeBy<std::uint8_t>([](std::uint8_t c) { return c / 255.0; }), codesOff, 4,
                                 effort));
    e.variants.push_back(variant(
        "colours", "codes, decoded", codes, light, [](const MipLevel& l) { return coarserDecoded(l); }, fromCode,
        codesOff, 4, effort));
    e.variants.push_back(
        variant("colours", "codes as they are", codes, light, by(TexelFormat::rgba8), fromCode, codesOff, 4, effort));
    const auto asItIs = decodeBy<float>([](float v) { return static_cast<double>(v); });
    const MipLevel normals = normalLevel();
    const std::vector<Vector> directions = values(normals, asItIs);
    e.variants.push_back(variant("normals", "length kept", normals, directions, by(TexelFormat::rgba32Float), asItIs,
                                 brightnessOff, 16, effort));
    const auto renormalized = [](const MipLevel& l) {
        return normalizedNormals(coarserLevel(TexelFormat::rgba32Float, l));
    };
    e.variants.push_back(
        variant("normals", "unit length", normals, directions, renormalized, asItIs, brightnessOff, 16, effort));

    e.checks.push_back({"checkers, linear light in 16 bits: code", 188,
                        [=] {
                            const MipLevel level = coarserLevel(TexelFormat::rgba16, linear16);
                            return std::floor(255.0 * encodedSrgb(level.texel<std::uint16_t>(0, 0)[0] / 65535.0) + 0.5);
                        },
                        0.0});
    e.checks.push_back({"checkers, codes decoded: code", 188,
                        [=] { return coarserDecoded(codes).texel<std::uint8_t>(0, 0)[0]; }, 0.0});
    e.checks.push_back({"checkers, codes as they are: code", 128,
                        [=] { return coarserLevel(TexelFormat::rgba8, codes).texel<std::uint8_t>(0, 0)[0]; }, 0.0});
    e.checks.push_back({"checkers, exact: code before rounding", 187.516,
                        [=] { return 255.0 * encodedSrgb(means(light, 1)[0].x); }, 1e-3});
    constexpr double kLengths[][2] = {{.1, .997514}, {.3, .978572}, {.5, .945006}, {1, .834627}, {2, .642638}};
    for (const auto& row : kLengths) {
        e.checks.push_back({"mean normal's length, slopes " + number(row[0], 1) + " sin t", row[1],
                            [slope = row[0], effort] {
                                const MipLevel mean = coarsest(sineNormals(slope, effort.samples(16384, 1024)));
                                const float* n = mean.texel<float>(0, 0);
                                return std::sqrt(static_cast<double>(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
                            },
                            1e-5});
    }
    e.finding = [](const Rows& rows) {
        const Row &engine = rows("colours", "linear, 16 bits"), &codes8 = rows("colours", "codes as they are"),
                  &dark = rows("colours", "linear, 8 bits"), &decoded = rows("colours", "codes, decoded");
        const Row &unit = rows("normals", "unit length"), &kept = rows("normals", "length kept");
        return "Averaging sRGB codes turns checkers to code 128 instead of 188, an error of up to " +
               number(codes8.outcome.error.max, 0) + " codes, and takes " + number(codes8.fastest, 2) +
               " ns per texel; the engine's 16 bits of linear light are off by " + number(engine.outcome.error.max, 3) +
               " and take " + number(engine.fastest, 2) + ". Linear light in 8 bits loses " +
               number(dark.outcome.error.max, 1) + " codes, and decoding and encoding at every level " +
               number(decoded.outcome.error.max, 1) + " at " + number(decoded.fastest, 1) +
               " ns. Normals of unit length make a rough surface up to " + number(unit.outcome.error.max, 0) +
               " codes too bright; the mean as it is gives exactly the mean of Lambert's brightness (" +
               number(kept.outcome.error.max, 5) + ").";
    };
    return e;
}

}  // namespace relief::experiments
