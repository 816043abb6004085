// Samplers of cube maps: levels of detail against algebra, lanes that do not depend on each other, inputs of all kinds.
#include "relief/texture/cube_sampler.h"

#include "cube_fixture.h"
#include "numbers.h"

using namespace cube_fixture;

namespace {

float3 perLaneDirection(const std::function<Direction(int)>& of)
{
    return {perLane([&](int i) { return static_cast<float>(of(i).x); }),
            perLane([&](int i) { return static_cast<float>(of(i).y); }),
            perLane([&](int i) { return static_cast<float>(of(i).z); })};
}

// How fast a direction moves over the face of `d`, in texels: the derivative of the quotients, in double.
double speed(const Direction& d, const Direction& change, int side)
{
    // By a difference over a step that is small enough to stay on the face's plane.
    const double h = 1e-7;
    const auto project = [&](double t) {
        const Direction p = {d.x + change.x * t, d.y + change.y * t, d.z + change.z * t};
        const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);  // the face is that of d
        if (z >= x && z >= y) return std::array{p.x / p.z, p.y / p.z};
        if (y >= x) return std::array{p.x / p.y, p.z / p.y};
        return std::array{p.z / p.x, p.y / p.x};
    };
    const auto a = project(-h), b = project(h);
    return std::hypot(b[0] - a[0], b[1] - a[1]) / (2.0 * h) * 0.5 * side;
}

bool sameColour(const float4& a, const float4& b, int lane)
{
    return sameBits(a, b, lane);
}

}  // namespace

TEST_CASE("cube_sampler: the level of detail is log2 of the texels that a pixel covers on the lane's own face")
{
    const CubeMap map = levelsCube(9);
    const samplerCUBE s{.texture = &map};
    Random random(2);
    double worst = 0.0;
    for (int i = 0; i < trials(4000); ++i) {
        const Direction d = randomDirection(random), unit = d.unit();
        const double size = std::exp2(static_cast<double>(random(-8.0f, -1.0f))) * d.length();
        const auto change = [&](double scale) {
            const Direction r = randomDirection(random).unit();
            return Direction{r.x * scale, r.y * scale, r.z * scale};
        };
        const Direction dx = change(size), dy = change(size * static_cast<double>(random(0.0f, 1.0f)));
        const double texels = std::fmax(speed(d, dx, 256), speed(d, dy, 256));
        const double expected = std::clamp(std::log2(texels), 0.0, 8.0);
        const float level = texCUBEgrad(s, toLanes(d), toLanes(dx), toLanes(dy)).x[0];
        worst = std::fmax(worst, std::abs(static_cast<double>(level) - expected));
        CHECK(unit.length() > 0.99);
    }
    measured("level of detail, beside 1/512 of rounding", worst, 1.0 / 512.0 + 1e-4);
}

TEST_CASE("cube_sampler: quads that lie across an edge or a corner have the level of quads beside it")
{
    // Pixels on a plane through the cube's edge or corner, about 4 texels apart: on either face that is a level of
    // about 2, where differences of a face's coordinates would give the last level.
    const CubeMap map = levelsCube(9);
    const samplerCUBE s{.texture = &map};
    Random random(12);
    double farthest = 0.0;
    for (int i = 0; i < trials(2000); ++i) {
        Direction centre = {1.0, 1.0, i % 2 == 0 ? 1.0 : static_cast<double>(random(-0.9f, 0.9f))};
        if (i % 3 == 1) centre = {centre.z, -1.0, 1.0};
        if (i % 3 == 2) centre = {-1.0, centre.z, -1.0};
        const Direction right = randomDirection(random).unit(), down = randomDirection(random).unit();
        const double step = 4.0 * 2.0 / 256.0, offset = static_cast<double>(random(-1.0f, 1.0f));
        const auto pixel = [&](int lane) {
            const double x = (laneX(lane) - 0.5 + offset) * step, y = (laneY(lane) - 0.5) * step;
            return Direction{centre.x + right.x * x + down.x * y, centre.y + right.y * x + down.y * y,
                             centre.z + right.z * x + down.z * y};
        };
        const float4 colour = texCUBE(s, perLaneDirection(pixel));
        for (int lane = 0; lane < kLanes; ++lane) {
            const Direction d = pixel(lane);
            const Direction dx = {right.x * step, right.y * step, right.z * step};
            const Direction dy = {down.x * step, down.y * step, down.z * step};
            const double expected = std::log2(std::fmax(speed(d, dx, 256), speed(d, dy, 256)));
            farthest = std::fmax(farthest, std::abs(static_cast<double>(colour.x[lane]) - std::fmax(expected, 0.0)));
        }
    }
    measured("level of detail", farthest, 1.0 / 512.0 + 1e-3);
}

