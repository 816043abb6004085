// Prefiltering by importance sampling: the directions of a level are the same for all its texels, so they are worked
// out once, around +z, and turned to each texel's own direction.
#include "relief/shading/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"
#include "relief/memory.h"
#include "relief/texture/shading_scope.h"

namespace relief {
namespace {

constexpr double kPi = 3.14159265358979324;

// The bits of i the other way round, as a fraction: with i / n the points of a square, evenly spread (Hammersley).
double radicalInverse(std::uint32_t i)
{
    double fraction = 0.0;
    for (double digit = 0.5; i != 0; i >>= 1, digit *= 0.5) fraction += (i & 1) != 0 ? digit : 0.0;
    return fraction;
}

// A direction around +z that radiance is looked up in.
struct Sample
{
    float x, y, z;
    float level;  // of the radiance
    float share;  // of the running mean up to here: weight / sum of the weights so far
};

// Of GGX with v = n: with u evenly spread in 0..1 and q = 1 + (a^2 - 1) u, cos^2 of h is (1 - u) / q (Walter et al.
// 2007), D is q^2 / (pi a^2), and the density of l is D / 4. The sample stands for 1 / (n density) of the sphere. The
// level is that whose texels cover as much, a sixth of the sphere having side^2 texels of level 0. A half of u is at
// the horizon of the roughest level: one sample would be none.
std::vector<Sample> samplesOf(float perceptualRoughness, int count, int radianceSide)
{
    if (perceptualRoughness == 0.0f) return {};
    const double a = static_cast<double>(perceptualRoughness) * static_cast<double>(perceptualRoughness), a2 = a * a;
    const double texel = 4.0 * kPi / (6.0 * radianceSide * radianceSide);
    std::vector<Sample> samples;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, q = 1.0 + (a2 - 1.0) * u;
        const double cosine2 = (1.0 - u) / q, sine2 = a2 * u / q;
        const double z = cosine2 - sine2, across = 2.0 * std::sqrt(cosine2 * sine2);  // of twice the angle
        if (z <= 0.0) continue;
        const auto turn = static_cast<float>(2.0 * kPi * radicalInverse(static_cast<std::uint32_t>(i)));
        const double angle = 4.0 * kPi * a2 / (q * q * count);
        sum += z;
        samples.push_back({static_cast<float>(across * static_cast<double>(cos(turn))),
                           static_cast<float>(across * static_cast<double>(sin(turn))), static_cast<float>(z),
                           0.5f * log2(static_cast<float>(angle / texel)), static_cast<float>(z / sum)});
    }
    return samples;
}

// The mean of the radiance around n, a running one: equal samples give exactly themselves.
float4 meanAround(const samplerCUBE& radiance, const float3& n, const std::vector<Sample>& samples)
{
    // Two axes across n: the horizontal one, which only the poles do not have, and the cross product.
    const float3 horizontal = {n.z, Float(0.0f), -n.x};
    const Mask isPole = (n.x == 0.0f) & (n.z == 0.0f);
    const float3 x = normalize(select(isPole, float3(1.0f, 0.0f, 0.0f), horizontal)), y = cross(n, x);
    float4 mean(0.0f);
    for (const Sample& s : samples) {
        const float4 color = texCUBElod(radiance, float4(x * s.x + y * s.y + n * s.z, Float(s.level)));
        mean = mean + (color - mean) * s.share;
    }
    return mean;
}

struct Level
{
    int side, firstRow;  // in the picture
    std::vector<Sample> samples;
};

// A row of all six faces of a level.
void prefilterRow(const CubeMap& radiance, const Level& level, int row, ImageFloat& picture)
{
    const ShadingScope scope;
    const DefaultFloatingPoint environment;
    const samplerCUBE s = {.texture = &radiance};
    const auto side = static_cast<float>(level.side);
    const float mirrorLevel = log2(static_cast<float>(radiance.side()) / side);
    const float t = 1.0f - (2.0f * static_cast<float>(row) + 1.0f) / side;  // rows go down from the top
    float lanes[kLanes];
    for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<float>(2 * i + 1);
    const Float odd = Float::load(lanes);
    for (int face = 0; face < kCubeFaces; ++face) {
        for (int column = 0; column < level.side; column += kLanes) {
            const float3 direction = cubeDirection(face, (odd + static_cast<float>(2 * column)) / side - 1.0f, t);
            const float4 color = level.samples.empty() ? texCUBElod(s, float4(direction, Float(mirrorLevel)))
                                                       : meanAround(s, normalize(direction), level.samples);
            const auto at = static_cast<std::size_t>(level.firstRow + row) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(face * level.side + column);
            for (int i = 0; i < std::min(kLanes, level.side - column); ++i) {
                for (int c = 0; c < 3; ++c)
                    picture.pixels[(at + static_cast<std::size_t>(i)) * 4 + static_cast<std::size_t>(c)] = color[c][i];
            }
        }
    }
}

}  // namespace

int prefilteredLevelCount(int side)
{
    int count = 1;
    for (; side >= 8; side /= 2) ++count;
    return count;
}

