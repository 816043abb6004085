// Makes the textures of the samples: marble-albedo.png (sRGB colour), marble-heights.png (linear grey, 0 in the
// cracks), marble-detail.png (sRGB grey about 0.5), bricks-albedo.png and bricks-heights.png (bricks.h), and
// inlay-albedo.png, inlay-mask.png and inlay-emission.png (inlay.h). 512 x 512
// pixels each, tileable, the same bytes on every machine. Usage: make_textures OUTPUT_DIR
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bricks.h"
#include "inlay.h"
#include "noise.h"
#include "relief/texture/image.h"

namespace {

using namespace textures;

// One number per texel of a picture that continues at its opposite edges.
class Field
{
public:
    explicit Field(const std::function<float(float x, float y)>& value)  // x and y in 0..1
    {
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                at(x, y) = value(static_cast<float>(x) / kSize, static_cast<float>(y) / kSize);
            }
        }
    }

    float& at(int x, int y) { return values[index(x, y)]; }
    float at(int x, int y) const { return values[index(x, y)]; }

    // The steepest slope per texel, averaged over the neighbourhood: on a ridge alone it would be 0.
    float slope(int x, int y) const
    {
        constexpr int kReach = 3;
        float sum = 0;
        for (int dy = -kReach; dy <= kReach; dy += kReach) {
            for (int dx = -kReach; dx <= kReach; dx += kReach) {
                const float alongX = 0.5f * (at(x + dx + 1, y + dy) - at(x + dx - 1, y + dy));
                const float alongY = 0.5f * (at(x + dx, y + dy + 1) - at(x + dx, y + dy - 1));
                sum += std::sqrt(alongX * alongX + alongY * alongY);
            }
        }
        return sum / 9.0f;
    }

    float mean() const
    {
        double sum = 0;
        for (const float value : values) sum += static_cast<double>(value);
        return static_cast<float>(sum / static_cast<double>(values.size()));
    }

private:
    static std::size_t index(int x, int y)
    {
        return static_cast<std::size_t>(y & (kSize - 1)) * kSize + static_cast<std::size_t>(x & (kSize - 1));
    }

    std::vector<float> values = std::vector<float>(static_cast<std::size_t>(kSize) * kSize);
};

// A field whose zero lines are veins. They run diagonally, because x and y enter through an integer matrix (which keeps
// the picture tileable), and meander, because the place is displaced by noise first.
Field veinField(int cellsAcross, int cellsAlong, float displacement, std::uint32_t seed)
{
    return Field([=](float x, float y) {
        const float dx = displacement * fractal(x, y, 3, 3, 4, 0.5f, seed + 100);
        const float dy = displacement * fractal(x, y, 3, 3, 4, 0.5f, seed + 200);
        const float px = x + dx;
        const float py = y + dy;
        return fractal(px + py, 2.0f * py - px, cellsAcross, cellsAlong, 2, 0.35f, seed);
    });
}

// A texel's place in the neighbourhood of a vein, which is a zero line of a field.
struct VeinPlace
{
    float distance = 0;  // in texels, to first order: the field's value by its slope
    float strength = 0;  // 0..1; less where the field is so flat that its zero line would widen to a blot
};

VeinPlace placeInVein(const Field& field, int x, int y)
{
    const float slope = field.slope(x, y);
    return {std::fabs(field.at(x, y)) / std::max(slope, 0.002f), smoothstep(0.003f, 0.009f, slope)};
}

// What lies at one texel: everything that the pictures share.
struct Marble
{
    float outside = 0;  // texels to the nearest crack's edge, negative inside of the crack
    float stain = 0;    // 0..1, what has soaked into the stone around a crack; more where the crack is wide
    float dark = 0;     // 0..1, how much of a crack's own colour
    float vein = 0;     // 0..1, how much of a fine vein
    float cloud = 0;    // about -0.7..0.7, large light and dark areas
};

struct Fields
{
    Field cracks = veinField(2, 1, 0.22f, 11);
    Field crossCracks = veinField(1, 2, 0.30f, 23);
    Field veins = veinField(3, 2, 0.35f, 37);
    Field clouds = Field([](float x, float y) { return fractal(x, y, 3, 3, 5, 0.5f, 51); });
    Field presence = Field([](float x, float y) { return fractal(x, y, 4, 4, 2, 0.5f, 67); });
};

// Puts a crack with the given half width, in texels, into the marble. A half width below 0 is no crack.
void addCrack(Marble& marble, float distance, float halfWidth)
{
    const float outside = distance - halfWidth;
    const float beyond = std::max(outside, 0.0f);
    const float wide = smoothstep(-0.5f, 3.0f, halfWidth);
    marble.outside = std::min(marble.outside, outside);
    marble.stain = std::max(marble.stain, wide / (1.0f + beyond * beyond * (1.0f / 70.0f)));
    marble.dark = std::max(marble.dark, mix(0.5f, 1.0f, wide) * (1.0f - smoothstep(-1.2f, 1.6f, outside)));
}

