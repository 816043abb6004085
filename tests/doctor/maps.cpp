#include "maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#ifdef __GNUC__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image_write.h>
#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif

#include "relief/texture/color_space.h"
#include "relief/texture/dxt5.h"

namespace doctor_trials {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

Channels heightsOf(int size, const std::function<double(int x, int y)>& height)
{
    Channels heights{size, size, 0.0f, {}};
    heights.texels.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    double low = 1e9, high = -1e9;
    std::vector<double> values(heights.texels.size());
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double h = height(x, y);
            values[heights.at(x, y)] = h;
            low = std::min(low, h);
            high = std::max(high, h);
        }
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto h = static_cast<float>((values[i] - low) / (high - low));
        heights.texels[i] = {h, h, h, 1.0f};
    }
    return heights;
}

NormalField normalsOf(const Channels& heights, float scale)
{
    const Slopes slopes = slopesOfHeights(heights, scale);
    NormalField field{heights.width, heights.height, {}};
    for (std::size_t i = 0; i < slopes.u.size(); ++i) {
        const float length = std::sqrt(slopes.u[i] * slopes.u[i] + slopes.v[i] * slopes.v[i] + 1.0f);
        field.normals.push_back({-slopes.u[i] / length, -slopes.v[i] / length, 1.0f / length});
    }
    return field;
}

SoundMap mapOf(std::string name, Channels heights, float scale)
{
    NormalField field = normalsOf(heights, scale);
    return {std::move(name), std::move(heights), scale, std::move(field)};
}

// Sums of waves that repeat, of frequencies around `frequency`.
Channels noise(int size, double frequency, std::uint32_t seed)
{
    std::uint32_t state = seed * 2654435761u + 1u;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) / 16777216.0;
    };
    struct Wave
    {
        double u, v, phase, height;
    };
    std::vector<Wave> waves;
    for (int i = 0; i < 48; ++i) {
        const double angle = random() * kTwoPi, length = frequency * (0.4 + 1.2 * random());
        waves.push_back({std::round(std::cos(angle) * length), std::round(std::sin(angle) * length), random() * kTwoPi,
                         1.0 / (0.3 + length / frequency)});
    }
    return heightsOf(size, [&](int x, int y) {
        double sum = 0.0;
        for (const Wave& w : waves) sum += w.height * std::sin(kTwoPi * (w.u * x + w.v * y) / size + w.phase);
        return sum;
    });
}

// Weights 1 4 6 4 1 in both directions, `rounds` times: heights of 8 bits become smooth.
Channels smoothed(const Channels& from, int rounds)
{
    Channels now = from, next = from;
    for (int round = 0; round < 2 * rounds; ++round) {
        for (int y = 0; y < now.height; ++y) {
            for (int x = 0; x < now.width; ++x) {
                const auto h = [&](int k) {
                    return now.texels[round % 2 == 0 ? now.at(x + k, y) : now.at(x, y + k)][0];
                };
                const float value = (h(-2) + h(2) + 4.0f * (h(-1) + h(1)) + 6.0f * h(0)) / 16.0f;
                next.texels[now.at(x, y)] = {value, value, value, 1.0f};
            }
        }
        std::swap(now, next);
    }
    now.step = 0.0f;
    return now;
}

std::uint8_t codeOf(double unit)
{
    return static_cast<std::uint8_t>(std::clamp(std::floor(unit * 255.0 + 0.5), 0.0, 255.0));
}

// Every code of red, green and blue by itself.
Image8 eachCode(Image8 picture, const std::function<double(double unit, std::size_t channel)>& change)
{
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (i % 4 != 3) picture.pixels[i] = codeOf(change(picture.pixels[i] / 255.0, i % 4));
    }
    return picture;
}

Image8 eachNormal(const SoundMap& map, const std::function<void(Vector&, std::size_t texel)>& change)
{
    NormalField field = map.field;
    for (std::size_t i = 0; i < field.normals.size(); ++i) change(field.normals[i], i);
    return pictureOf(field);
}