TEST_CASE("cube_sampler: texCUBElod, texCUBEbias and the sampler's limits choose the level")
{
    const CubeMap map = levelsCube(6);
    samplerCUBE s{.texture = &map};
    const Direction d = {0.3, -1.0, 0.2};
    for (const float lod : {0.0f, 0.25f, 1.0f, 3.5f, 5.0f}) CHECK(lodSample(s, d, lod).x[0] == lod);
    CHECK(lodSample(s, d, -3.0f).x[0] == 0.0f);
    CHECK(lodSample(s, d, 77.0f).x[0] == 5.0f);
    CHECK(lodSample(s, d, kNan).x[0] == 5.0f);
    CHECK(lodSample(s, d, -kInfinity).x[0] == 0.0f);

    const float3 still = toLanes(d);
    CHECK(texCUBE(s, still).x[0] == 0.0f);  // no change at all: level 0
    const Direction change = {0.25, 0.0, 0.0};
    const float level = texCUBEgrad(s, still, toLanes(change), toLanes({})).x[0];
    CHECK(level == 2.0f);  // 1/4 of half a face of 32 texels
    const float3 moving = perLaneDirection([](int lane) { return Direction{0.25 * laneX(lane), -1.0, 0.2}; });
    CHECK(texCUBE(s, moving).x[0] == 2.0f);
    CHECK(texCUBEbias(s, float4(moving, Float(1.5f))).x[0] == 3.5f);
    s.lodBias = -0.5f;
    CHECK(texCUBEbias(s, float4(moving, Float(1.5f))).x[0] == 3.0f);
    CHECK(lodSample(s, d, 2.0f).x[0] == 1.5f);
    s.minLod = 2.5f;
    s.maxLod = 3.25f;
    CHECK(lodSample(s, d, 0.0f).x[0] == 2.5f);
    CHECK(lodSample(s, d, 5.0f).x[0] == 3.25f);
    s = {.texture = &map, .filter = Filter::bilinear};
    CHECK(lodSample(s, d, 1.49f).x[0] == 1.0f);
    CHECK(lodSample(s, d, 1.5f).x[0] == 2.0f);
    s.mipmaps = false;
    CHECK(lodSample(s, d, 4.0f).x[0] == 0.0f);
    CHECK(texCUBE(s, moving).x[0] == 0.0f);
}

TEST_CASE("cube_sampler: any direction gives the colour of a face: zero, NaN, infinite, huge, subnormal (S-569)")
{
    for (const int side : {1, 4}) {
        const CubeMap map = noiseCube(TexelFormat::rgba32Float, side);
        for (const Filter filter : kFilters) {
            const samplerCUBE s{.texture = &map, .filter = filter};
            const auto sample = [&](float x, float y, float z) {
                return texCUBElod(s, {Float(x), Float(y), Float(z), Float(0.0f)});
            };
            const auto same = [&](const float4& a, const float4& b) { return sameColour(a, b, 0); };
            CHECK(same(sample(0, 0, 0), sample(0, 0, 1)));
            CHECK(same(sample(-0.0f, -0.0f, -0.0f), sample(0, 0, 1)));
            CHECK(same(sample(kNan, kNan, kNan), sample(0, 0, 1)));
            CHECK(same(sample(kNan, -2, 1), sample(0, -2, 1)));
            CHECK(same(sample(kInfinity, 3, 1), sample(1, 0, 0)));
            CHECK(same(sample(-kInfinity, kInfinity, 1), sample(-1, 1, 0)));
            CHECK(same(sample(kInfinity, kInfinity, -kInfinity), sample(1, 1, -1)));
            for (const float scale : {1e38f, 1e-38f, 0x1p-149f}) {  // the last: subnormal, and exact for small integers
                CHECK(same(sample(scale, 0, 0), sample(1, 0, 0)));
                CHECK(same(sample(3 * scale, -2 * scale, scale), sample(3, -2, 1)));
            }
            const float numbers[] = {0.0f, 1.0f, -1.0f, 1e38f, -3e38f, 1e-45f, kNan, kInfinity, -kInfinity};
            int wrong = 0;
            for (int i = 0; i < 9 * 9 * 9 * 9; ++i) {
                const float3 d = {Float(numbers[i % 9]), Float(numbers[i / 9 % 9]), Float(numbers[i / 81 % 9])};
                const float3 change = {Float(numbers[i / 729]), Float(numbers[i % 9]), Float(numbers[i / 9 % 9])};
                const float4 samples[] = {texCUBE(s, perLane([&](int lane) { return numbers[(i + lane) % 9]; }) * d),
                                          texCUBEgrad(s, d, change, -change), texCUBEbias(s, float4(d, change.x))};
                for (const float4& colour : samples) {
                    for (int lane = 0; lane < kLanes; ++lane)
                        wrong += colour.x[lane] >= 0.0f && colour.x[lane] <= 1.0f ? 0 : 1;
                }
            }
            measured("colours out of the texels' range", wrong, 0);
        }
    }
}