Marble marbleAt(const Fields& fields, int x, int y)
{
    const float presence = fields.presence.at(x, y);
    const VeinPlace main = placeInVein(fields.cracks, x, y);
    const VeinPlace cross = placeInVein(fields.crossCracks, x, y);
    const VeinPlace fine = placeInVein(fields.veins, x, y);

    Marble marble;
    marble.outside = 1000.0f;
    addCrack(marble, main.distance, (2.1f + 1.6f * presence) * main.strength);
    addCrack(marble, cross.distance, (0.9f + 5.0f * presence) * cross.strength);  // these come and go
    const float fineness = fine.distance * (1.0f / 1.8f);
    marble.vein = fine.strength * smoothstep(-0.35f, 0.25f, -presence) / (1.0f + fineness * fineness);
    marble.cloud = fields.clouds.at(x, y);
    return marble;
}

// 0 in the cracks, from 0.4 at their edges up to 1 on the rolling surface.
float heightAt(const Fields& fields, int x, int y)
{
    const Marble marble = marbleAt(fields, x, y);
    if (marble.outside <= 0) return 0;
    const float u = static_cast<float>(x) / kSize;
    const float v = static_cast<float>(y) / kSize;
    const float rolling = 0.76f + 0.26f * fractal(u + v, v - u, 6, 6, 2, 0.5f, 71) +
                          0.06f * fractal(2 * u + v, 2 * v - u, 14, 14, 2, 0.5f, 83);
    const float surface = std::clamp(rolling - 0.10f * marble.vein, 0.45f, 1.0f);
    const float shoulder = smoothstep(0.0f, 14.0f, marble.outside);  // rounded edges
    return mix(0.42f, surface, shoulder) * smoothstep(-0.5f, 1.5f, marble.outside);
}

Colour albedoAt(const Fields& fields, int x, int y)
{
    constexpr Colour kWhite = {244, 239, 230};
    constexpr Colour kCream = {226, 212, 190};
    constexpr Colour kGrey = {196, 190, 184};
    constexpr Colour kVein = {158, 143, 127};
    constexpr Colour kCrack = {88, 76, 66};
    const Marble marble = marbleAt(fields, x, y);
    const float u = static_cast<float>(x) / kSize;
    const float v = static_cast<float>(y) / kSize;

    Colour colour = mix(kWhite, kCream, smoothstep(-0.1f, 0.6f, marble.cloud));
    colour = mix(colour, kGrey, 0.85f * smoothstep(0.05f, 0.6f, -marble.cloud));
    colour = mix(colour, kVein, 0.75f * marble.vein);
    colour = mix(colour, kVein, 0.7f * marble.stain);
    colour = mix(colour, kCrack, marble.dark);
    const float grain = 8.0f * fractal(2 * u + v, 2 * v - u, 28, 28, 3, 0.7f, 97);
    for (float& channel : colour) channel += grain;
    return colour;
}

std::uint8_t toByte(float value)
{
    return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
}

using ColourAndAlpha = std::array<float, 4>;

// Writes codes; returns whether it worked and says why not.
bool writeWithAlpha(const std::filesystem::path& path, const std::function<ColourAndAlpha(int x, int y)>& colourAt)
{
    std::vector<std::uint8_t> pixels;
    pixels.reserve(static_cast<std::size_t>(kSize) * kSize * 4);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            for (const float channel : colourAt(x, y)) pixels.push_back(toByte(channel));
        }
    }
    const relief::Expected<void> written = relief::writePng(path, kSize, kSize, pixels);
    if (!written) std::fprintf(stderr, "make_textures: %s\n", written.error().message.c_str());
    return written.has_value();
}

bool write(const std::filesystem::path& path, const std::function<Colour(int x, int y)>& colourAt)
{
    return writeWithAlpha(path, [&colourAt](int x, int y) -> ColourAndAlpha {
        const Colour colour = colourAt(x, y);
        return {colour[0], colour[1], colour[2], 255.0f};
    });
}

ColourAndAlpha codesOf(const Mask& mask)
{
    return {255.0f * mask.metallic, 255.0f * mask.occlusion, 255.0f * mask.detail, 255.0f * mask.smoothness};
}

Colour grey(float code)
{
    return {code, code, code};
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_textures OUTPUT_DIR\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const Fields fields;
    // Two diagonal grains, so that neither the pixels' rows nor the noise's own lattice shows.
    const Field grain([](float x, float y) {
        return 42.0f * fractal(2 * x + y, 2 * y - x, 11, 11, 4, 0.75f, 131) +
               42.0f * fractal(x + 2 * y, y - 2 * x, 13, 13, 4, 0.75f, 151) +
               16.0f * fractal(x + y, y - x, 4, 4, 2, 0.5f, 171);
    });
    const float mean = grain.mean();

    const bool written =
        write(folder / "marble-albedo.png", [&](int x, int y) { return albedoAt(fields, x, y); }) &&
        write(folder / "marble-heights.png", [&](int x, int y) { return grey(255.0f * heightAt(fields, x, y)); }) &&
        write(folder / "marble-detail.png", [&](int x, int y) { return grey(127.5f + (grain.at(x, y) - mean)); }) &&
        write(folder / "bricks-albedo.png", [](int x, int y) { return brickColour(x, y); }) &&
        write(folder / "bricks-heights.png", [](int x, int y) { return grey(255.0f * brickHeight(x, y)); }) &&
        write(folder / "inlay-albedo.png", [](int x, int y) { return inlayColour(x, y); }) &&
        writeWithAlpha(folder / "inlay-mask.png", [](int x, int y) { return codesOf(inlayMask(x, y)); }) &&
        write(folder / "inlay-emission.png", [](int x, int y) { return inlayEmission(x, y); });
    return written ? 0 : 2;
}