Image8 mirrored(const SoundMap& map, bool red, bool green)
{
    return eachNormal(map, [=](Vector& n, std::size_t) {
        if (red) n[0] = -n[0];
        if (green) n[1] = -n[1];
    });
}

Image8 averaged(const SoundMap& map)
{
    constexpr int side = 4;
    NormalField half{map.field.width / side, map.field.height / side, {}};
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            Vector sum{};
            for (int i = 0; i < side * side; ++i) {
                const Vector& n = map.field.normals[map.field.at(side * x + i % side, side * y + i / side)];
                for (std::size_t c = 0; c < 3; ++c) sum[c] += n[c] / (side * side);
            }
            half.normals.push_back(sum);
        }
    }
    return pictureOf(half);
}

// Normals of codes, unit length, through a change of x and y.
Image8 ofFewLevels(const SoundMap& map, const std::function<float(float)>& change)
{
    return eachNormal(map, [&](Vector& n, std::size_t) {
        for (std::size_t c = 0; c < 2; ++c) n[c] = std::clamp(change(n[c]), -0.7f, 0.7f);
        n[2] = std::sqrt(std::max(0.0f, 1.0f - n[0] * n[0] - n[1] * n[1]));
    });
}

Image8 throughJpeg(const SoundMap& map)
{
    const Image8 codes = codesOf(map);
    std::vector<std::uint8_t> bytes;
    const auto write = [](void* to, void* data, int size) {
        auto& all = *static_cast<std::vector<std::uint8_t>*>(to);
        const auto* from = static_cast<const std::uint8_t*>(data);
        all.insert(all.end(), from, from + size);
    };
    stbi_write_jpg_to_func(write, &bytes, codes.width, codes.height, 4, codes.pixels.data(), 60);
    return std::get<Image8>(*decodeImage(std::move(bytes), "a JPEG file"));
}

Image8 throughDxt5(const SoundMap& map)
{
    Image8 codes = codesOf(map);
    for (int y = 0; y + 4 <= codes.height; y += 4) {
        for (int x = 0; x + 4 <= codes.width; x += 4) {
            Dxt5Texels texels;
            const auto at = [&](std::size_t i) {
                return (static_cast<std::size_t>(y + static_cast<int>(i) / 4) * static_cast<std::size_t>(codes.width) +
                        static_cast<std::size_t>(x + static_cast<int>(i) % 4)) *
                       4;
            };
            for (std::size_t i = 0; i < 16; ++i) std::copy_n(&codes.pixels[at(i)], 4, &texels[i * 4]);
            texels = decodeDxt5Block(encodeDxt5Block(texels));
            for (std::size_t i = 0; i < 16; ++i) std::copy_n(&texels[i * 4], 4, &codes.pixels[at(i)]);
        }
    }
    return codes;
}

// A part of the map, whose sides do not meet.
Image8 cropped(const SoundMap& map)
{
    NormalField part{map.field.width * 3 / 8, map.field.height * 3 / 8, {}};
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) part.normals.push_back(map.field.normals[map.field.at(x + 21, y + 33)]);
    }
    return pictureOf(part);
}

Image8 inAlpha(const SoundMap& map)
{
    Image8 picture = codesOf(map);
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
        picture.pixels[i + 3] = picture.pixels[i];
        picture.pixels[i] = picture.pixels[i + 2] = 255;
    }
    return picture;
}

}  // namespace

