// E-34: reflections by roughness level against integration.
#include <array>
#include <numbers>

#include "experiments.h"
#include "relief/shading/environment.h"

namespace relief::experiments {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kRoughnesses = {0.2, 0.4, 0.6, 0.8, 1.0};

// Blue above, brown below, a narrow horizon, and a sun of about 6 degrees that gives a sixth of all light.
double radiance(const glm::dvec3& d)
{
    const glm::dvec3 sun = {0.48, 0.6, 0.64};  // unit length
    const double sky = 0.75 + 0.45 * d.y + 0.3 * std::exp(-50.0 * d.y * d.y);
    return sky + 120.0 * std::exp(-400.0 * (1.0 - glm::dot(d, sun)));
}

using Faces = std::array<ImageFile, kCubeFaces>;

Faces radianceFaces(int side)
{
    Faces faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const CubeFaceAxes& axes = kCubeFaceAxes[f];
        ImageFloat face{side, side, {}};
        for (int i = 0; i < side * side; ++i) {
            const double s = (2.0 * (i % side) + 1.0) / side - 1.0, t = 1.0 - (2.0 * (i / side) + 1.0) / side;
            const glm::dvec3 d = glm::dvec3(axes.middle) + glm::dvec3(axes.right) * s + glm::dvec3(axes.up) * t;
            face.pixels.insert(face.pixels.end(), 3, static_cast<float>(radiance(glm::normalize(d))));
            face.pixels.push_back(1.0f);
        }
        faces[f] = std::move(face);
    }
    return faces;
}

CubeMap radianceCube(int side)
{
    return *CubeMap::fromFaces(radianceFaces(side), ColorSpace::linear);
}

const CubeMap& allLevels()
{
    static const CubeMap map = radianceCube(128);
    return map;
}

// The same without coarser levels.
const CubeMap& finestLevel()
{
    static const CubeMap map = [] {
        const CubeMap& all = allLevels();
        const int side = all.side();
        ImageFloat strip{kCubeFaces * side, side, {}};
        for (int y = side; y-- > 0;) {
            for (int x = 0; x < kCubeFaces * side; ++x) {
                const glm::vec4 texel = all.texel(0, x / side, x % side, y);
                strip.pixels.insert(strip.pixels.end(), &texel[0], &texel[0] + 4);
            }
        }
        return *CubeMap::fromLevels(std::array<ImageFile, 1>{std::move(strip)}, ColorSpace::linear);
    }();
    return map;
}

// What a surface of GGX reflects of the radiance in the mirror direction r, seen at so many degrees from its normal:
// the mean of the radiance with the weights D V n.l, V being Smith's joint visibility. Normals in rings as GGX spreads
// them, whose density is D n.h. At 0 degrees it is the integral that the levels are made for, but for V, which they
// leave out: `alone` does so, too.
double reflected(const glm::dvec3& r, double roughness, double degrees, bool alone = false)
{
    constexpr int kRings = 256, kTurns = 128;
    const double a2 = std::pow(roughness, 4.0);
    const glm::dvec3 side = glm::normalize(std::abs(r.y) < 0.9 ? glm::dvec3(r.z, 0, -r.x) : glm::dvec3(0, r.z, -r.y));
    const double angle = degrees * kRadians;
    const glm::dvec3 n = r * std::cos(angle) + side * std::sin(angle), v = 2.0 * glm::dot(n, r) * n - r;
    const glm::dvec3 x = glm::normalize(std::abs(n.y) < 0.9 ? glm::dvec3(n.z, 0, -n.x) : glm::dvec3(0, n.z, -n.y));
    const glm::dvec3 y = glm::cross(n, x);
    const double NdotV = glm::dot(n, v);
    double sum = 0.0, weights = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double w = (ring + 0.5) / kRings, u = w * w * (3.0 - 2.0 * w), q = 1.0 + (a2 - 1.0) * u;
        const double cosine = std::sqrt((1.0 - u) / q), sine = std::sqrt(a2 * u / q);
        for (int i = 0; i < kTurns; ++i) {
            const double turn = 2.0 * kPi * (i + 0.5) / kTurns;
            const glm::dvec3 h = (x * std::cos(turn) + y * std::sin(turn)) * sine + n * cosine;
            const double VdotH = glm::dot(v, h);
            const glm::dvec3 l = 2.0 * VdotH * h - v;
            const double NdotL = glm::dot(n, l);
            if (NdotL <= 0.0 || VdotH <= 0.0) continue;
            const double smith =
                NdotL * std::sqrt(NdotV * NdotV * (1.0 - a2) + a2) + NdotV * std::sqrt(NdotL * NdotL * (1.0 - a2) + a2);
            // 4 v.h / n.h: from h to l; w (1 - w): rings lie closer at both ends.
            const double weight = w * (1.0 - w) * NdotL * VdotH / cosine / (alone ? 1.0 : smith);
            sum += weight * radiance(l);
            weights += weight;
        }
    }
    return sum / weights;
}

