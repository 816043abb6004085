// The sampler on blocks whose lanes want different things: each lane gets what it would get alone, lanes that do not
// count cost nothing, and the counters count lanes. Anisotropic sampling is here too.
#include "relief/texture/sampler.h"

#include "sampler_fixture.h"

using namespace sampler_fixture;

namespace {

Float everyLane(Float v, int lane)
{
    return v[lane];
}

// Coordinates and derivatives without any relation between lanes.
struct Wild
{
    float2 uv, dx, dy;

    explicit Wild(Random& random)
    {
        const Float scale = perLane([&](int) { return std::exp2(random(-9.0f, 0.0f)); });
        const auto number = [&](int) { return random(-1.0f, 1.0f); };
        uv = {perLane(number) * 2.0f, perLane(number) * 2.0f};
        dx = {perLane(number) * scale, perLane(number) * scale};
        dy = {perLane(number) * scale, perLane(number) * scale};
    }
};

// A block of coordinates that grow by `texels` texels of a 64-texel side per pixel.
float2 evenly(float texels)
{
    return {perLane([=](int i) { return static_cast<float>(laneX(i)) * texels / 64.0f; }),
            perLane([=](int i) { return static_cast<float>(laneY(i)) * texels / 64.0f; })};
}

}  // namespace

TEST_CASE("sampler_lanes: what a lane gets does not depend on the others, nor on which of them count (S-514, S-515)")
{
    Random random(11);
    int different = 0, compared = 0;
    for (const TexelFormat format : kFormats) {
        const Texture texture = randomTexture(format, 60, 37);
        for (int round = 0; round < 240 / kLanes * 2; ++round) {
            sampler2D s{.texture = &texture, .filter = kFilters[round % 3], .u = kModes[round % 4]};
            s.v = kModes[round / 4 % 4];
            s.maxAnisotropy = round % 5 == 0 ? 16 : 1;
            s.lodBias = round % 7 == 0 ? -0.3f : 0.0f;
            const Wild w(random);
            unsigned quads = wholeQuads(random.bits() & kAllLanes & random.bits());
            quads = round % 3 == 0 ? kAllLanes : quads;
            const float4 together = [&] {
                const ActiveLanes counting(quads);
                return tex2Dgrad(s, w.uv, w.dx, w.dy);
            }();
            for (int i = 0; i < kLanes; ++i) {
                if ((quads >> i & 1u) == 0) continue;
                const float4 alone = tex2Dgrad(s, {everyLane(w.uv.x, i), everyLane(w.uv.y, i)},
                                               {everyLane(w.dx.x, i), everyLane(w.dx.y, i)},
                                               {everyLane(w.dy.x, i), everyLane(w.dy.y, i)});
                different += sameBits(together, alone, i) ? 0 : 1;
                ++compared;
            }
        }
    }
    measured("lanes that differ", different, 0);
    CHECK(compared > 500);
}

TEST_CASE("sampler_lanes: tex2D is tex2Dgrad with the quad's differences, tex2Dbias adds levels")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 64, 64);
    sampler2D s{.texture = &texture};
    for (const float texels : {0.3f, 1.0f, 1.7f, 5.0f, 90.0f}) {
        const float2 uv = evenly(texels);
        const float4 implied = tex2D(s, uv);
        const float4 given = tex2Dgrad(s, uv, ddx(uv), ddy(uv));
        const float4 biased = tex2Dbias(s, {uv.x, uv.y, Float(0.0f), Float(0.75f)});
        sampler2D withBias = s;
        withBias.lodBias = 0.75f;
        const float4 same = tex2D(withBias, uv);
        const float4 byLevel = tex2Dlod(s, {uv.x, uv.y, Float(0.0f), calculateLevelOfDetail(s, uv)});
        for (int i = 0; i < kLanes; ++i) {
            CHECK(sameBits(implied, given, i));
            CHECK(sameBits(biased, same, i));
            CHECK(sameBits(implied, byLevel, i));
        }
    }
}

