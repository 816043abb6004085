// Textures: what comes in is what lies in memory, levels are area averages for any size, and they are built once, when
// somebody asks.
#include "relief/texture/texture.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#if !defined(RELIEF_NO_THREADS)
#include <thread>
#endif

using namespace relief;

namespace {

// Random bytes, the same on every run.
std::vector<std::uint8_t> randomBytes(std::size_t count, std::uint32_t seed = 1)
{
    std::vector<std::uint8_t> bytes(count);
    for (std::uint8_t& byte : bytes) {
        seed = seed * 1664525u + 1013904223u;
        byte = static_cast<std::uint8_t>(seed >> 24);
    }
    return bytes;
}

std::vector<std::uint8_t> randomPixels(int width, int height)
{
    return randomBytes(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
}

// How much of the fine texel [i, i + 1) the coarse texel [k, k + 1) * fine / coarse covers.
double overlap(int i, int fine, int k, int coarse)
{
    const double ratio = static_cast<double>(fine) / coarse;
    return std::fmax(0.0, std::fmin(i + 1.0, (k + 1) * ratio) - std::fmax(i, k * ratio));
}

// The average over the area that texel (x, y) of a coarse level covers of a fine one, by brute force.
template <class Channel>
double areaAverage(const MipLevel& fine, const MipLevel& coarse, int x, int y, int channel)
{
    double sum = 0.0, area = 0.0;
    for (int j = 0; j < fine.height(); ++j) {
        for (int i = 0; i < fine.width(); ++i) {
            const double part =
                overlap(i, fine.width(), x, coarse.width()) * overlap(j, fine.height(), y, coarse.height());
            sum += part * static_cast<double>(fine.texel<Channel>(i, j)[channel]);
            area += part;
        }
    }
    return sum / area;
}

template <class Channel>
void checkLevels(const Texture& texture, double tolerance)
{
    for (int k = 1; k < texture.levelCount(); ++k) {
        const MipLevel &fine = texture.level(k - 1), &coarse = texture.level(k);
        REQUIRE(coarse.width() == std::max(1, fine.width() / 2));
        REQUIRE(coarse.height() == std::max(1, fine.height() / 2));
        for (int y = 0; y < coarse.height(); ++y) {
            for (int x = 0; x < coarse.width(); ++x) {
                for (int c = 0; c < 4; ++c) {
                    const double reference = areaAverage<Channel>(fine, coarse, x, y, c);
                    const double built = static_cast<double>(coarse.texel<Channel>(x, y)[c]);
                    REQUIRE(std::abs(built - reference) <= tolerance);
                }
            }
        }
    }
}

}  // namespace

TEST_CASE("texture: the picture's lower row is row 0, numbers stay as they are")
{
    const std::vector<std::uint8_t> pixels = {10, 11, 12, 13, 20, 21, 22, 23,   // upper row
                                              30, 31, 32, 33, 40, 41, 42, 43};  // lower row
    const Texture texture = *Texture::fromRgba8(2, 2, pixels, ColorSpace::linear);
    CHECK(texture.format() == TexelFormat::rgba8);
    CHECK(texture.level(0).texel<std::uint8_t>(0, 0)[0] == 30);
    CHECK(texture.level(0).texel<std::uint8_t>(1, 0)[3] == 43);
    CHECK(texture.level(0).texel<std::uint8_t>(0, 1)[1] == 11);
    CHECK(texture.texel(1, 1).z == 22.0f / 255.0f);

    const std::vector<std::uint16_t> deep = {1, 2, 3, 65535, 500, 600, 700, 800};
    const Texture column = *Texture::fromRgba16(1, 2, deep, ColorSpace::linear);
    CHECK(column.format() == TexelFormat::rgba16);
    CHECK(column.texel(0, 0).x == 500.0f / 65535.0f);
    CHECK(column.texel(0, 1).w == 1.0f);

    const std::vector<float> bright = {1.5f, -2.0f, 1e30f, 0.0f};
    CHECK(Texture::fromRgbaFloat(1, 1, bright)->texel(0, 0) == glm::vec4(1.5f, -2.0f, 1e30f, 0.0f));
}

TEST_CASE("texture: sRGB is decoded to 16 bits, alpha is not")
{
    const std::vector<std::uint8_t> pixels = {0, 128, 255, 128};
    const Texture texture = *Texture::fromRgba8(1, 1, pixels, ColorSpace::srgb);
    CHECK(texture.format() == TexelFormat::rgba16);
    const std::uint16_t* texel = texture.level(0).texel<std::uint16_t>(0, 0);
    CHECK(texel[0] == 0);
    CHECK(texel[1] == srgbToLinear16(std::uint8_t{128}));
    CHECK(texel[2] == 65535);
    CHECK(texel[3] == 128 * 257);

    const std::vector<std::uint16_t> deep = {0, 128 * 257, 65535, 1000};
    const Texture same = *Texture::fromRgba16(1, 1, deep, ColorSpace::srgb);
    CHECK(same.level(0).texel<std::uint16_t>(0, 0)[1] == texel[1]);
    CHECK(same.level(0).texel<std::uint16_t>(0, 0)[3] == 1000);
}

TEST_CASE("texture: impossible sizes are errors that say what to do (S-566)")
{
    const std::vector<std::uint8_t> pixels(16);
    for (const auto& [width, height] : {std::pair{0, 4}, {4, 0}, {-1, 4}, {16385, 1}, {1, 16385}, {3, 2}}) {
        const Expected<Texture> texture = Texture::fromRgba8(width, height, pixels, ColorSpace::linear);
        REQUIRE(!texture);
        CHECK(texture.error().message.find(std::to_string(width) + "x" + std::to_string(height)) != std::string::npos);
        CHECK(texture.error().message.find('\n') == std::string::npos);
    }
    CHECK(!Texture::fromRgba16(1, 1, std::vector<std::uint16_t>(3), ColorSpace::linear));
    CHECK(!Texture::fromRgbaFloat(0, 0, std::vector<float>()));
}

TEST_CASE("texture: the constants are exact (S-566)")
{
    CHECK(Texture::white().texel(0, 0) == glm::vec4(1.0f));
    CHECK(Texture::black().texel(0, 0) == glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    CHECK(Texture::flatNormal().texel(0, 0) == glm::vec4(0.5f, 0.5f, 1.0f, 0.5f));
    const float grey = static_cast<float>(srgbToLinear16(std::uint8_t{128})) / 65535.0f;
    CHECK(Texture::grey().texel(0, 0) == glm::vec4(grey, grey, grey, 1.0f));
    CHECK(std::abs(grey - srgbToLinear(std::uint8_t{128})) < 1e-5f);
    CHECK(Texture::white().levelCount() == 1);
}

TEST_CASE("texture: the number of levels follows the longer side, for any size (S-556)")
{
    for (int side = 1; side <= 16384; ++side) {
        const int expected = static_cast<int>(std::floor(std::log2(side))) + 1;
        REQUIRE(mipLevelCount(side, 1) == expected);
        REQUIRE(mipLevelCount(1, side) == expected);
        REQUIRE(mipLevelCount(side, side) == expected);
    }
    CHECK(mipLevelCount(16384, 16384) == kMaxMipLevels);
    const Texture texture = *Texture::fromRgba8(16, 1, randomPixels(16, 1), ColorSpace::linear);
    CHECK(texture.levelCount() == 5);
    CHECK(texture.level(4).width() == 1);
    CHECK(texture.texelSize() == glm::vec4(1.0f / 16.0f, 1.0f, 16.0f, 1.0f));
}

TEST_CASE("texture: every level is the exact area average of the one before, for odd sizes too (S-557)")
{
    for (const auto& [width, height] :
         {std::pair{3, 5}, {8, 8}, {7, 4}, {4, 7}, {1, 9}, {9, 1}, {31, 17}, {2, 1}, {1, 2}, {6, 10}}) {
        const std::vector<std::uint8_t> pixels = randomPixels(width, height);
        checkLevels<std::uint8_t>(*Texture::fromRgba8(width, height, pixels, ColorSpace::linear), 0.5 + 1e-9);
        checkLevels<std::uint16_t>(*Texture::fromRgba8(width, height, pixels, ColorSpace::srgb), 0.5 + 1e-9);
        std::vector<float> bright(pixels.begin(), pixels.end());
        checkLevels<float>(*Texture::fromRgbaFloat(width, height, bright), 1e-4);
    }
}

TEST_CASE("texture: rounding in levels is to nearest, halves up")
{
    const std::vector<std::uint8_t> pixels = {0, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 1, 2};  // sums 1, 2, 3, 5
    const Texture texture = *Texture::fromRgba8(2, 2, pixels, ColorSpace::linear);
    const std::uint8_t* texel = texture.level(1).texel<std::uint8_t>(0, 0);
    CHECK(texel[0] == 0);
    CHECK(texel[1] == 1);
    CHECK(texel[2] == 1);
    CHECK(texel[3] == 1);
}

TEST_CASE("texture: a constant stays itself through all levels of any size and format (S-559)")
{
    for (const auto& [width, height] : {std::pair{257, 511}, {64, 64}, {3, 200}}) {
        const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
        const Texture bytes =
            *Texture::fromRgba8(width, height, std::vector<std::uint8_t>(count, 77), ColorSpace::linear);
        const Texture shorts =
            *Texture::fromRgba16(width, height, std::vector<std::uint16_t>(count, 54321), ColorSpace::linear);
        const Texture floats = *Texture::fromRgbaFloat(width, height, std::vector<float>(count, 0.1f));
        const int last = bytes.levelCount() - 1;
        CHECK(bytes.level(last).texel<std::uint8_t>(0, 0)[2] == 77);
        CHECK(shorts.level(last).texel<std::uint16_t>(0, 0)[1] == 54321);
        CHECK(floats.level(last).texel<float>(0, 0)[0] == 0.1f);
        CHECK(floats.level(1).texel<float>(0, 0)[3] == 0.1f);
    }
}

TEST_CASE("texture: a black and white checker becomes sRGB 188, not 128 (S-563)")
{
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 64; ++i) {
        const std::uint8_t value = (i / 8 + i) % 2 != 0 ? 255 : 0;
        pixels.insert(pixels.end(), {value, value, value, 255});
    }
    const Texture texture = *Texture::fromRgba8(8, 8, pixels, ColorSpace::srgb);
    for (int k = 1; k < 4; ++k) {
        const float linear = static_cast<float>(texture.level(k).texel<std::uint16_t>(0, 0)[0]) / 65535.0f;
        CHECK(std::floor(linearToSrgb(Float(linear))[0] * 255.0f + 0.5f) == 188.0f);
    }
}

TEST_CASE("texture: the frame repeats the opposite side, rows take an odd number of cache lines")
{
    for (const auto& [width, height] : {std::pair{5, 3}, {1, 1}, {64, 2}, {1024, 1}}) {
        const std::vector<std::uint8_t> pixels = randomPixels(width, height);
        const Texture texture = *Texture::fromRgba8(width, height, pixels, ColorSpace::linear);
        for (int k = 0; k < texture.levelCount(); ++k) {
            const MipLevel& level = texture.level(k);
            for (int y = -1; y <= level.height(); ++y) {
                for (int x = -1; x <= level.width(); ++x) {
                    const int wrappedX = (x + level.width()) % level.width();
                    const int wrappedY = (y + level.height()) % level.height();
                    REQUIRE(std::memcmp(level.texel<std::uint8_t>(x, y), level.texel<std::uint8_t>(wrappedX, wrappedY),
                                        4) == 0);
                }
            }
            REQUIRE(level.rowBytes() % 64 == 0);
            REQUIRE(level.rowBytes() / 64 % 2 == 1);
            REQUIRE(level.rowTexels() >= level.width() + 2);
            REQUIRE(level.texels() == reinterpret_cast<const std::byte*>(level.texel<std::uint8_t>(-1, -1)));
        }
    }
}

TEST_CASE("texture: levels are built when asked for, with those between, and survive a move")
{
    Texture texture = *Texture::fromRgba8(64, 16, randomPixels(64, 16), ColorSpace::linear);
    CHECK(texture.levelCount() == 7);
    CHECK(texture.levelsBuilt() == 1);
    const MipLevel& third = texture.level(3);
    CHECK(texture.levelsBuilt() == 4);
    const Texture moved = std::move(texture);
    CHECK(&moved.level(3) == &third);
    CHECK(moved.levelsBuilt() == 4);
    CHECK(moved.level(6).width() == 1);
    CHECK(moved.levelsBuilt() == 7);
}

TEST_CASE("texture: levels that somebody makes are made when asked for, in order, once each")
{
    std::vector<int> made;
    const auto make = [&made](int k, const MipLevel* finer) {
        made.push_back(k);
        CHECK((finer == nullptr) == (k == 0));
        MipLevel level(TexelFormat::rgba8, std::max(8 >> k, 1), std::max(4 >> k, 1));
        level.texel<std::uint8_t>(0, 0)[0] = static_cast<std::uint8_t>(10 + k);
        return level;
    };
    const Texture texture = *Texture::fromLevels(TexelFormat::rgba8, 8, 4, make);
    CHECK(texture.levelCount() == 4);
    CHECK(texture.levelsBuilt() == 0);
    CHECK(made.empty());
    CHECK(texture.texelSize() == glm::vec4(1.0f / 8.0f, 1.0f / 4.0f, 8.0f, 4.0f));
    CHECK(texture.level(2).texel<std::uint8_t>(0, 0)[0] == 12);
    CHECK(made == std::vector{0, 1, 2});
    CHECK(texture.texel(0, 0).x == 10.0f / 255.0f);
    CHECK(texture.level(3).texel<std::uint8_t>(0, 0)[0] == 13);
    CHECK(made == std::vector{0, 1, 2, 3});

    CHECK(!Texture::fromLevels(TexelFormat::rgba8, 0, 4, make));
    CHECK(!Texture::fromLevels(TexelFormat::rgba8, 4, 16385, make));
}

TEST_CASE("texture: a level's texels are zero, whatever was in its memory")
{
    constexpr int kSide = 40;
    for (int i = 0; i < 3; ++i) {
        MipLevel used = MipLevel::forOverwrite(TexelFormat::rgba8, kSide, kSide);
        for (int y = 0; y < kSide; ++y) std::fill_n(used.texel<std::uint8_t>(0, y), 4 * kSide, std::uint8_t{255});
        used.fillFrame();
        CHECK(used.isOpaque());
        used = MipLevel(TexelFormat::rgba8, 1, 1);  // its memory is free
        const MipLevel level(TexelFormat::rgba8, kSide, kSide);
        int written = 0;
        for (int y = -1; y <= kSide; ++y) {
            for (int x = -1; x <= kSide; ++x) written += *level.texel<std::uint32_t>(x, y) != 0;
        }
        CHECK(written == 0);
    }
}

TEST_CASE("texture: what makes levels is dropped with the last of them, and one texel is made at once")
{
    const auto held = std::make_shared<int>(0);
    const auto make = [held](int, const MipLevel* finer) {
        return finer ? coarserLevel(TexelFormat::rgba16, *finer) : MipLevel(TexelFormat::rgba16, 4, 1);
    };
    const long mine = held.use_count();
    const Texture texture = *Texture::fromLevels(TexelFormat::rgba16, 4, 1, make);
    texture.level(1);
    CHECK(held.use_count() == mine + 1);
    texture.level(2);
    CHECK(held.use_count() == mine);

    const Texture one = *Texture::fromLevels(TexelFormat::rgba8, 1, 1, [](int, const MipLevel*) {
        MipLevel level(TexelFormat::rgba8, 1, 1);
        level.texel<std::uint8_t>(0, 0)[1] = 255;
        level.fillFrame();
        return level;
    });
    CHECK(one.isConstant());
    CHECK(one.levelsBuilt() == 1);
    CHECK(one.constant() == glm::vec4(0.0f, 1.0f, 0.0f, 0.0f));
}

#if !defined(RELIEF_NO_THREADS)
TEST_CASE("texture: threads that ask for levels at once get the same ones, complete (S-567)")
{
    const std::vector<std::uint8_t> pixels = randomPixels(257, 63);
    const Texture reference = *Texture::fromRgba8(257, 63, pixels, ColorSpace::srgb);
    const int levels = reference.levelCount();
    for (int round = 0; round < 8; ++round) {
        const Texture texture = *Texture::fromRgba8(257, 63, pixels, ColorSpace::srgb);
        std::vector<int> different(4);
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < different.size(); ++t) {
            threads.emplace_back([&, t] {
                for (int i = 0; i < levels; ++i) {
                    const int k = t % 2 != 0 ? i : levels - 1 - i;
                    const MipLevel &mine = texture.level(k), &theirs = reference.level(k);
                    const std::size_t bytes = mine.rowBytes() * static_cast<std::size_t>(mine.height() + 2);
                    different[t] += std::memcmp(mine.texels(), theirs.texels(), bytes) != 0 ? 1 : 0;
                }
            });
        }
        for (std::thread& thread : threads) thread.join();
        CHECK(different == std::vector<int>(4, 0));
        CHECK(texture.levelsBuilt() == levels);
    }
}
#endif