float roughnessOfLevel(int k, int levels)
{
    if (levels < 2) return 0.0f;
    const double level = static_cast<double>(k) / (levels - 1);
    return static_cast<float>((1.7 - std::sqrt(1.7 * 1.7 - 4.0 * 0.7 * level)) / 1.4);
}

void runInTurn(int tasks, const std::function<void(int task)>& function)
{
    for (int task = 0; task < tasks; ++task) function(task);
}

Expected<ImageFloat> prefilteredEnvironment(const CubeMap& radiance, const PrefilterSettings& settings,
                                            const RunTasks& run)
{
    const DefaultFloatingPoint environment;
    const auto outside = [](const char* what, int number, int least, int most) {
        return fail(what + (": " + std::to_string(number)) + " is out of range; it must be in " +
                    std::to_string(least) + ".." + std::to_string(most));
    };
    if (settings.side < kLeastPrefilteredSide || settings.side > kMaxPrefilteredSide)
        return outside("side", settings.side, kLeastPrefilteredSide, kMaxPrefilteredSide);
    if (settings.samples < kLeastPrefilterSamples || settings.samples > kMaxPrefilterSamples)
        return outside("samples", settings.samples, kLeastPrefilterSamples, kMaxPrefilterSamples);

    std::vector<Level> levels;
    int rows = 0;
    const int count = prefilteredLevelCount(settings.side);
    for (int k = 0, side = settings.side; k < count; ++k, side /= 2) {
        levels.push_back({side, rows, samplesOf(roughnessOfLevel(k, count), settings.samples, radiance.side())});
        rows += side;
    }
    const int width = kCubeFaces * settings.side;
    const auto numbers = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) * 4;
    if (!fitsInMemory(numbers * sizeof(float))) {
        return fail("side: levels from " + std::to_string(settings.side) +
                    " texels do not fit into memory; make it smaller");
    }
    ImageFloat picture{width, rows, std::vector<float>(numbers)};
    for (std::size_t i = 3; i < numbers; i += 4) picture.pixels[i] = 1.0f;
    run(rows, [&](int task) {
        const auto after = [task](const Level& level) { return task < level.firstRow; };
        const Level& level = *std::prev(std::find_if(levels.begin(), levels.end(), after));
        prefilterRow(radiance, level, task - level.firstRow, picture);
    });
    return picture;
}

bool isPrefiltered(const CubeMap& map)
{
    return map.levelCount() < mipLevelCount(map.side(), map.side());
}

SphericalHarmonics irradianceOf(const CubeMap& radiance)
{
    const DefaultFloatingPoint environment;
    const int side = radiance.side();
    double weights = 0.0, moments[3][9] = {};
    for (int face = 0; face < kCubeFaces; ++face) {
        const CubeFaceAxes& axes = kCubeFaceAxes[static_cast<std::size_t>(face)];
        for (int i = 0; i < side * side; ++i) {
            const double s = (2.0 * (i % side) + 1.0) / side - 1.0, t = (2.0 * (i / side) + 1.0) / side - 1.0;
            const double square = 1.0 + s * s + t * t, length = std::sqrt(square);
            double d[3];
            for (int axis = 0; axis < 3; ++axis)
                d[axis] = (axes.middle[axis] + axes.right[axis] * s + axes.up[axis] * t) / length;
            const double weight = 1.0 / (square * length);  // of the solid angle: cosine / distance^2
            weights += weight;
            const double basis[9] = {
                1.0, d[0], d[1], d[2], d[0] * d[1], d[1] * d[2], d[2] * d[2], d[2] * d[0], d[0] * d[0] - d[1] * d[1]};
            const glm::vec4 color = radiance.texel(0, face, i % side, i / side);
            for (int c = 0; c < 3; ++c) {
                for (int k = 0; k < 9; ++k) moments[c][k] += weight * basis[k] * static_cast<double>(color[c]);
            }
        }
    }

    // The means over the sphere times (2 l + 1), the square of the basis' norm, and times what the cosine leaves of
    // band l: 1, 2/3 and 1/4. Band 2 has five functions: 15 xy, 15 yz, 15 zx, 5/4 (3 z^2 - 1) and 15/4 (x^2 - y^2).
    SphericalHarmonics sh;
    for (int c = 0; c < 3; ++c) {
        const auto mean = [&](int k) { return moments[c][k] / weights; };
        const auto number = [](double x) {
            constexpr double largest = std::numeric_limits<float>::max();
            return Float(static_cast<float>(std::clamp(x, -largest, largest)));
        };
        const double zonal = 0.25 * 5.0 / 4.0 * (3.0 * mean(6) - mean(0));
        sh.A[c] = {number(2.0 * mean(1)), number(2.0 * mean(2)), number(2.0 * mean(3)), number(mean(0) - zonal)};
        sh.B[c] = {number(15.0 / 4.0 * mean(4)), number(15.0 / 4.0 * mean(5)), number(3.0 * zonal),
                   number(15.0 / 4.0 * mean(7))};
        sh.C[c] = number(15.0 / 16.0 * mean(8));
    }
    return sh;
}

}  // namespace relief