// Directions, and what is reflected there for each roughness.
struct Points
{
    struct Point
    {
        glm::dvec3 direction;
        std::array<double, kRoughnesses.size()> above, tilted;  // seen from straight above, and at 60 degrees
    };
    std::vector<Point> all;

    explicit Points(int count)
    {
        std::mt19937 random(34);
        for (int i = 0; i < count; ++i) {
            const double y = 2.0 * (i + 0.5) / count - 1.0, turn = 2.0 * kPi * uniform(random),
                         across = std::sqrt(1.0 - y * y);
            Point p{{across * std::cos(turn), y, across * std::sin(turn)}, {}, {}};
            for (std::size_t k = 0; k < kRoughnesses.size(); ++k) {
                p.above[k] = reflected(p.direction, kRoughnesses[k], 0.0, true);
                p.tilted[k] = reflected(p.direction, kRoughnesses[k], 60.0);
            }
            all.push_back(p);
        }
    }
};

const Points& points(Effort effort)
{
    if (effort.full) {
        static const Points full(400);
        return full;
    }
    static const Points few(12);
    return few;
}

double lookUp(const CubeMap& map, int levels, const glm::dvec3& d, double roughness)
{
    const samplerCUBE s = {.texture = &map};
    const Float level = levelOfRoughness(static_cast<float>(roughness), levels);
    return static_cast<double>(texCUBElod(s, float4(float3(broadcast(glm::vec3(d))), level)).x[0]);
}

Outcome outcomeOf(const CubeMap& map, int levels, const Points& exact)
{
    ErrorSum all, tilted, each[kRoughnesses.size()];
    for (const Points::Point& p : exact.all) {
        for (std::size_t k = 0; k < kRoughnesses.size(); ++k) {
            const double value = lookUp(map, levels, p.direction, kRoughnesses[k]);
            all.add(value - p.above[k]);
            each[k].add(value - p.above[k]);
            tilted.add(value - p.tilted[k]);
        }
    }
    Outcome outcome(all.result());
    for (std::size_t k = 0; k < kRoughnesses.size(); ++k)
        outcome.facts.push_back({"RMS at roughness " + number(kRoughnesses[k], 1), each[k].result().rms});
    outcome.facts.push_back({"RMS seen at 60 degrees", tilted.result().rms});
    return outcome;
}

CubeMap prefiltered(const CubeMap& from, int side, int samples)
{
    return *CubeMap::fromPicture(*prefilteredEnvironment(from, {.side = side, .samples = samples}), ColorSpace::linear);
}

int texelCount(int side)
{
    int count = 0;
    const int levels = prefilteredLevelCount(side);
    for (int k = 0; k < levels; ++k, side /= 2) count += kCubeFaces * side * side;
    return count;
}

// By a script without the engine, which integrates over longitude and latitude.
struct Reference
{
    glm::dvec3 direction;
    double roughness, above, tilted;
};
const Reference kReferences[] = {
    {{0.48, 0.6, 0.64}, 0.2, 44.5405, 57.2668}, {{0.48, 0.6, 0.64}, 0.4, 7.20439, 11.0719},
    {{0.48, 0.6, 0.64}, 0.7, 2.16315, 2.27046}, {{0.48, 0.6, 0.64}, 1, 1.56671, 1.20612},
    {{0.6, 0.8, 0}, 0.2, 1.12006, 1.10631},     {{0.6, 0.8, 0}, 0.4, 1.26708, 1.08014},
    {{0.6, 0.8, 0}, 0.7, 1.53128, 0.992847},    {{0.6, 0.8, 0}, 1, 1.47849, 0.901034},
    {{0, -0.6, 0.8}, 0.2, 0.484454, 0.484656},  {{0, -0.6, 0.8}, 0.4, 0.516907, 0.531859},
    {{0, -0.6, 0.8}, 0.7, 0.609405, 0.768815},  {{0, -0.6, 0.8}, 1, 0.699196, 1.03877},
};

}  // namespace

