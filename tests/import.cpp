// Imports: levels that are made late and from the right source, heights or colours, faded or compressed. What storage
// costs is in import_storage.cpp, files are in import_files.cpp.
#include "relief/texture/import.h"

#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "import_fixture.h"
#include "relief/texture/pixels.h"
#include "sampler_fixture.h"

using namespace import_fixture;

TEST_CASE("import: opposite normals make a flat level, zero vectors too (S-618)")
{
    const Image8 opposite{2, 2, {255, 200, 10, 255, 0, 55, 245, 255, 3, 4, 5, 6, 252, 251, 250, 6}};
    CHECK(holds(importTexture(opposite, normalMap())->level(1).texel<std::uint8_t>(0, 0), 128, 128, 255, 255));
}

TEST_CASE("import: automatic takes grey pictures for heights and others for normals, and both can be forced")
{
    using From = ImportSettings::FromGreyscale;
    const Image8 grey = pictureBy(8, 8, [](int x, int y, int) { return 20 * x + y; });
    const Image8 normals = pictureBy(8, 8, [](int x, int, int c) { return c == 0 ? 100 + x : c == 1 ? 120 : 250; });
    const auto level = [](const Image8& picture, From from) {
        ImportSettings settings = normalMap();
        settings.fromGreyscale = from;
        return Texture(std::move(*importTexture(picture, settings))).level(0);
    };
    CHECK(sameLevel(level(grey, From::automatic), level(grey, From::yes)));
    CHECK(!sameLevel(level(grey, From::automatic), level(grey, From::no)));
    CHECK(sameLevel(level(normals, From::automatic), level(normals, From::no)));
    CHECK(!sameLevel(level(normals, From::automatic), level(normals, From::yes)));
    // A file of unit normals comes through within a code.
    const Image8 unit = onlyColour(2, 2, 204, 128, 230, 255);  // (0.6, 0, 0.8)
    const MipLevel back = level(unit, From::no);
    for (int c = 0; c < 3; ++c)
        CHECK(std::abs(back.texel<std::uint8_t>(0, 0)[c] - unit.pixels[static_cast<std::size_t>(c)]) <= 1);
}

TEST_CASE("import: 16-bit heights are not rounded to 8 bits first")
{
    Image16 fine{64, 1, {}};
    for (int x = 0; x < 64; ++x) fine.pixels.insert(fine.pixels.end(), 4, static_cast<std::uint16_t>(20000 + 8 * x));
    const Texture texture = *importTexture(fine, normalMap(Storage::rgb, 16.0f));
    // A slope of 16 * 64 * 8 / 65535 = 1/8 everywhere; 8 bits would have a step of 4 and plains.
    const double expected = -0.125 / std::sqrt(1.0 + 0.125 * 0.125) * 127.5 + 127.5;
    for (int x = 0; x < 63; ++x) CHECK(std::abs(texture.level(0).texel<std::uint8_t>(x, 0)[0] - expected) <= 0.51);
}

TEST_CASE("import: faded levels are exactly grey or flat, and the source of coarser levels is not faded")
{
    ImportSettings settings{.colorSpace = ColorSpace::linear, .fadeOutMips = true, .fadeFirst = 1, .fadeLast = 4};
    const Texture linear = *importTexture(onlyColour(32, 32, 200, 128, 56, 77), settings);
    const int reds[] = {200, 200, 176, 152, 128, 128};  // even steps: 200 * 2/3 + 128 * 1/3 = 176
    for (int k = 0; k < 6; ++k)
        CHECK(holds(linear.level(k).texel<std::uint8_t>(0, 0), reds[k], 128, 256 - reds[k], 77));

    settings = {.fadeOutMips = true};
    const Texture srgb = *importTexture(pictureOf(kAlbedo), settings);
    const Texture plain = *importTexture(pictureOf(kAlbedo), {});
    CHECK(sameLevel(srgb.level(1), plain.level(1)));
    CHECK(!sameLevel(srgb.level(2), plain.level(2)));
    for (int k = 3; k < srgb.levelCount(); ++k) {
        const MipLevel& level = srgb.level(k);
        const std::uint16_t grey = Texture::grey().level(0).texel<std::uint16_t>(0, 0)[0];
        for (int i = 0; i < level.width(); ++i) CHECK(level.texel<std::uint16_t>(i, i)[i % 3] == grey);
    }

    for (const Storage storage : {Storage::rgb, Storage::dxt5nm, Storage::dxt5}) {
        settings = normalMap(storage);
        settings.fadeOutMips = true;
        const Texture normals = *importTexture(pictureOf(kHeights), settings);
        const Texture unfaded = *importTexture(pictureOf(kHeights), normalMap(storage));
        CHECK(sameLevel(normals.level(1), unfaded.level(1)));
        CHECK(!sameLevel(normals.level(2), unfaded.level(2)));
        for (int k = 3; k < normals.levelCount(); ++k) {
            const MipLevel& level = normals.level(k);
            for (int i = 0; i < level.width(); ++i) {
                const std::uint8_t* code = level.texel<std::uint8_t>(i, i);
                CHECK(isFlat(code, storage));
            }
        }
    }
}