TEST_CASE("cube_sampler: exactly on an edge or a corner, and one float beside it, is the same place (S-568)")
{
    // Texels are numbers of 0..1. One float aside moves a weight by at most 1/4096 in each of two directions, as
    // positions are rounded to that; on level 1 of 4 texels as on level 0.
    Random random(11);
    double worst = 0.0, outOfRange = 0.0;
    for (const int side : {1, 2, 4, 16}) {
        const CubeMap map = noiseCube(TexelFormat::rgba32Float, side, 7);
        for (const Filter filter : {Filter::bilinear, Filter::trilinear}) {
            const samplerCUBE s{.texture = &map, .filter = filter};
            const auto sample = [&](const glm::vec3& d, float lod) {
                return texCUBElod(s, {Float(d.x), Float(d.y), Float(d.z), Float(lod)});
            };
            for (int i = 0; i < trials(400); ++i) {
                // Two or three of the components are 1 or -1.
                glm::vec3 d;
                for (int c = 0; c < 3; ++c) d[c] = random.bits() % 2 == 0 ? 1.0f : -1.0f;
                const auto free = static_cast<int>(random.bits() % 4);
                if (free < 3) d[free] = random.bits() % 8 == 0 ? 0.0f : random(-1.0f, 1.0f);
                const float lod = side > 1 && random.bits() % 3 == 0 ? 1.0f : 0.0f;
                const float4 on = sample(d, lod);
                for (int k = 0; k < 27; ++k) {
                    glm::vec3 beside = d;
                    const int steps[] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
                    for (int c = 0; c < 3; ++c) {
                        if (steps[c] != 0 && std::abs(d[c]) == 1.0f)
                            beside[c] = std::nextafter(d[c], steps[c] > 0 ? 2.0f : -2.0f);
                    }
                    const float4 colour = sample(beside, lod);
                    for (int c = 0; c < 4; ++c) {
                        worst = std::fmax(worst,
                                          std::abs(static_cast<double>(colour[c][0]) - static_cast<double>(on[c][0])));
                        outOfRange += colour[c][0] >= 0.0f && colour[c][0] <= 1.0f ? 0.0 : 1.0;
                    }
                }
            }
        }
    }
    measured("change of a colour of 0..1", worst, 2.0 / 4096.0);
    measured("colours out of the texels' range", outOfRange, 0);
}

TEST_CASE("cube_sampler: what a lane gets does not depend on the others, and texels are counted by lanes")
{
    Random random(9);
    for (const TexelFormat format : kColorFormats) {
        const CubeMap map = noiseCube(format, 16);
        const samplerCUBE s{.texture = &map};
        int different = 0;
        for (int i = 0; i < trials(300); ++i) {
            std::array<Direction, kLanes> directions;
            for (Direction& d : directions) d = randomDirection(random);
            const Float lod = perLane([&](int) { return random(-1.0f, 5.0f); });
            const float3 all = perLaneDirection([&](int lane) { return directions[static_cast<std::size_t>(lane)]; });
            const float4 together = texCUBElod(s, float4(all, lod));
            for (int lane = 0; lane < kLanes; ++lane) {
                const float4 alone = lodSample(s, directions[static_cast<std::size_t>(lane)], lod[lane]);
                different += sameColour(together, alone, lane) ? 0 : 1;
            }
        }
        measured("lanes that differ", different, 0);
    }

    const CubeMap map = noiseCube(TexelFormat::rgba8, 8);
    samplerCUBE s{.texture = &map};
    const ActiveLanes active(0b1011);
    const auto counted = [&](const auto& sample) {
        shading.fetches = {};
        sample();
        return shading.fetches;
    };
    const FetchCounters one = counted([&] { lodSample(s, {1, 0, 0}, 1.0f); });
    CHECK(one == FetchCounters{.trilinear = 3, .secondLevelSkipped = 3, .noDerivatives = 3});
    const FetchCounters two = counted([&] { texCUBE(s, toLanes({1, 0, 0})); });
    CHECK(two == FetchCounters{.trilinear = 3, .magnified = 3, .secondLevelSkipped = 3});
    s.filter = Filter::nearest;
    const FetchCounters three = counted([&] { texCUBEgrad(s, toLanes({1, 0, 0}), toLanes({0, 0.5, 0}), toLanes({})); });
    CHECK(three == FetchCounters{.nearest = 3, .noDerivatives = 3});
    shading.fetches = {};
}

