// DXT5 blocks: decoded by hand-made ones with known answers, encoded within bounds, and the same bytes everywhere.
#include "relief/texture/dxt5.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

#include <doctest/doctest.h>

#include "relief/texture/pixels.h"

using namespace relief;

namespace {

// Two alphas, two colours of 5:6:5 bits, and the same selectors for every texel in turn: 0, 1, 2 ... of each kind.
Dxt5Block blockOf(int a0, int a1, int c0, int c1)
{
    Dxt5Block block{};
    block[0] = static_cast<std::uint8_t>(a0);
    block[1] = static_cast<std::uint8_t>(a1);
    std::uint64_t alphas = 0;
    for (std::uint64_t i = 0; i < 16; ++i) alphas |= (i & 7) << 3 * i;
    for (std::size_t i = 0; i < 6; ++i) block[2 + i] = static_cast<std::uint8_t>(alphas >> 8 * i);
    for (std::size_t i = 0; i < 2; ++i) {
        block[8 + i] = static_cast<std::uint8_t>(c0 >> 8 * i);
        block[10 + i] = static_cast<std::uint8_t>(c1 >> 8 * i);
    }
    for (std::size_t i = 12; i < 16; ++i) block[i] = 0b11100100;  // 0, 1, 2, 3 from the lowest bits
    return block;
}

std::array<int, 8> alphasOf(int a0, int a1)
{
    const Dxt5Texels texels = decodeDxt5Block(blockOf(a0, a1, 0, 0));
    std::array<int, 8> alphas;
    for (std::size_t i = 0; i < 8; ++i) {
        alphas[i] = texels[i * 4 + 3];
        CHECK(alphas[i] == texels[(i + 8) * 4 + 3]);
    }
    return alphas;
}

std::array<int, 4> channelOf(int c0, int c1, std::size_t channel)
{
    const Dxt5Texels texels = decodeDxt5Block(blockOf(0, 0, c0, c1));
    std::array<int, 4> values;
    for (std::size_t i = 0; i < 4; ++i) values[i] = texels[i * 4 + channel];
    return values;
}

constexpr int colorBits(int red, int green, int blue)
{
    return red << 11 | green << 5 | blue;
}

template <class Function>
Dxt5Texels texelsBy(Function f)  // f(texel, channel)
{
    Dxt5Texels texels;
    for (int i = 0; i < 64; ++i) texels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(f(i / 4, i % 4));
    return texels;
}

MipLevel marble(const std::string& name)
{
    const Expected<ImageFile> picture = readImage(std::string(RELIEF_SOURCE_FOLDER) + "/assets/" + name);
    REQUIRE(picture);
    return levelFromPicture(*picture, ColorSpace::linear);
}

// FNV-1a, 64 bits.
std::uint64_t hashOf(const std::vector<Dxt5Block>& blocks)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const Dxt5Block& block : blocks) {
        for (const std::uint8_t byte : block) hash = (hash ^ byte) * 0x100000001b3u;
    }
    return hash;
}

}  // namespace

TEST_CASE("dxt5: alpha has eight values where the first is larger, six with 0 and 255 where it is not")
{
    CHECK(alphasOf(255, 0) == std::array{255, 0, 219, 182, 146, 109, 73, 36});  // 255 * 6/7 = 218.57 ...
    CHECK(alphasOf(7, 0) == std::array{7, 0, 6, 5, 4, 3, 2, 1});
    CHECK(alphasOf(101, 100) == std::array{101, 100, 101, 101, 101, 100, 100, 100});
    CHECK(alphasOf(0, 255) == std::array{0, 255, 51, 102, 153, 204, 0, 255});
    CHECK(alphasOf(10, 11) == std::array{10, 11, 10, 10, 11, 11, 0, 255});
    CHECK(alphasOf(77, 77) == std::array{77, 77, 77, 77, 77, 77, 0, 255});
}

TEST_CASE("dxt5: every pair of alphas is interpolated to the nearest code")
{
    for (int a0 = 0; a0 < 256; ++a0) {
        for (int a1 = 0; a1 < 256; a1 += 3) {
            const std::array<int, 8> alphas = alphasOf(a0, a1);
            const int parts = a0 > a1 ? 7 : 5;
            for (int i = 1; i < parts; ++i) {
                const double exact = (a0 * (parts - i) + a1 * i) / static_cast<double>(parts);
                REQUIRE(alphas[static_cast<std::size_t>(i) + 1] == static_cast<int>(std::floor(exact + 0.5)));
            }
        }
    }
}

