// E-27: tiles of 16 to 128 pixels.
#include "experiments.h"
#include "triangle_scene.h"

namespace relief::experiments {

namespace {

constexpr int kTileSizes[] = {16, 32, 64, 128};
constexpr int kTriangleSizes[] = {4, 32, 256};  // pixels

std::shared_ptr<const TriangleScene> sceneOf(int size)
{
    return std::make_shared<const TriangleScene>(size == 4 ? 10000 : size == 32 ? 1500 : 40, size);
}

std::uint64_t hashOfFrame(const TriangleScene& triangles, const FrameOptions& options)
{
    const auto f = framed(triangles, options, false);
    f->frame.run();
    return hashOf(f->target);
}

}  // namespace

Experiment tileSizes(Effort)
{
    Experiment e;
    e.id = "E-27";
    e.title = "Tile sizes";
    e.question =
        "The engine draws a picture tile by tile. Small tiles stay in the cache and share out well between threads; "
        "but a triangle is taken up once for every tile that it touches. Which size is fastest for small, middling "
        "and large triangles? The error is by how many triangles a pixel's count differs from exact coverage, pixel "
        "by pixel: it has to be 0. (Tiles of 8 pixels the engine does not have.)";
    e.item = "pixel";
    e.unit = "triangles over a pixel";
    e.rivals = Rivals::ofOneParameter;
    for (const int size : kTriangleSizes) {
        const auto triangles = sceneOf(size);
        for (const int tile : kTileSizes) {
            const FrameOptions options = {.threads = 1, .tileSize = tile};
            const auto f = framed(*triangles, options, false);
            const Statistics s = f->frame.run();
            const auto outcome = [=] {
                Outcome result(coverageError(*triangles, options),
                               {{"triangle and tile pairs", static_cast<double>(s.trianglesBinned)},
                                {"tiles", static_cast<double>(s.tiles)},
                                {"pixels shaded", static_cast<double>(s.pixelsShaded)}});
                result.imageHash = hashOfFrame(*triangles, options);
                return result;
            };
            Work work = frameWork(f, static_cast<double>(s.pixelsShaded));
            work.run = [run = work.run, triangles] { run(); };  // keeps the mesh
            e.variants.push_back(
                {"tiles of " + std::to_string(tile), "triangles of " + std::to_string(size), outcome, work});
            e.checks.push_back({"coverage, tiles of " + std::to_string(tile) + ", triangles of " + std::to_string(size),
                                0.0, [=] { return coverageError(*triangles, options).max; }, 0.0});
            e.checks.push_back({"as with tiles of 64, every bit, tiles of " + std::to_string(tile) + ", triangles of " +
                                    std::to_string(size),
                                1.0,
                                [=] {
                                    return hashOfFrame(*triangles, options) == hashOfFrame(*triangles, {.threads = 1})
                                               ? 1.0
                                               : 0.0;
                                },
                                0.0});
        }
    }
    e.finding = [](const Rows& rows) {
        std::string text = "No pixel differs, whatever the size.";
        for (const int size : kTriangleSizes) {
            const std::string parameter = "triangles of " + std::to_string(size);
            const Row* best = nullptr;
            for (const Row& row : rows.all) {
                if (row.parameter == parameter && (!best || row.fastest < best->fastest)) best = &row;
            }
            const Row &small = rows("tiles of 16", parameter), &usual = rows("tiles of 64", parameter);
            text += " For " + parameter + " pixels, " + best->name + " are the fastest (" + number(best->fastest, 2) +
                    " ns a pixel; of 64, the engine's default, " + number(usual.fastest, 2) + "; of 16, with " +
                    number(small.fact("triangle and tile pairs") / usual.fact("triangle and tile pairs"), 1) +
                    " times as many pairs of triangle and tile, " + number(small.fastest, 2) + ").";
        }
        return text;
    };
    return e;
}

}  // namespace relief::experiments