TEST_CASE("sampler_lanes: the biases of sampler and call together count from -16 to 15.99 (S-511)")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 64, 64);
    struct Row
    {
        float texels, bias, level;  // a level before bias of -10 and of 18
    };
    for (const Row& row : {Row{0x1p-10f, 100.0f, 5.99f}, Row{0x1p-10f, 12.5f, 2.5f}, Row{0x1p18f, -100.0f, 2.0f},
                           Row{0x1p18f, -14.5f, 3.5f}}) {
        CAPTURE(row.bias);
        const float2 uv = evenly(row.texels);
        const sampler2D plain{.texture = &texture}, whole{.texture = &texture, .lodBias = row.bias},
            half{.texture = &texture, .lodBias = 0.5f * row.bias};
        const float4 expected = tex2Dlod(plain, {uv.x, uv.y, Float(0.0f), Float(row.level)});
        const float4 bySampler = tex2D(whole, uv),
                     byBoth = tex2Dbias(half, {uv.x, uv.y, Float(0.0f), Float(0.5f * row.bias)});
        for (int i = 0; i < kLanes; ++i) {
            CHECK(sameBits(bySampler, expected, i));
            CHECK(sameBits(byBoth, expected, i));
        }
    }
}

TEST_CASE("sampler_lanes: lanes that do not count neither build levels nor change counters")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 64, 64);
    const sampler2D s{.texture = &texture};
    const Float scale = perLane([](int i) { return i < 4 ? 0.0f : 20.0f; });  // all but the first quad want far levels
    const float2 zero = {Float(0.0f), Float(0.0f)}, far = {scale / 64.0f, Float(0.0f)};
    shading.fetches = {};
    {
        const ActiveLanes counting(0xfu);
        (void)tex2Dgrad(s, evenly(1.0f), far, zero);
    }
    CHECK(texture.levelsBuilt() == 1);
    CHECK(shading.fetches ==
          FetchCounters{.trilinear = 4, .magnified = 4, .secondLevelSkipped = 4, .noDerivatives = 4});
    {
        const ActiveLanes counting(0u);
        (void)tex2Dgrad(s, evenly(1.0f), zero, zero);
    }
    CHECK(shading.fetches.trilinear == 4);
}

TEST_CASE("sampler_lanes: a sampler that never minifies never builds a level, nor one without mip levels")
{
    const Texture texture = randomTexture(TexelFormat::rgba16, 64, 64);
    sampler2D s{.texture = &texture};
    (void)tex2D(s, evenly(0.9f));
    CHECK(texture.levelsBuilt() == 1);
    s.mipmaps = false;
    (void)tex2D(s, evenly(30.0f));
    CHECK(texture.levelsBuilt() == 1);
    CHECK(all(calculateLevelOfDetail(s, evenly(30.0f)) == 0.0f));
    s.mipmaps = true;
    (void)tex2D(s, evenly(2.0f));  // exactly level 1: level 2 is not needed
    CHECK(texture.levelsBuilt() == 2);
    const Float halfOrOne = perLane([](int i) { return i % 2 == 0 ? 0.5f : 1.0f; });  // nor where others are between
    (void)tex2Dlod(s, float4(evenly(1.0f), Float(0.0f), halfOrOne));
    CHECK(texture.levelsBuilt() == 2);
    (void)tex2D(s, evenly(2.1f));
    CHECK(texture.levelsBuilt() == 3);
}

TEST_CASE("sampler_lanes: counters count lanes, by kind")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 64, 64);
    constexpr auto n = static_cast<std::uint64_t>(kLanes);
    const auto counted = [&](sampler2D s, float texels) {
        s.texture = s.texture ? s.texture : &texture;
        shading.fetches = {};
        (void)tex2D(s, evenly(texels));
        return shading.fetches;
    };
    CHECK(counted({.filter = Filter::nearest}, 0.5f) == FetchCounters{.nearest = n, .magnified = n});
    CHECK(counted({.filter = Filter::bilinear}, 3.0f) == FetchCounters{.bilinear = n});
    CHECK(counted({}, 3.0f) == FetchCounters{.trilinear = n});
    CHECK(counted({}, 4.0f) == FetchCounters{.trilinear = n, .secondLevelSkipped = n});
    CHECK(counted({}, 0.5f) == FetchCounters{.trilinear = n, .magnified = n, .secondLevelSkipped = n});
    CHECK(counted({.maxAnisotropy = 8}, 0.5f) ==
          FetchCounters{.anisotropic = n, .magnified = n, .taps = n, .secondLevelSkipped = n});
    CHECK(counted({.maxAnisotropy = 8}, 3.0f) == FetchCounters{.anisotropic = n, .taps = n});
    CHECK(counted({.texture = &Texture::grey()}, 3.0f) ==
          FetchCounters{.trilinear = n, .constant = n, .magnified = n, .secondLevelSkipped = n, .noDerivatives = n});
    FetchCounters sum = counted({}, 3.0f);
    sum += counted({}, 3.0f);
    CHECK(sum.trilinear == 2 * n);
    sum += counted({.mipmaps = false}, 3.0f);
    sum += counted({.mipmaps = false}, 3.0f);
    CHECK(sum.noDerivatives == 2 * n);
}