TEST_CASE("dxt5: colours have four values, whichever is larger, and bits are repeated")
{
    CHECK(channelOf(colorBits(31, 0, 0), 0, 0) == std::array{255, 0, 170, 85});
    CHECK(channelOf(0, colorBits(31, 0, 0), 0) == std::array{0, 255, 85, 170});  // BC1 would have three and black here
    CHECK(channelOf(colorBits(0, 63, 0), 0, 1) == std::array{255, 0, 170, 85});
    CHECK(channelOf(colorBits(0, 0, 31), colorBits(0, 0, 30), 2) == std::array{255, 247, 252, 250});
    CHECK(channelOf(colorBits(0, 32, 0), colorBits(0, 31, 0), 1) == std::array{130, 125, 128, 127});
    for (int v = 0; v < 64; ++v) {
        CHECK(std::abs(channelOf(colorBits(0, v, 0), 0, 1)[0] * 63 - v * 255) <= 63);  // within one code of v / 63
        CHECK(std::abs(channelOf(colorBits(v / 2, 0, 0), 0, 0)[0] * 31 - v / 2 * 255) <= 31);
        CHECK(channelOf(colorBits(0, 0, v / 2), 0, 2)[0] == channelOf(colorBits(v / 2, 0, 0), 0, 0)[0]);
    }
}

TEST_CASE("dxt5: a block of one colour comes back within 1, alpha exactly")
{
    for (int v = 0; v < 256; ++v) {
        const Dxt5Texels back = decodeDxt5Block(encodeDxt5Block(texelsBy([v](int, int) { return v; })));
        for (std::size_t i = 0; i < 64; i += 4) {
            for (std::size_t c = 0; c < 3; ++c) REQUIRE(std::abs(back[i + c] - v) <= 1);
            REQUIRE(back[i + 3] == v);
        }
    }
    // What a flat normal is stored as.
    const auto flat = [](int, int c) { return c % 2 == 0 ? 255 : 128; };
    CHECK(decodeDxt5Block(encodeDxt5Block(texelsBy(flat))) == texelsBy(flat));
}

TEST_CASE("dxt5: red and blue of 255 survive whatever green does, and green and alpha have errors of a few codes")
{
    std::uint32_t state = 1;
    for (int round = 0; round < 2000; ++round) {
        const int range = 1 + round % 256;
        const Dxt5Texels texels = texelsBy([&](int, int c) {
            state = state * 1664525u + 1013904223u;
            return c % 2 == 0 ? 255 : static_cast<int>(state >> 16) % range;
        });
        const Dxt5Texels back = decodeDxt5Block(encodeDxt5Block(texels));
        for (std::size_t i = 0; i < 64; i += 4) {
            REQUIRE(back[i] == 255);
            REQUIRE(back[i + 2] == 255);
            // Half of the largest gap: a third and a seventh of the range, and the 6-bit grid on top for green.
            REQUIRE(std::abs(back[i + 1] - texels[i + 1]) <= range / 6 + 7);
            REQUIRE(std::abs(back[i + 3] - texels[i + 3]) <= range / 14 + 1);
        }
    }
}

TEST_CASE("dxt5: smooth levels of any size keep their texels, edges included")
{
    for (const auto& [width, height] : {std::pair{16, 16}, {1, 1}, {2, 2}, {5, 3}, {4, 9}, {31, 17}}) {
        MipLevel level(TexelFormat::rgba8, width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const int values[] = {100 + x, 90 + 2 * y, 200 - x, 40 + 3 * x + y};
                std::copy_n(values, 4, level.texel<std::uint8_t>(x, y));
            }
        }
        const std::vector<Dxt5Block> blocks = encodeDxt5(level);
        CHECK(static_cast<int>(blocks.size()) == (width + 3) / 4 * ((height + 3) / 4));
        const MipLevel back = decodeDxt5(blocks, width, height);
        REQUIRE(back.width() == width);
        REQUIRE(back.height() == height);
        for (int y = -1; y <= height; ++y) {
            for (int x = -1; x <= width; ++x) {
                const int wrappedX = (x + width) % width, wrappedY = (y + height) % height;
                const std::uint8_t* texel = level.texel<std::uint8_t>(wrappedX, wrappedY);
                for (int c = 0; c < 4; ++c) {
                    REQUIRE(std::abs(back.texel<std::uint8_t>(x, y)[c] - texel[c]) <= (c == 3 ? 1 : 6));
                }
            }
        }
    }
}

TEST_CASE("dxt5: the encoder gives these very bytes with every compiler")
{
    CHECK(hashOf(encodeDxt5(marble("marble-albedo.png"))) == 0xd8562bcfcdcbd72cu);
    CHECK(hashOf(encodeDxt5(marble("marble-heights.png"))) == 0xa3d331cc87746ff3u);
    CHECK(hashOf(encodeDxt5(marble("marble-detail.png"))) == 0xc8df73c54f0ba817u);
}