TEST_CASE("import: a colour without fading is the texture that Texture makes, level by level")
{
    const auto picture = pictureOf(kAlbedo);
    const auto& image = std::get<Image8>(*picture);
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb}) {
        const Texture imported = *importTexture(picture, {.colorSpace = space});
        const Texture made = *Texture::fromRgba8(image.width, image.height, image.pixels, space);
        REQUIRE(imported.format() == made.format());
        REQUIRE(imported.levelCount() == made.levelCount());
        for (int k = 0; k < made.levelCount(); ++k) CHECK(sameLevel(imported.level(k), made.level(k)));
    }
}

TEST_CASE("import: colours in dxt5 stay near the picture's, of 8 and 16 bits, sRGB and linear")
{
    const auto smooth = [](int x, int y, int c) { return c == 3 ? 255 - x : 60 + 3 * x + 2 * y + 10 * c; };
    const Image8 bytes = pictureBy(30, 14, smooth);
    Image16 shorts{30, 14, {}};
    for (const std::uint8_t code : bytes.pixels) shorts.pixels.push_back(static_cast<std::uint16_t>(code * 257));
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb}) {
        const ImportSettings settings{.colorSpace = space, .storage = Storage::dxt5};
        const Texture texture = *importTexture(bytes, settings), wide = *importTexture(shorts, settings);
        CHECK(texture.format() == (space == ColorSpace::srgb ? TexelFormat::rgba16 : TexelFormat::rgba8));
        for (int k = 0; k < texture.levelCount(); ++k) {
            if (k == 0) CHECK(sameLevel(texture.level(0), wide.level(0)));
            for (int c = 0; c < 4; ++c) {
                const std::uint16_t light =
                    space == ColorSpace::srgb ? texture.level(k).texel<std::uint16_t>(0, 0)[c] : 0;
                const int code = space == ColorSpace::linear ? texture.level(k).texel<std::uint8_t>(0, 0)[c]
                                 : c == 3                    ? light / 257
                                                             : (encodeSrgb16(light) + 128) / 257;
                if (k == 0) CHECK(std::abs(code - smooth(0, 13, c)) <= 8);
            }
        }
    }
}

TEST_CASE("import: nothing is made before it is sampled, and no more than that")
{
    for (const ImportSettings& settings : {normalMap(), normalMap(Storage::dxt5), ImportSettings{},
                                           ImportSettings{.storage = Storage::dxt5, .fadeOutMips = true}}) {
        const auto picture = pictureOf(kHeights);
        const Texture texture = *importTexture(picture, settings);
        CHECK(texture.levelsBuilt() == 0);
        CHECK(picture.use_count() > 1);
        sampler2D s;
        s.texture = &texture;
        const float2 still = {Float(0.0001f), Float(0.0f)};
        tex2Dgrad(s, {Float(0.3f), Float(0.7f)}, still, still);
        CHECK(texture.levelsBuilt() == 1);
        CHECK(picture.use_count() == 1);
        sampler_fixture::lodSample(s, 0.3f, 0.7f, 1.5f);
        CHECK(texture.levelsBuilt() == 3);
    }
    CHECK(importTexture(onlyColour(1, 1, 7, 7, 7, 7), normalMap())->levelsBuilt() == 1);
}

TEST_CASE("import: every level has these very bytes with every compiler")
{
    // FNV-1a, 64 bits, over all levels.
    const auto hashOf = [](const std::string& path, const ImportSettings& settings) {
        const Texture texture = *importTexture(pictureOf(path), settings);
        std::uint64_t hash = 0xcbf29ce484222325u;
        for (int k = 0; k < texture.levelCount(); ++k) {
            const MipLevel& level = texture.level(k);
            const auto bytes = static_cast<std::size_t>(level.width() * bytesPerTexel(texture.format()));
            for (int y = 0; y < level.height(); ++y) {
                const auto* row = reinterpret_cast<const unsigned char*>(level.texel<std::uint8_t>(0, 0)) +
                                  static_cast<std::size_t>(y) * level.rowBytes();
                for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ row[i]) * 0x100000001b3u;
            }
        }
        return hash;
    };
    ImportSettings sobel = normalMap(Storage::rgb, 0.03f), blocks = normalMap(Storage::dxt5);
    sobel.normalFilter = NormalFilter::sobel;
    blocks.fadeOutMips = true;
    CHECK(hashOf(kHeights, sobel) == 0x5f145f5e74ae013du);
    CHECK(hashOf(kHeights, blocks) == 0x6627e9b31c58e508u);
    CHECK(hashOf(kAlbedo, {.storage = Storage::dxt5, .fadeOutMips = true}) == 0x8f5e52cc5147e307u);
}
