// The sampler against a brute-force reference and against what must hold exactly; and that a lane's result is its own.
#include "relief/texture/sampler.h"

#include "relief/texture/fetch.h"
#include "sampler_fixture.h"

using namespace sampler_fixture;

TEST_CASE("sampler: UNORM texels become c / 255 and c / 65535, correctly rounded, for every code (A-31)")
{
    int different = 0;
    for (int c = 0; c < 65536; ++c) {
        const auto code = static_cast<float>(c);
        const Float raw = code;
        const float4 deep = FetchRgba16::toUnit({raw, raw, raw, raw});
        for (int k = 0; k < 4; ++k) different += deep[k][0] != code / 65535.0f ? 1 : 0;
        if (c > 255) continue;
        const Float scaled = raw * static_cast<float>(kSubtexels);
        const float4 unit = FetchRgba8::toUnit({scaled, scaled, scaled, scaled});
        for (int k = 0; k < 4; ++k) different += unit[k][0] != code / 255.0f ? 1 : 0;
    }
    CHECK(different == 0);
}

TEST_CASE(
    "sampler: nearest and bilinear follow the reference for all address modes, formats and odd sizes (S-557, S-561)")
{
    Random random(7);
    for (const auto& [width, height] : {std::pair{3, 5}, {257, 511}, {1, 1}, {1, 7}, {64, 1}, {64, 32}}) {
        for (const TexelFormat format : kFormats) {
            const Texture texture = randomTexture(format, width, height);
            for (int combination = 0; combination < 16; ++combination) {
                sampler2D s{
                    .texture = &texture, .u = kModes[combination % 4], .v = kModes[combination / 4], .mipmaps = false};
                s.borderColor = {0.25f, 0.5f, 0.75f, 1.0f};
                double worst = 0.0;
                int wrong = 0;
                for (int block = 0; block < 160 / kLanes; ++block) {
                    const auto anywhere = [&](int) { return random(-2.6f, 2.6f); };
                    const float2 uv = {perLane(anywhere), perLane(anywhere)};
                    s.filter = Filter::bilinear;
                    const float4 bilinear = tex2D(s, uv);
                    s.filter = Filter::nearest;
                    const float4 nearest = tex2D(s, uv);
                    for (int i = 0; i < kLanes; ++i) {
                        const auto u = static_cast<double>(uv.x[i]), v = static_cast<double>(uv.y[i]);
                        const auto nearEdge = [](double x) { return std::abs(x - std::round(x)) < 1.0 / 256.0; };
                        const bool ambiguous = nearEdge(u * width) || nearEdge(v * height);
                        for (int c = 0; c < 4; ++c) {
                            const double reference = referenceBilinear(s, texture.level(0), u, v, c);
                            worst = std::fmax(worst, std::abs(static_cast<double>(bilinear[c][i]) - reference));
                            const double texel = referenceNearest(s, texture.level(0), u, v, c);
                            wrong += !ambiguous && nearest[c][i] != static_cast<float>(texel) ? 1 : 0;
                        }
                    }
                }
                const int size = width;  // a structured binding cannot be captured
                CAPTURE(size);
                CAPTURE(combination);
                REQUIRE(worst < 6e-4);  // positions are rounded to 1/4096: half of that per axis, contrast up to 2
                REQUIRE(wrong == 0);
            }
        }
    }
}

TEST_CASE("sampler: trilinear follows the reference between all levels")
{
    Random random(9);
    for (const TexelFormat format : kFormats) {
        const Texture texture = randomTexture(format, 37, 22);
        const sampler2D s{.texture = &texture};
        double worst = 0.0;
        for (int i = 0; i < 600; ++i) {
            const int fixed = static_cast<int>(random.bits() % (5 * 256 + 1));
            const float u = random(0.0f, 1.0f), v = random(0.0f, 1.0f);
            const int k = std::min(fixed / 256, 4);
            const double t = fixed / 256.0 - k;
            const float4 colour = lodSample(s, u, v, static_cast<float>(fixed) / 256.0f);
            for (int c = 0; c < 4; ++c) {
                const double finer =
                    referenceBilinear(s, texture.level(k), static_cast<double>(u), static_cast<double>(v), c);
                const double coarser =
                    referenceBilinear(s, texture.level(k + 1), static_cast<double>(u), static_cast<double>(v), c);
                const double reference = finer * (1.0 - t) + coarser * t;
                worst = std::fmax(worst, std::abs(static_cast<double>(colour[c][0]) - reference));
            }
        }
        CHECK(worst < 6e-4);
    }
}