Experiment environments(Effort effort)
{
    Experiment e;
    e.id = "E-34";
    e.title = "Reflections by roughness level";
    e.question =
        "A rough surface reflects a mean of the light from all around; a cube map has it ready, a level for each "
        "roughness, and a shader looks it up once. How far is the look-up from the integral, between levels too, and "
        "how "
        "many directions for a texel does it take? A direction looks at that level of the surroundings whose texels "
        "cover as much as it stands for, or at the finest. Beside them stand the levels that every cube map has, plain "
        "averages. The surroundings are a sky and a sun of about 6 degrees, 128 texels a face, and so has level 0; the "
        "last has "
        "4. Times are of levels of 32 to 4. The integral is GGX seen from straight above, which is what levels are "
        "made for; the last column compares "
        "with the integral of the whole model seen at 60 degrees.";
    e.item = "texel of the levels";
    e.unit = "radiance, whose mean is about 1";
    const int side = effort.samples(128, 16), timedSide = effort.samples(32, 8), levels = prefilteredLevelCount(side);
    struct Source
    {
        const char* name;
        const CubeMap& (*map)();
    };
    for (const Source& source : {Source{"matching level", allLevels}, {"finest level", finestLevel}}) {
        for (const int samples : {16, 64, 256, 1024}) {
            e.variants.push_back(
                {source.name,
                 std::to_string(samples) + " directions",
                 [=] { return outcomeOf(prefiltered(source.map(), side, samples), levels, points(effort)); },
                 {[=] { (void)prefilteredEnvironment(source.map(), {.side = timedSide, .samples = samples}); },
                  static_cast<double>(texelCount(timedSide))}});
        }
    }
    e.variants.push_back({"averages",
                          "",
                          [=] { return outcomeOf(radianceCube(side), levels, points(effort)); },
                          {[faces = radianceFaces(timedSide)] { (void)CubeMap::fromFaces(faces, ColorSpace::linear); },
                           static_cast<double>(texelCount(timedSide))}});

    for (const Reference& r : kReferences) {
        const std::string at = "at roughness " + number(r.roughness, 1) + " along (" + number(r.direction.x, 2) + ", " +
                               number(r.direction.y, 2) + ", " + number(r.direction.z, 2) + ")";
        e.checks.push_back({"the integral from above " + at, r.above,
                            [=] { return reflected(r.direction, r.roughness, 0.0, true); }, 2e-3 * r.above});
        e.checks.push_back({"the integral at 60 degrees " + at, r.tilted,
                            [=] { return reflected(r.direction, r.roughness, 60.0); }, 2e-3 * r.tilted});
    }
    e.finding = [](const Rows& rows) {
        const auto rms = [&](const char* name, const char* samples) {
            return number(rows(name, samples).outcome.error.rms, 4);
        };
        const Row &few = rows("matching level", "64 directions"), &many = rows("matching level", "1024 directions"),
                  &averages = rows("averages");
        const auto fact = [](const Row& row, const char* name) { return number(row.fact(name), 4); };
        return "With 1024 directions a look-up is " + rms("matching level", "1024 directions") +
               " off, with 16, 64 and 256 it is " + rms("matching level", "16 directions") + ", " +
               rms("matching level", "64 directions") + " and " + rms("matching level", "256 directions") +
               "; from the finest level alone " + rms("finest level", "16 directions") + ", " +
               rms("finest level", "64 directions") + " and " + rms("finest level", "256 directions") +
               ": a small sun needs the other levels. At roughness 0.2 a look-up mixes two levels, and more directions "
               "do not "
               "help: " +
               fact(few, "RMS at roughness 0.2") + " with 64, " + fact(many, "RMS at roughness 0.2") +
               " with 1024; at 1 it is " + fact(few, "RMS at roughness 1.0") + " and " +
               fact(many, "RMS at roughness 1.0") + ". Plain averages are " + number(averages.outcome.error.rms, 4) +
               " off. Seen at 60 degrees even 1024 directions miss " + fact(many, "RMS seen at 60 degrees") +
               ": that is what one level for all viewers costs. A texel takes " + number(few.fastest / 1000.0, 2) +
               " us with 64 directions and " + number(many.fastest / 1000.0, 2) + " with 1024.";
    };
    return e;
}

}  // namespace relief::experiments
