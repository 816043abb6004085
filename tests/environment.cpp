// Prefiltered surroundings against integrals in double, and what must hold exactly.
#include "relief/shading/environment.h"

#include "cube_fixture.h"
#include "numbers.h"
#include "relief/pipeline/workers.h"

using namespace cube_fixture;

namespace {

// The integral by the definition: radiance times D(h) n.l over the sphere, h half-way between n and l, divided by the
// same without radiance. Rings of equal tilt of h, as GGX spreads them, and points around each.
double reflected(const Radiance& radiance, int channel, const Direction& n, double roughness)
{
    constexpr int kRings = 256, kTurns = 128;
    const double a2 = std::pow(roughness, 4.0);
    const Direction x = std::abs(n.x) < 0.5 ? Direction{0.0, n.z, -n.y}.unit() : Direction{-n.y, n.x, 0.0}.unit();
    const Direction y = {n.y * x.z - n.z * x.y, n.z * x.x - n.x * x.z, n.x * x.y - n.y * x.x};
    double sum = 0.0, weights = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double u = (ring + 0.5) / kRings, tilt = 2.0 * std::atan(std::sqrt(a2 * u / (1.0 - u)));
        const double cosine = std::cos(tilt), sine = std::sin(tilt);
        if (cosine <= 0.0) continue;
        for (int i = 0; i < kTurns; ++i) {
            const double turn = 2.0 * kPi * (i + 0.5) / kTurns, p = sine * std::cos(turn), q = sine * std::sin(turn);
            const Direction l = {x.x * p + y.x * q + n.x * cosine, x.y * p + y.y * q + n.y * cosine,
                                 x.z * p + y.z * q + n.z * cosine};
            sum += radiance(l, channel) * cosine;
            weights += cosine;
        }
    }
    return sum / weights;
}

// Over the texels of a cube map's finest level, each the same all over: function(direction, colour, solid angle).
template <class Function>
void forTexels(const CubeMap& map, Function function)
{
    const int side = map.side();
    for (int i = 0; i < kCubeFaces * side * side; ++i) {
        const int face = i / (side * side), x = i % side, y = i / side % side;
        const Direction d = pixelDirection(face, x, side - 1 - y, side);
        // The corners of the texel on the plane: the solid angle is a sum of arctangents.
        const auto corner = [&](int column, int row) {
            const double s = 2.0 * column / side - 1.0, t = 2.0 * row / side - 1.0;
            return std::atan2(s * t, std::sqrt(s * s + t * t + 1.0));
        };
        const double angle = corner(x + 1, y + 1) - corner(x, y + 1) - corner(x + 1, y) + corner(x, y);
        function(d.unit(), map.texel(0, face, x, y), angle);
    }
}

// The same integral over texels: for light with steps in it, and lobes that are wide beside a texel.
glm::dvec3 reflectedOf(const CubeMap& map, const Direction& n, double roughness)
{
    const double a2 = std::pow(roughness, 4.0);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    forTexels(map, [&](const Direction& l, const glm::vec4& color, double angle) {
        const double cosine = dot(n, l);
        if (cosine <= 0.0) return;
        const double half2 = (1.0 + cosine) * 0.5, d = half2 * (a2 - 1.0) + 1.0;  // cos^2 of half the angle
        const double weight = a2 / (d * d) * cosine * angle;
        sum += glm::dvec3(color) * weight;
        weights += weight;
    });
    return sum / weights;
}

CubeMap prefiltered(const CubeMap& radiance, const PrefilterSettings& settings)
{
    const Expected<ImageFloat> picture = prefilteredEnvironment(radiance, settings);
    REQUIRE(picture.has_value());
    return *CubeMap::fromPicture(*picture, ColorSpace::linear);
}

Direction texelDirection(int face, int x, int y, int side)
{
    return pixelDirection(face, x, side - 1 - y, side).unit();
}

// A dim sky and a sun of a few texels, a thousand times as bright.
double sunny(const Direction& d, int channel)
{
    const Direction sun = Direction{0.5, 0.7, -0.4}.unit();
    return dot(d, sun) > 0.995 ? 1000.0 : smooth(d, channel);
}

// Root of the mean square over texels and colours, relative to the mean, of each level but the mirror.
std::vector<double> errorsOf(const CubeMap& map, const CubeMap& radiance)
{
    std::vector<double> errors;
    for (int k = 1; k < map.levelCount(); ++k) {
        const int side = map.level(k).width(), step = std::max(1, side / 4);
        double squares = 0.0, sum = 0.0;
        for (int face = 0; face < kCubeFaces; ++face) {
            for (int y = step / 2; y < side; y += step) {
                for (int x = step / 2; x < side; x += step) {
                    const glm::dvec3 exact = reflectedOf(radiance, texelDirection(face, x, y, side),
                                                         static_cast<double>(roughnessOfLevel(k, map.levelCount())));
                    const glm::dvec3 off = glm::dvec3(map.texel(k, face, x, y)) - exact;
                    squares += off.x * off.x + off.y * off.y + off.z * off.z;
                    sum += exact.x * exact.x + exact.y * exact.y + exact.z * exact.z;
                }
            }
        }
        errors.push_back(std::sqrt(squares / sum));
    }
    return errors;
}

}  // namespace