TEST_CASE("sampler: the nearest and bilinear filters take the nearest level, floor(lod + 0.5)")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 32, 32);
    for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
        const sampler2D s{.texture = &texture, .filter = filter};
        for (int fixed = -300; fixed < 6 * 256; fixed += 16) {
            const int level = std::min(std::max((fixed + 128) >> 8, 0), 5);
            const float4 expected = lodSample(s, 0.3f, 0.6f, static_cast<float>(level));
            REQUIRE(sameBits(lodSample(s, 0.3f, 0.6f, static_cast<float>(fixed) / 256.0f), expected, 0));
        }
    }
}

TEST_CASE("sampler: huge coordinates give the texel of the exact product (S-551)")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 16384, 1);
    const sampler2D s{.texture = &texture, .filter = Filter::nearest};
    for (const float u :
         {1e7f, -1e7f, 3e9f, -3e9f, 1e30f, -1e30f, 1e6f + 0.375f, -1e6f - 0.625f, 4097.33f, -4097.33f}) {
        const double fraction = static_cast<double>(u) - std::floor(static_cast<double>(u));
        const int x = static_cast<int>(std::floor(fraction * 16384.0)) % 16384;
        CAPTURE(u);
        CHECK(lodSample(s, u, 0.5f).x[0] == texture.texel(x, 0).x);
    }
}

TEST_CASE("sampler: NaN and infinite coordinates give texel 0 (S-552)")
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const TexelFormat format : kFormats) {
        const Texture texture = randomTexture(format, 5, 4);
        const glm::vec4 first = texture.texel(0, 0), last = texture.texel(4, 3);
        for (const Filter filter : kFilters) {
            for (const AddressMode mode : kModes) {
                sampler2D s{.texture = &texture, .filter = filter, .u = mode, .v = mode, .mipmaps = false};
                s.borderColor = {2.0f, 2.0f, 2.0f, 2.0f};
                CHECK(lodSample(s, nan, nan).x[0] == first.x);
                const bool repeats = mode == AddressMode::wrap || mode == AddressMode::mirror;
                const bool border = mode == AddressMode::border;
                CHECK(lodSample(s, infinity, infinity).y[0] == (repeats ? first.y : border ? 2.0f : last.y));
                CHECK(lodSample(s, -infinity, -infinity).z[0] == (border ? 2.0f : first.z));
            }
        }
    }
}

TEST_CASE("sampler: tiny negative coordinates stay within the texture (S-553)")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 8, 1);
    const sampler2D s{.texture = &texture, .filter = Filter::nearest};
    const float first = texture.texel(0, 0).x, last = texture.texel(7, 0).x;
    CHECK((lodSample(s, -1e-8f, 0.0f).x[0] == first || lodSample(s, -1e-8f, 0.0f).x[0] == last));
    int outside = 0;
    for (int n = 0; n < 1 << 20; n += kLanes) {
        const Float u = asFloat((Int(static_cast<std::int32_t>(0x80000000u)) | (Int(n) + laneNumbers()) * 1021));
        const Float reduced = reduceRange(AddressMode::wrap, u);
        const Int nearest = nearestPosition(AddressMode::wrap, reduced, TextureSide(16383));
        const Int pair = pairPosition(AddressMode::wrap, reduced, TextureSide(16383)) >> kSubtexelBits;
        outside += count((nearest < 1) | (nearest > 16384) | (pair < 0) | (pair > 16383));
    }
    measured("texels outside of the texture", outside, 0);
}

TEST_CASE("sampler: u = k / N is texel k, for every N and k that is not a power of two either (S-554)")
{
    int wrong = 0;
    for (int n = 1; n <= 16384; n = n < 300 ? n + 1 : n * 2 - n / 2 + 1) {
        for (int k = 0; k < n; ++k) {
            const Float u = static_cast<float>(k) / static_cast<float>(n);
            for (const AddressMode mode : kModes) {
                const Int position = nearestPosition(mode, reduceRange(mode, u), TextureSide(n));
                wrong += position[0] != k + 1 ? 1 : 0;
            }
        }
    }
    measured("texels wrong", wrong, 0);
}