std::vector<SoundMap> soundMaps(const std::string& assetFolder)
{
    std::vector<SoundMap> maps;
    for (const char* name : {"marble", "bricks"}) {
        const Channels heights = channelsOf(*readImage(assetFolder + "/" + name + "-heights.png"));
        maps.push_back(mapOf(name, smoothed(heights, 6), 20.0f));
    }
    maps.push_back(mapOf("gentle noise", noise(256, 8.0, 1), 6.0f));
    maps.push_back(mapOf("strong noise", noise(256, 6.0, 2), 40.0f));
    maps.push_back(mapOf("fine noise", noise(256, 24.0, 3), 6.0f));
    maps.push_back(mapOf("broad noise", noise(512, 5.0, 4), 30.0f));
    maps.push_back(mapOf("domes",
                         heightsOf(256,
                                   [](int x, int y) {
                                       const double u = x % 64 / 32.0 - 1.0, v = y % 64 / 32.0 - 1.0;
                                       const double r = std::min(1.0, std::hypot(u, v) / 0.8);
                                       return std::pow(std::cos(r * std::numbers::pi / 2.0), 2.0);
                                   }),
                         16.0f));
    return maps;
}

Image8 codesOf(const SoundMap& map)
{
    return pictureOf(map.field);
}

const std::vector<MadeFault>& singleFaults()
{
    static const std::vector<MadeFault> all = {
        {"green upside down", {Fault::greenMirrored}, [](const SoundMap& m) { return mirrored(m, false, true); }},
        {"green upside down, with heights",
         {Fault::greenMirrored},
         [](const SoundMap& m) { return mirrored(m, false, true); },
         true},
        {"red mirrored, with heights",
         {Fault::redMirrored},
         [](const SoundMap& m) { return mirrored(m, true, false); },
         true},
        {"both mirrored, with heights",
         {Fault::bothMirrored},
         [](const SoundMap& m) { return mirrored(m, true, true); },
         true},
        {"x in alpha", {Fault::alphaGreen}, inAlpha},
        {"encoded as sRGB",
         {Fault::wasEncoded},
         [](const SoundMap& m) {
             return eachCode(codesOf(m), [](double c, std::size_t) {
                 return static_cast<double>(linearToSrgb(Float(static_cast<float>(c)))[0]);
             });
         }},
        {"decoded from sRGB",
         {Fault::wasDecoded},
         [](const SoundMap& m) { return eachCode(codesOf(m), [](double c, std::size_t) { return decodeSrgb(c); }); }},
        {"z below 0 in patches",
         {Fault::belowSurface},
         [](const SoundMap& m) {
             const int width = m.field.width;
             return eachNormal(m, [=](Vector& n, std::size_t i) {
                 const auto x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
                 if (x % 61 > 50 && y % 53 > 43 && x < 250 && y < 250) n[2] = -n[2];
             });
         }},
        {"flat is (134, 124)",
         {Fault::notFlat},
         [](const SoundMap& m) {
             return eachCode(codesOf(m), [](double c, std::size_t k) {
                 return c + (k == 0 ? 6.0 : k == 1 ? -4.0 : 0.0) / 255.0;
             });
         }},
        {"averaged", {Fault::averaged}, averaged},
        {"x and y twice as large",
         {Fault::notUnit},
         [](const SoundMap& m) { return eachNormal(m, [](Vector& n, std::size_t) { n[0] *= 2.0f, n[1] *= 2.0f; }); }},
        {"z at 0.6",
         {Fault::notUnit},
         [](const SoundMap& m) { return eachNormal(m, [](Vector& n, std::size_t) { n[2] *= 0.6f; }); }},
        {"quantised to 6 bits",
         {Fault::missingLevels},
         [](const SoundMap& m) { return ofFewLevels(m, [](float c) { return std::round(c * 31.5f) / 31.5f; }); }},
        {"stretched by 1.4",
         {Fault::missingLevels},
         [](const SoundMap& m) {
             return ofFewLevels(m, [](float c) { return std::round(c / 1.4f * 127.5f) / 127.5f * 1.4f; });
         }},
        {"JPEG of quality 60", {Fault::blocks}, throughJpeg},
        {"DXT5", {Fault::blocks}, throughDxt5},
        {"cropped", {Fault::seam}, cropped},
        {"strength twice along u, with heights",
         {Fault::wrongScale},
         [](const SoundMap& m) {
             return eachNormal(m, [](Vector& n, std::size_t) {
                 const float u = 2.0f * n[0] / n[2], v = n[1] / n[2], length = std::sqrt(u * u + v * v + 1.0f);
                 n = {u / length, v / length, 1.0f / length};
             });
         },
         true},
    };
    return all;
}