TEST_CASE("cube_sampler: no cube map is white")
{
    CHECK(lodSample({}, {1, 2, 3}).x[0] == 1.0f);
    CHECK(texCUBE({}, toLanes({1, 2, 3})).w[0] == 1.0f);
}

TEST_CASE("cube_sampler: the same bits for every number of lanes")
{
    // FNV-1a over the bits of 3 x 4096 colours, as every build has them.
    std::uint64_t hash = 14695981039346656037u;
    for (const TexelFormat format : kColorFormats) {
        const CubeMap map = noiseCube(format, 13);
        const samplerCUBE s{.texture = &map};
        Random random(6);
        for (int block = 0; block < 4096 / kLanes; ++block) {
            float lanes[4][kLanes];
            for (int lane = 0; lane < kLanes; ++lane) {
                for (auto& component : lanes) component[lane] = random(-1.0f, 1.0f);
            }
            const float3 d = {Float::load(lanes[0]), Float::load(lanes[1]), Float::load(lanes[2])};
            const float4 colour = texCUBEgrad(s, d, float3(Float::load(lanes[3]) * 0.2f), float3(d.x * 0.1f));
            for (int lane = 0; lane < kLanes; ++lane) {
                for (int c = 0; c < 4; ++c) {
                    hash = (hash ^ static_cast<std::uint32_t>(asInt(colour[c])[lane])) * 1099511628211u;
                }
            }
        }
    }
    CHECK(hash == 2769588976239679301u);
}

TEST_CASE("cube_sampler: without seamless filters a face is a picture of its own, clamped at its edges")
{
    Random random(44);
    int across = 0;
    for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::rgba16, TexelFormat::rgba32Float}) {
        const int side = 4;
        const CubeMap map = noiseCube(format, side);
        samplerCUBE s{.texture = &map, .filter = Filter::bilinear};
        for (int i = 0; i < trials(500); ++i) {
            // Multiples of 1/128 of a texel: weights are exact.
            const auto place = [&random] { return static_cast<double>(random.bits() % 511) / 256.0 - 255.0 / 256.0; };
            const OnFace at = {static_cast<int>(random.bits() % 6), place(), place()};
            s.seamless = false;
            const float4 color = lodSample(s, directionOf(at));
            const double x = (at.s + 1.0) * 0.5 * side - 0.5, y = (1.0 - at.t) * 0.5 * side - 0.5;
            const int i0 = static_cast<int>(std::floor(x)), j0 = static_cast<int>(std::floor(y));
            const auto texel = [&](int dx, int dy, int channel) {
                const int a = std::clamp(i0 + dx, 0, side - 1), b = std::clamp(j0 + dy, 0, side - 1);
                return static_cast<double>(map.texel(0, at.face, a, b)[channel]);
            };
            const double fx = x - i0, fy = y - j0;
            for (int c = 0; c < 4; ++c) {
                const double expected = (texel(0, 0, c) * (1.0 - fx) + texel(1, 0, c) * fx) * (1.0 - fy) +
                                        (texel(0, 1, c) * (1.0 - fx) + texel(1, 1, c) * fx) * fy;
                CHECK(std::abs(static_cast<double>(color[c][0]) - expected) < 6e-4);
            }
            s.seamless = true;
            const bool isInside = i0 >= 0 && j0 >= 0 && i0 < side - 1 && j0 < side - 1;
            const double difference = maxDifference(color, lodSample(s, directionOf(at)));
            if (isInside) CHECK(difference == 0.0);
            across += !isInside && difference > 0.01;
        }
    }
    CHECK(across > 50);
}