TEST_CASE("sampler: a coordinate at a texel's centre gives exactly that texel, up to 1024 texels (S-555, A-24)")
{
    int wrong = 0;
    for (int n = 1; n <= 1024; ++n) {
        for (int k = 0; k < n; ++k) {
            const Float u = (static_cast<float>(k) + 0.5f) / static_cast<float>(n);
            for (const AddressMode mode : kModes) {
                const Int position = pairPosition(mode, reduceRange(mode, u), TextureSide(n));
                wrong += position[0] != (k + 1) * kSubtexels ? 1 : 0;
            }
        }
    }
    for (int k = 0; k < 16384; ++k) {
        const Float u = (static_cast<float>(k) + 0.5f) / 16384.0f;
        wrong += pairPosition(AddressMode::wrap, u, TextureSide(16384))[0] != (k + 1) * kSubtexels ? 1 : 0;
    }
    measured("positions off the centre", wrong, 0);

    for (const TexelFormat format : kFormats) {
        const Texture texture = randomTexture(format, 23, 9);
        const sampler2D s{.texture = &texture};
        for (int k = 0; k < 23 * 9; ++k) {
            const float u = (static_cast<float>(k % 23) + 0.5f) / 23.0f, v = (static_cast<float>(k / 23) + 0.5f) / 9.0f;
            const glm::vec4 texel = texture.texel(k % 23, k / 23);
            for (int c = 0; c < 4; ++c) REQUIRE(lodSample(s, u, v)[c][0] == texel[c]);
        }
    }
}

TEST_CASE("sampler: address modes at the seams (S-561)")
{
    struct Row
    {
        float u;  // of 8 texels
        int wrap, mirror, clamp, border;
    };
    const Row rows[] = {{-1.0f, 0, 7, 0, -1},  {-0.5f, 4, 3, 0, -1}, {-0.0625f, 7, 0, 0, -1}, {0.0f, 0, 0, 0, 0},
                        {0.9375f, 7, 7, 7, 7}, {1.0f, 0, 7, 7, -1},  {1.0625f, 0, 7, 7, -1},  {10.0f, 0, 0, 7, -1},
                        {-10.0f, 0, 0, 0, -1}, {9.99f, 7, 0, 7, -1}, {2.0f, 0, 0, 7, -1},     {1.3f, 2, 5, 7, -1},
                        {-9.3f, 5, 5, 0, -1},  {-1.99f, 0, 0, 0, -1}};
    const Texture texture = randomTexture(TexelFormat::rgba8, 8, 1);
    for (const Row& row : rows) {
        const int expected[4] = {row.wrap, row.mirror, row.clamp, row.border};
        for (int m = 0; m < 4; ++m) {
            sampler2D s{.texture = &texture, .filter = Filter::nearest, .u = kModes[m]};
            s.borderColor = glm::vec4(3.0f);
            CAPTURE(row.u);
            CAPTURE(m);
            CHECK(lodSample(s, row.u, 0.0f).x[0] == (expected[m] < 0 ? 3.0f : texture.texel(expected[m], 0).x));
        }
    }
}

TEST_CASE("sampler: a constant texture is that constant, whatever the filter, level or address mode (S-556, S-559)")
{
    Random random(3);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {64, 64}, {19, 6}}) {
        const auto numbers = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
        for (const int code : {0, 1, 77, 128, 254, 255}) {
            const Texture bytes = *Texture::fromRgba8(
                width, height, std::vector(numbers, static_cast<std::uint8_t>(code)), ColorSpace::linear);
            const Texture floats =
                *Texture::fromRgbaFloat(width, height, std::vector(numbers, static_cast<float>(code) / 255.0f));
            for (const Texture* texture : {&bytes, &floats}) {
                for (int i = 0; i < 60; ++i) {
                    sampler2D s{
                        .texture = texture, .filter = kFilters[i % 3], .u = kModes[i % 4], .v = kModes[i / 4 % 4]};
                    s.borderColor = glm::vec4(static_cast<float>(code) / 255.0f);
                    s.maxAnisotropy = 1 + i % 16;
                    const float2 uv = {Float(random(-2.0f, 2.0f)), Float(random(-2.0f, 2.0f))};
                    const float2 dx = {Float(random(0.0f, 1.0f)), Float(random(0.0f, 0.1f))};
                    const float4 colour = tex2Dgrad(s, uv, dx, {Float(random(0.0f, 0.1f)), Float(0.0f)});
                    for (int c = 0; c < 4; ++c) REQUIRE(colour[c][0] == static_cast<float>(code) / 255.0f);
                }
            }
        }
    }
}