const std::vector<MadeFault>& doubleFaults()
{
    const auto encoded = [](const Image8& picture) {
        return eachCode(picture, [](double c, std::size_t) {
            return static_cast<double>(linearToSrgb(Float(static_cast<float>(c)))[0]);
        });
    };
    const auto decoded = [](const Image8& picture) {
        return eachCode(picture, [](double c, std::size_t) { return decodeSrgb(c); });
    };
    const auto shifted = [](const Image8& picture) {
        return eachCode(picture, [](double c, std::size_t k) {
            return c + (k == 0 ? 6.0 : k == 1 ? -4.0 : 0.0) / 255.0;
        });
    };
    const auto greenUpsideDown = [](const SoundMap& map) {
        SoundMap other = map;
        for (Vector& n : other.field.normals) n[1] = -n[1];
        return other;
    };
    static const std::vector<MadeFault> all = {
        {"green upside down, encoded as sRGB",
         {Fault::greenMirrored, Fault::wasEncoded},
         [=](const SoundMap& m) { return encoded(mirrored(m, false, true)); }},
        {"green upside down, decoded from sRGB",
         {Fault::greenMirrored, Fault::wasDecoded},
         [=](const SoundMap& m) { return decoded(mirrored(m, false, true)); }},
        {"green upside down, x in alpha",
         {Fault::greenMirrored, Fault::alphaGreen},
         [=](const SoundMap& m) { return inAlpha(greenUpsideDown(m)); }},
        {"green upside down, flat is (134, 124)",
         {Fault::greenMirrored, Fault::notFlat},
         [=](const SoundMap& m) { return shifted(mirrored(m, false, true)); }},
        {"green upside down, JPEG",
         {Fault::greenMirrored, Fault::blocks},
         [=](const SoundMap& m) { return throughJpeg(greenUpsideDown(m)); }},
        {"green upside down, DXT5",
         {Fault::greenMirrored, Fault::blocks},
         [=](const SoundMap& m) { return throughDxt5(greenUpsideDown(m)); }},
        {"green upside down, cropped",
         {Fault::greenMirrored, Fault::seam},
         [=](const SoundMap& m) { return cropped(greenUpsideDown(m)); }},
        {"green upside down, z at 0.6",
         {Fault::greenMirrored, Fault::notUnit},
         [](const SoundMap& m) { return eachNormal(m, [](Vector& n, std::size_t) { n[1] = -n[1], n[2] *= 0.6f; }); }},
        {"encoded as sRGB, flat is (134, 124)",
         {Fault::wasEncoded, Fault::notFlat},
         [=](const SoundMap& m) { return encoded(shifted(codesOf(m))); }},
        {"encoded as sRGB, cropped",
         {Fault::wasEncoded, Fault::seam},
         [=](const SoundMap& m) { return encoded(cropped(m)); }},
        {"x in alpha, both mirrored, with heights",
         {Fault::alphaGreen, Fault::bothMirrored},
         [](const SoundMap& m) {
             SoundMap other = m;
             for (Vector& n : other.field.normals) n[0] = -n[0], n[1] = -n[1];
             return inAlpha(other);
         },
         true},
    };
    return all;
}

Verdict verdictOf(const Diagnosis& diagnosis, const std::vector<Fault>& faults)
{
    Verdict verdict;
    for (const Fault fault : faults) verdict.named += diagnosis.has(fault);
    for (const Finding& finding : diagnosis.findings)
        verdict.others += std::find(faults.begin(), faults.end(), finding.fault) == faults.end();
    return verdict;
}

}  // namespace doctor_trials