TEST_CASE("environment: equal radiance everywhere stays exactly that, on all levels and in the harmonics")
{
    for (const float number : {0.0f, 0.1f, 1.0f, 1234.5f, 1e30f, 1.6e38f, 1e-30f}) {
        const CubeMap radiance = cubeOf(9, [=](const Direction&, int) { return number; });
        const CubeMap map = prefiltered(radiance, {.side = 17, .samples = 64});
        CHECK(map.levelCount() == 3);
        int different = 0;
        for (int k = 0; k < map.levelCount(); ++k) {
            const int side = map.level(k).width();
            for (int i = 0; i < kCubeFaces * side * side; ++i)
                different += map.texel(k, i / (side * side), i % side, i / side % side).y != number ? 1 : 0;
        }
        measured("texels that differ", different, 0);
        const SphericalHarmonics sh = irradianceOf(radiance);
        const float light = ShadeSH9(sh, normalize(toLanes({1.0, -2.0, 0.5}))).x[0];
        CHECK(std::abs(light - number) <= 1e-6f * number);
    }
}

TEST_CASE("environment: levels are the integral of GGX, for smooth light")
{
    const CubeMap radiance = cubeOf(64, smooth);
    const CubeMap map = prefiltered(radiance, {.side = 32, .samples = 1024});
    CHECK(map.levelCount() == 4);
    for (int k = 0; k < map.levelCount(); ++k) {
        const auto roughness = static_cast<double>(roughnessOfLevel(k, map.levelCount()));
        const int side = map.level(k).width();
        Random random(3);
        double worst = 0.0;
        for (int i = 0; i < trials(60); ++i) {
            const int face = static_cast<int>(random.bits() % 6),
                      x = static_cast<int>(random.bits() % static_cast<unsigned>(side)),
                      y = static_cast<int>(random.bits() % static_cast<unsigned>(side));
            const Direction n = texelDirection(face, x, y, side);
            for (int c = 0; c < 3; ++c) {
                const double exact = k == 0 ? smooth(n, c) : reflected(smooth, c, n, roughness);
                worst = std::fmax(worst, std::abs(static_cast<double>(map.texel(k, face, x, y)[c]) - exact));
            }
        }
        measured("off the integral, of a range of 1", worst, 2e-3);
    }
}

TEST_CASE("environment: a small sun is a highlight and no specks, thanks to the levels of the radiance")
{
    const CubeMap radiance = cubeOf(32, sunny);
    // The same without coarser levels.
    std::vector<ImageFile> strip = {emptyPicture(192, 32)};
    for (int i = 0; i < kCubeFaces * 32 * 32; ++i) {
        const int face = i / 1024, x = i % 32, y = i / 32 % 32;
        const glm::vec4 texel = radiance.texel(0, face, x, y);
        std::copy_n(&texel[0], 4, &std::get<ImageFloat>(strip[0]).pixels[pixelIndex(face * 32 + x, 31 - y, 192)]);
    }
    const CubeMap finest = *CubeMap::fromLevels(strip, ColorSpace::linear);
    const auto with = errorsOf(prefiltered(radiance, {.side = 16, .samples = 64}), radiance);
    const auto without = errorsOf(prefiltered(finest, {.side = 16, .samples = 64}), radiance);
    const auto many = errorsOf(prefiltered(radiance, {.side = 16, .samples = 4096}), radiance);
    for (std::size_t k = 0; k < with.size(); ++k) {
        measured("error with 64 samples, RMS, relative", with[k], 0.3);
        measured("error with 4096 samples", many[k], 0.04);
        stability::noted("error with 64 samples of the finest level", without[k]);
        CHECK(without[k] > 2.0 * with[k]);
    }
}

TEST_CASE("environment: irradiance by harmonics is the integral over the cosine")
{
    // Everything up to the second band, and of the third, which the cosine has nothing of: the harmonics hold it all.
    const CubeMap map = cubeOf(32, [](const Direction& d, int c) {
        return smooth(d, c) + 0.2 * (d.x * d.x - d.y * d.y) - 0.1 * (c + 1) * d.z * d.z + 0.15 * d.x * d.y;
    });
    const SphericalHarmonics sh = irradianceOf(map);
    Random random(6);
    double worst = 0.0;
    for (int i = 0; i < trials(100); ++i) {
        const Direction n = randomDirection(random).unit();
        glm::dvec3 exact(0.0);
        forTexels(map, [&](const Direction& l, const glm::vec4& color, double angle) {
            exact += glm::dvec3(color) * (std::fmax(0.0, dot(n, l)) * angle / kPi);
        });
        const float3 light = ShadeSH9(sh, toLanes(n));
        for (int c = 0; c < 3; ++c) worst = std::fmax(worst, std::abs(static_cast<double>(light[c][0]) - exact[c]));
    }
    measured("off the integral, of a range of 1", worst, 5e-4);
}