TEST_CASE("sampler: no result leaves the range of its texels, and weights act in one direction (S-560, A-24)")
{
    Random random(5);
    for (const TexelFormat format : kFormats) {
        const Texture texture = randomTexture(format, 16, 16);
        const sampler2D s{.texture = &texture, .mipmaps = false};
        int outside = 0, backward = 0;
        for (int i = 0; i < 3000; ++i) {
            const int x = static_cast<int>(random.bits() % 15), y = static_cast<int>(random.bits() % 15);
            const float u = (static_cast<float>(x) + 0.5f + random(0.0f, 1.0f)) / 16.0f;
            const float v = (static_cast<float>(y) + 0.5f + random(0.0f, 1.0f)) / 16.0f;
            const float4 colour = lodSample(s, u, v);
            const glm::vec4 a = texture.texel(x, y), b = texture.texel(x + 1, y);
            const glm::vec4 c = texture.texel(x, y + 1), d = texture.texel(x + 1, y + 1);
            const glm::vec4 low = glm::min(glm::min(a, b), glm::min(c, d)),
                            high = glm::max(glm::max(a, b), glm::max(c, d));
            for (int k = 0; k < 4; ++k) outside += colour[k][0] < low[k] || colour[k][0] > high[k] ? 1 : 0;
            // Along a row of texel centres: from a to b without turning round.
            const float right =
                lodSample(s, std::nextafter(u, 2.0f) + 1e-4f, (static_cast<float>(y) + 0.5f) / 16.0f).x[0];
            const float left = lodSample(s, u, (static_cast<float>(y) + 0.5f) / 16.0f).x[0];
            const bool sameTexels = std::floor(u * 16.0f - 0.5f) == std::floor((u + 1.1e-4f) * 16.0f - 0.5f);
            if (sameTexels) backward += (right - left) * (b.x - a.x) < 0.0f ? 1 : 0;
        }
        measured("results out of range", outside, 0);
        measured("results that step back", backward, 0);
    }
}

TEST_CASE("sampler: texels with weight 0 do not matter, not even NaN and infinity (S-564)")
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    std::vector<float> pixels(3 * 3 * 4, 0.5f);
    for (const int i : {0, 1, 2, 3, 5, 6, 7, 8}) {
        for (int c = 0; c < 4; ++c) pixels[static_cast<std::size_t>(i * 4 + c)] = i % 2 != 0 ? nan : infinity;
    }
    const Texture texture = *Texture::fromRgbaFloat(3, 3, pixels);
    for (const AddressMode mode : kModes) {
        const sampler2D s{.texture = &texture, .u = mode, .v = mode};
        CHECK(lodSample(s, 0.5f, 0.5f).x[0] == 0.5f);
    }
    const Texture edge = *Texture::fromRgbaFloat(2, 1, std::vector<float>{0.5f, 0.5f, 0.5f, 0.5f, nan, nan, nan, nan});
    const sampler2D s{.texture = &edge, .u = AddressMode::clamp};
    CHECK(lodSample(s, -3.0f, 0.0f).w[0] == 0.5f);
}

TEST_CASE("sampler: what is left out where alpha is 1 everywhere changes no bit of red, green and blue")
{
    for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::rgba16}) {
        // The same colours twice, once with a single texel that is not opaque.
        const auto make = [format](bool opaque) {
            return *Texture::fromLevels(format, 32, 16, [=](int k, const MipLevel* finer) {
                if (k > 0) return coarserLevel(format, *finer);
                MipLevel level(format, 32, 16);
                for (int i = 0; i < 32 * 16; ++i) {
                    for (int c = 0; c < 4; ++c) {
                        const int code = c == 3 && (opaque || i > 0) ? 65535 : i * 6007 * (c + 1) & 65535;
                        if (format == TexelFormat::rgba8) {
                            level.texel<std::uint8_t>(i % 32, i / 32)[c] = static_cast<std::uint8_t>(code >> 8);
                        } else {
                            level.texel<std::uint16_t>(i % 32, i / 32)[c] = static_cast<std::uint16_t>(code);
                        }
                    }
                }
                level.fillFrame();
                return level;
            });
        };
        const Texture opaque = make(true), other = make(false);
        CHECK(opaque.level(0).isOpaque());
        CHECK(opaque.level(3).isOpaque());
        CHECK(!other.level(0).isOpaque());
        Random random(3);
        for (const Filter filter : kFilters) {
            const sampler2D a{.texture = &opaque, .filter = filter}, b{.texture = &other, .filter = filter};
            for (int i = 0; i < 50; ++i) {
                const Float u = random(-2.0f, 2.0f), v = random(-2.0f, 2.0f), lod = random(-1.0f, 5.0f);
                const float4 left = tex2Dlod(a, {u, v, Float(0.0f), lod}),
                             right = tex2Dlod(b, {u, v, Float(0.0f), lod});
                for (int c = 0; c < 3; ++c) CHECK(all(left[c] == right[c]));
                CHECK(all(left.w == 1.0f));
            }
        }
        // A border has an alpha of its own.
        const sampler2D s{.texture = &opaque, .u = AddressMode::border, .borderColor = {0, 0, 0, 0.25f}};
        CHECK(all(tex2Dlod(s, {Float(-1.0f), Float(0.5f), Float(0.0f), Float(0.0f)}).w == 0.25f));
    }
}