TEST_CASE("sampler_lanes: derivatives are taken only where a level of detail is chosen by them")
{
    const Texture mipped = randomTexture(TexelFormat::rgba8, 64, 64);
    const float2 uv = evenly(3.0f), change = {Float(3.0f / 64.0f), Float(0.0f)};
    const auto level = [&uv](float w) { return float4(uv.x, uv.y, Float(0.0f), Float(w)); };
    struct Row
    {
        const char* what;
        sampler2D s;
        bool takes;  // tex2D and tex2Dbias; tex2Dlod and tex2Dgrad never do
    };
    for (const Row& row :
         {Row{"mip levels", {.texture = &mipped}, true}, Row{"nearest", {&mipped, Filter::nearest}, true},
          Row{"anisotropic", {.texture = &mipped, .maxAnisotropy = 8}, true},
          Row{"no mip levels", {.texture = &mipped, .mipmaps = false}, false},
          Row{"one level, and a border", {.texture = &Texture::grey(), .u = AddressMode::border}, false},
          Row{"constant", {.texture = &Texture::grey()}, false}, Row{"no texture", {}, false}}) {
        CAPTURE(row.what);
        for (const unsigned active : {kAllLanes, 0xfu}) {
            const ActiveLanes counting(active);
            const auto lanes = static_cast<std::uint64_t>(std::popcount(active));
            const auto without = [](const auto& sample) {
                shading.fetches = {};
                (void)sample();
                return shading.fetches.noDerivatives;
            };
            const std::uint64_t expected = row.takes ? 0 : lanes;
            CHECK(without([&] { return tex2D(row.s, uv); }) == expected);
            CHECK(without([&] { return tex2Dbias(row.s, level(0.5f)); }) == expected);
            CHECK(without([&] { return tex2Dlod(row.s, level(0.5f)); }) == lanes);
            CHECK(without([&] { return tex2Dgrad(row.s, uv, change, change); }) == lanes);
        }
    }
}

TEST_CASE("sampler_lanes: anisotropic sampling takes as many taps as the footprint is long, at most 16 (S-562, A-30)")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 64, 64);
    const sampler2D s{.texture = &texture, .maxAnisotropy = 16};
    struct Row
    {
        float xu, yv;  // texels per pixel
        int taps;
    };
    for (const Row& row : {Row{4, 1, 4}, Row{16, 1, 16}, Row{1e6f, 1, 16}, Row{1, 1e6f, 16}, Row{3, 2, 2}, Row{8, 8, 1},
                           Row{8, 0, 8}, Row{0.5f, 0, 1}, Row{2.5f, 0, 3}, Row{2.1f, 0, 3}}) {
        shading.fetches = {};
        (void)tex2Dgrad(s, evenly(1.0f), {Float(row.xu / 64.0f), Float(0.0f)}, {Float(0.0f), Float(row.yv / 64.0f)});
        CAPTURE(row.xu);
        CHECK(shading.fetches.taps == static_cast<std::uint64_t>(kLanes * row.taps));
    }
}