TEST_CASE("environment: the same bits in any order and for any number of threads, and for every number of lanes")
{
    const CubeMap radiance = cubeOf(16, sunny);
    const PrefilterSettings settings = {.side = 20, .samples = 100};
    const ImageFloat inTurn = *prefilteredEnvironment(radiance, settings);
    const RunTasks backwards = [](int tasks, const std::function<void(int)>& function) {
        for (int task = tasks; task-- > 0;) function(task);
    };
    CHECK(prefilteredEnvironment(radiance, settings, backwards)->pixels == inTurn.pixels);
    for (const int threads : {1, 2, 3, 8}) {
        const RunTasks run = [threads](int tasks, const std::function<void(int)>& function) {
            Workers(threads).run(tasks, [&](int task, int) { function(task); });
        };
        CHECK(prefilteredEnvironment(radiance, settings, run)->pixels == inTurn.pixels);
    }
    // FNV-1a, as every build has it, of an environment without libm in it.
    const CubeMap noise = noiseCube(TexelFormat::rgba16, 24);
    std::uint64_t hash = 14695981039346656037u;
    const ImageFloat levels = *prefilteredEnvironment(noise, settings);
    for (const float number : levels.pixels) hash = (hash ^ std::bit_cast<std::uint32_t>(number)) * 1099511628211u;
    for (const Float& number : {irradianceOf(noise).A[0].x, irradianceOf(noise).B[1].z, irradianceOf(noise).C.z})
        hash = (hash ^ static_cast<std::uint32_t>(asInt(number)[0])) * 1099511628211u;
    CHECK(hash == 1827717496563591924u);
}

TEST_CASE("environment: levels and roughnesses are each other's inverse")
{
    for (const int levels : {2, 4, 6, 8}) {
        CHECK(roughnessOfLevel(0, levels) == 0.0f);
        CHECK(roughnessOfLevel(levels - 1, levels) == 1.0f);
        for (int k = 0; k < levels; ++k) {
            const Float level = levelOfRoughness(roughnessOfLevel(k, levels), levels);
            CHECK(std::abs(level[0] - static_cast<float>(k)) < 1e-5f);
        }
    }
    CHECK(levelOfRoughness(-1.0f, 6)[0] == 0.0f);
    CHECK(levelOfRoughness(7.0f, 6)[0] == 5.0f);
    CHECK(prefilteredLevelCount(8) == 2);
    CHECK(prefilteredLevelCount(128) == 6);
}

TEST_CASE("environment: cube maps that are made inside a block are made as anywhere, and count nothing")
{
    ImageFloat world{16, 8, std::vector<float>(16 * 8 * 4)};
    for (std::size_t i = 0; i < world.pixels.size(); ++i) world.pixels[i] = static_cast<float>(i * 7 % 31);
    const CubeMap map = *CubeMap::fromPicture(world, ColorSpace::linear);
    const ImageFloat levels = *prefilteredEnvironment(map, {.side = 8, .samples = 16});

    const Shading before = shading;
    shading = {};
    shading.activeLanes = 1;
    const CubeMap inside = *CubeMap::fromPicture(world, ColorSpace::linear);
    const ImageFloat levelsInside = *prefilteredEnvironment(inside, {.side = 8, .samples = 16});
    const std::uint64_t counted = shading.fetches.samples();
    const unsigned lanes = shading.activeLanes;
    shading = before;

    CHECK(counted == 0);
    CHECK(lanes == 1);
    for (int face = 0; face < kCubeFaces; ++face) CHECK(inside.texel(0, face, 1, 2) == map.texel(0, face, 1, 2));
    CHECK(levelsInside.pixels == levels.pixels);
}

TEST_CASE("environment: settings out of range are refused in a line")
{
    const auto error = [](const PrefilterSettings& settings) {
        return prefilteredEnvironment(CubeMap::white(), settings).error().message;
    };
    CHECK(error({.side = 7}) == "side: 7 is out of range; it must be in 8..2048");
    CHECK(error({.side = 2049}).find("8..2048") != std::string::npos);
    CHECK(error({.samples = 1}) == "samples: 1 is out of range; it must be in 2..65536");
    CHECK(error({.samples = 65537}).find("2..65536") != std::string::npos);
    CHECK(prefilteredEnvironment(CubeMap::white(), {.side = 8, .samples = 2}).has_value());
}
