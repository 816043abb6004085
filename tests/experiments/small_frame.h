// Small frames for experiments: a target and its frame in one place, drawn by one thread.
#pragma once

#include <memory>

#include "common/render.h"
#include "experiment.h"
#include "relief/pipeline/frame.h"

namespace relief::experiments {

struct SmallFrame
{
    Framebuffer target;
    Frame frame;

    SmallFrame(int width, int height, Format format = Format::rgba32f, const FrameOptions& options = {.threads = 1},
               int samples = 1)
        : target(std::move(*Framebuffer::create(width, height, format, Store::keep, samples))), frame(target, options)
    {
    }
};

inline std::shared_ptr<SmallFrame> smallFrame(int width, int height, Format format = Format::rgba32f,
                                              const FrameOptions& options = {.threads = 1}, int samples = 1)
{
    return std::make_shared<SmallFrame>(width, height, format, options, samples);
}

// Running a recorded frame, as work.
inline Work frameWork(const std::shared_ptr<SmallFrame>& f, double items)
{
    return {[f] { f->frame.run(); }, items};
}

// A square from -1 to 1 in clip space's x and y, at z = 0, of cells * cells quads; for draws that do not cull.
inline Mesh flatGrid(int cells)
{
    Mesh mesh;
    mesh.name = "grid";
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const auto coordinate = [cells](int i) {
                return static_cast<float>(2 * i - cells) / static_cast<float>(cells);
            };
            mesh.positions.push_back({coordinate(x), coordinate(y), 0.0f});
            mesh.normals.push_back({0.0f, 0.0f, -1.0f});
        }
    }
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (cells + 1) + x),
                       b = a + static_cast<std::uint32_t>(cells) + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    }
    return mesh;
}

}  // namespace relief::experiments