TEST_CASE("sampler_lanes: anisotropic sampling averages along the longer side, and does not blur the shorter (S-562)")
{
    // Columns alternate, rows are all the same. Long along u: the average; long along v: the columns stay apart.
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 64 * 64; ++i) {
        const std::uint8_t value = i % 2 != 0 ? 255 : 0;
        pixels.insert(pixels.end(), {value, value, value, 255});
    }
    const Texture texture = *Texture::fromRgba8(64, 64, pixels, ColorSpace::linear);
    sampler2D s{.texture = &texture, .maxAnisotropy = 16};
    const float2 atOddColumn = {Float(33.5f / 64.0f), Float(0.5f)};
    const float2 small = {Float(1.0f / 64.0f), Float(0.0f)}, tall = {Float(0.0f), Float(8.0f / 64.0f)};
    const float2 wide = {Float(8.0f / 64.0f), Float(0.0f)}, low = {Float(0.0f), Float(1.0f / 64.0f)};
    CHECK(tex2Dgrad(s, atOddColumn, small, tall).x[0] == 1.0f);
    CHECK(tex2Dgrad(s, atOddColumn, wide, low).x[0] == doctest::Approx(0.5));
    s.maxAnisotropy = 1;
    CHECK(tex2Dgrad(s, atOddColumn, small, tall).x[0] == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("sampler_lanes: one hash of everything, for any number of lanes, compiler and instruction set")
{
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 1099511628211u; };
    FetchCounters total;
    for (int round = 0; round < 72; ++round) {
        const Texture texture = randomTexture(kFormats[round % 3], round % 2 != 0 ? 64 : 37, round % 5 != 0 ? 48 : 3);
        sampler2D s{.texture = &texture, .filter = kFilters[round / 3 % 3], .u = kModes[round % 4]};
        s.v = kModes[round / 4 % 4];
        s.maxAnisotropy = round % 2 != 0 ? 16 : 1;
        s.lodBias = round % 7 == 0 ? -0.4f : 0.0f;
        s.borderColor = {0.1f, 0.2f, 0.3f, 0.4f};

        // A turned plane in perspective, 16x16 pixels, of which some count. The order of the hash is the pixels'.
        std::uint32_t image[16][16] = {};
        const float turn = static_cast<float>(round) * 0.37f, zoom = 0.003f * static_cast<float>(1 + round % 24);
        shading.fetches = {};
        for (int top = 0; top < 16; top += kBlockHeight) {
            for (int left = 0; left < 16; left += kBlockWidth) {
                const Float x = perLane([=](int i) { return static_cast<float>(left + laneX(i)); });
                const Float y = perLane([=](int i) { return static_cast<float>(top + laneY(i)); });
                const Float w = zoom / (1.0f + y * (0.05f * static_cast<float>(round % 3)));
                const unsigned covered = (x * 3.0f + y * 7.0f < static_cast<float>(20 + 2 * round)).bits();
                const ActiveLanes counting(wholeQuads(covered));
                const float4 colour = tex2D(s, {(x + y * turn) * w - 1.0f, (y - x * turn) * w + 0.3f});
                for (int i = 0; i < kLanes; ++i) {
                    std::uint32_t bits = 0;
                    for (int c = 0; c < 4; ++c) bits = bits * 31u + static_cast<std::uint32_t>(asInt(colour[c])[i]);
                    image[top + laneY(i)][left + laneX(i)] = (shading.activeLanes >> i & 1u) != 0 ? bits : 0u;
                }
            }
        }
        for (const auto& row : image) {
            for (const std::uint32_t bits : row) add(bits);
        }
        total += shading.fetches;
    }
    add(total.nearest + 3 * total.bilinear + 5 * total.trilinear + 7 * total.anisotropic);
    add(total.magnified + 3 * total.taps + 5 * total.secondLevelSkipped);
    CHECK(total.taps > 1000);
    CHECK(hash == 7090569058970184443u);
}

TEST_CASE("sampler_lanes: tex2DWhere is tex2D where it is needed, 0 elsewhere, and fetches nothing else (S-515)")
{
    const Texture texture = randomTexture(TexelFormat::rgba8, 64, 64);
    const sampler2D s{.texture = &texture};
    Random random(515);
    for (int round = 0; round < 64; ++round) {
        const float2 uv = evenly(random(0.1f, 9.0f));
        const unsigned needed = round == 0 ? 0u : round == 1 ? kAllLanes : random.bits() & kAllLanes;
        const unsigned active = round % 3 == 0 ? kAllLanes : wholeQuads(random.bits() & kAllLanes);
        const ActiveLanes counting(active);
        const float4 all = tex2D(s, uv);
        const FetchCounters before = shading.fetches;
        const float4 some = tex2DWhere(Mask::fromBits(needed), s, uv);
        CHECK(shading.activeLanes == active);
        CHECK(shading.fetches.trilinear - before.trilinear ==
              static_cast<std::uint64_t>(std::popcount(needed & active)));
        for (int i = 0; i < kLanes; ++i) {
            if ((active >> i & 1u) == 0) continue;
            const bool wanted = (needed >> i & 1u) != 0;
            CHECK(sameBits(some, wanted ? all : float4(0.0f), i));
        }
    }
}