TEST_CASE("sampler: byte offsets do not fit 32 bits where textures are large (S-558)")
{
    // A 16384 x 16384 texture of 8 bytes per texel takes 2 GiB; only the addresses are computed here.
    const detail::TexelIndices indices(Int(16384 * 16400));
    alignas(64) static std::byte base[64];
    const std::byte* address = indices.from<8>(base)(0);
    CHECK(reinterpret_cast<std::uintptr_t>(address) - reinterpret_cast<std::uintptr_t>(base) ==
          std::uintptr_t{16384} * 16400 * 8);

    // And the last texel of the largest side that is cheap to make.
    const Texture texture = randomTexture(TexelFormat::rgba16, 16384, 9);
    const sampler2D s{.texture = &texture, .filter = Filter::nearest, .u = AddressMode::clamp, .v = AddressMode::clamp};
    CHECK(lodSample(s, 1.0f, 1.0f).y[0] == texture.texel(16383, 8).y);
}

TEST_CASE("sampler: a missing texture is white, texelSize and TRANSFORM_TEX are Unity's (S-566)")
{
    sampler2D s;
    for (const Filter filter : kFilters) {
        s.filter = filter;
        const float4 colour = tex2D(s, {Float(0.3f), Float(-7.0f)});
        for (int c = 0; c < 4; ++c) CHECK(all(colour[c] == 1.0f));
    }
    CHECK(texelSize(s).w[0] == 1.0f);
    const Texture texture = randomTexture(TexelFormat::rgba8, 8, 2);
    s.texture = &texture;
    CHECK(texelSize(s).x[kLanes - 1] == 0.125f);
    CHECK(texelSize(s).w[0] == 2.0f);
    const float2 uv = TRANSFORM_TEX({Float(0.5f), Float(2.0f)}, {Float(4.0f), Float(3.0f), Float(1.0f), Float(-1.0f)});
    CHECK(uv.x[0] == 3.0f);
    CHECK(uv.y[0] == 5.0f);
}

TEST_CASE("sampler: S-608 slopes from heights 1/512 texel apart are as good as from heights a texel apart")
{
    // A sine of 64 texels whose steepest slope is 1. Inside a texel the interpolant is linear, so no smaller distance
    // is better; with weights of 8 bits this one would be 45 degrees off.
    constexpr double pi = 3.14159265358979323846, scale = 64.0 / pi;
    std::vector<float> texels;
    for (int x = 0; x < 256; ++x) {
        texels.insert(texels.end(), 4, static_cast<float>(0.5 + 0.5 * std::sin(2.0 * pi * (x + 0.5) / 64.0)));
    }
    const Expected<Texture> heights = Texture::fromRgbaFloat(256, 1, texels);
    REQUIRE(heights.has_value());
    const sampler2D s{.texture = &*heights, .filter = Filter::bilinear, .mipmaps = false};
    const auto worst = [&](double delta) {
        double degrees = 0.0;
        for (int i = 0; i < 4096; ++i) {
            const double x = (i + 0.5) / 16.0;
            const auto height = [&](double at) { return lodSample(s, static_cast<float>(at / 256.0), 0.5f).x[0]; };
            const double slope = static_cast<double>(height(x + delta) - height(x)) / delta * scale;
            const double off = std::atan(slope) - std::atan(std::cos(2.0 * pi * x / 64.0));
            degrees = std::fmax(degrees, std::abs(off) * 180.0 / pi);
        }
        return degrees;
    };
    measured("degrees off, a texel apart", worst(1.0), 2.9);
    measured("degrees off, 1/8 texel apart", worst(1.0 / 8.0), 2.9);
    measured("degrees off, 1/256 texel apart", worst(1.0 / 256.0), 2.9);
    measured("degrees off, 1/512 texel apart", worst(1.0 / 512.0), 2.9);
}
