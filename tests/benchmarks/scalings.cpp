#include "scalings.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <sstream>

#include "child_process.h"
#include "many_lights.h"
#include "relief/pipeline/workers.h"
#include "scenes.h"

namespace relief::benchmarks {

namespace {

using samples::Size;

constexpr glm::vec4 kBackground{0.1f, 0.1f, 0.1f, 1.0f};
constexpr int kFrames = 9;
constexpr double kEnough = 1.0;  // seconds of frames after the first, for which no more are drawn

Expected<Recorded> recorded(std::unique_ptr<SceneData> data)
{
    if (!data->problem.empty()) return fail(data->problem);
    const std::shared_ptr<const SceneData> kept = std::move(data);
    return Recorded{kept, kept->texture ? &*kept->texture : nullptr};
}

// Of noise, made level by level: nothing but the levels is in memory.
Texture noiseTexture(int side)
{
    return *Texture::fromLevels(TexelFormat::rgba8, side, side, [side](int level, const MipLevel* finer) {
        if (level > 0) return coarserLevel(TexelFormat::rgba8, *finer);
        MipLevel finest(TexelFormat::rgba8, side, side);
        std::uint32_t noise = 1;
        for (int y = 0; y < side; ++y) {
            std::uint8_t* channel = finest.texel<std::uint8_t>(0, y);
            for (int x = 0; x < side; ++x) {
                noise = noise * 1664525u + 1013904223u;
                *channel++ = static_cast<std::uint8_t>(noise >> 24);
                *channel++ = static_cast<std::uint8_t>(noise >> 16);
                *channel++ = static_cast<std::uint8_t>(noise >> 20);
                *channel++ = 255;
            }
        }
        finest.fillFrame();
        return finest;
    });
}

void addPixels(std::vector<Point>& points)
{
    for (int side = 128; side <= 8192; side *= 2) {
        points.push_back(
            {"pixels", "stage 1.25", static_cast<double>(side) * side, {side, side}, 0, [](Frame& frame, Size s) {
                 return recorded(recordStage(frame, s.width, s.height, "1.25"));
             }});
    }
}

void addTriangles(std::vector<Point>& points, Size size)
{
    constexpr Size kCells[] = {{25, 20},   {50, 40},    {100, 50},    {200, 100},  {250, 200},
                               {500, 400}, {1000, 500}, {2000, 1000}, {2500, 2000}};
    for (const Size cells : kCells) {
        points.push_back(
            {"triangles", "height field", 2.0 * cells.width * cells.height, size, 0, [cells](Frame& frame, Size s) {
                 return recorded(recordTerrain(frame, s.width, s.height, cells.width, cells.height));
             }});
    }
}

// 1, 2, 4 ... and all.
void addThreads(std::vector<Point>& points, Size size)
{
    const int all = Workers().count();
    std::vector<int> counts;
    for (int threads = 1; threads < all; threads *= 2) counts.push_back(threads);
    counts.push_back(all);
    for (const BenchScene& scene : benchScenes()) {
        for (const int threads : counts) {
            points.push_back(
                {"threads", scene.name, static_cast<double>(threads), size, threads,
                 [&scene](Frame& frame, Size s) { return recorded(scene.record(frame, s.width, s.height)); }});
        }
    }
}

void addLights(std::vector<Point>& points, Size size)
{
    const std::pair<const char*, LightsBy> ways[] = {{"a pass for each light", LightsBy::passes},
                                                     {"a loop in one pass", LightsBy::loop},
                                                     {"a loop that skips", LightsBy::skippingLoop}};
    for (const auto& [name, by] : ways) {
        for (int lamps = 1; lamps <= 256; lamps *= 4) {
            points.push_back({"lights", name, static_cast<double>(lamps), size, 0,
                              [lamps, by = by](Frame& frame, Size s) -> Expected<Recorded> {
                                  return Recorded{recordManyLights(frame, s.width, s.height, lamps, by)};
                              }});
        }
    }
}

void addTextures(std::vector<Point>& points, Size size)
{
    for (const bool finestLevel : {false, true}) {
        for (int side = 64; side <= kMaxTextureSide; side *= 2) {
            points.push_back({"texture", finestLevel ? "finest level alone" : "mip levels", static_cast<double>(side),
                              size, 0, [side, finestLevel](Frame& frame, Size s) {
                                  return recorded(recordPlane(frame, s.width, s.height, noiseTexture(side),
                                                              {.finestLevel = finestLevel}));
                              }});
        }
    }
}

// A texture's x is a side, and its size goes with the square.
double amount(const Point& point)
{
    return point.scaling == "texture" ? point.x * point.x : point.x;
}

double seconds(Frame& frame, Statistics& statistics)
{
    const auto begin = std::chrono::steady_clock::now();
    statistics = frame.run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Numbers with spaces between them, as drawPoint() reads them.
Expected<std::string> drawnHere(const Point& point)
{
    Expected<Framebuffer> target = Framebuffer::create(point.size.width, point.size.height, Format::rgba8);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = point.threads});
    frame.clear(kBackground);
    const Expected<Recorded> scene = point.record(frame, point.size);
    if (!scene) return tl::unexpected(scene.error());
    Statistics statistics;
    const double first = seconds(frame, statistics);
    const int levels = scene->texture == nullptr ? 0 : scene->texture->levelsBuilt();
    std::ostringstream numbers;
    numbers.precision(17);
    numbers << first << ' ' << statistics.draws << ' ' << statistics.pixelsShaded << ' ' << levels;
    double sum = 0.0;
    for (int i = 0; i < kFrames && sum < kEnough; ++i) {
        const double time = seconds(frame, statistics);
        sum += time;
        numbers << ' ' << time;
    }
    return numbers.str();
}

}  // namespace

std::vector<Point> scalingPoints(Size size, double part)
{
    std::vector<Point> all;
    addPixels(all);
    addTriangles(all, size);
    addThreads(all, size);
    addLights(all, size);
    addTextures(all, size);
    std::map<std::string, double> largest;
    std::map<std::string, int> smaller;
    for (const Point& point : all) largest[point.scaling] = std::max(largest[point.scaling], amount(point));
    std::vector<Point> chosen;
    for (Point& point : all) {
        const bool isSmall = smaller[point.scaling + point.curve]++ < 2;
        if (isSmall || point.scaling == "threads" || amount(point) <= part * largest[point.scaling]) {
            chosen.push_back(std::move(point));
        }
    }
    return chosen;
}

Expected<Drawn> drawPoint(const Point& point)
{
    const Expected<ChildResult> child = inChild("report performance", [&] { return drawnHere(point); });
    if (!child) return tl::unexpected(child.error());
    Drawn drawn;
    drawn.peakMebibytes = child->peakMebibytes;
    std::istringstream numbers(child->text);
    numbers >> drawn.firstSeconds >> drawn.draws >> drawn.pixelsShaded >> drawn.levelsBuilt;
    for (double s = 0.0; numbers >> s;) drawn.seconds.push_back(s);
    return drawn;
}

}  // namespace relief::benchmarks
