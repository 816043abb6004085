#include "relief/trace/vertex_trace.h"

#include <algorithm>

#include "relief/lanes/environment.h"
#include "relief/pipeline/frame_storage.h"

namespace relief::inline RELIEF_WIDTH::trace {

Expected<VertexTrace> traceVertex(Frame& frame, int drawNumber, std::uint32_t vertex)
{
    Frame::Storage& storage = frame.internals();
    const auto count = static_cast<int>(storage.draws.size());
    if (drawNumber < 0 || drawNumber >= count) {
        return fail("there is no draw " + std::to_string(drawNumber) + " among " + std::to_string(count) +
                    ", the first one being 0");
    }
    const Draw& draw = storage.draws[static_cast<std::size_t>(drawNumber)];
    const DrawGeometry& g = draw.geometry;
    if (g.vertexCount == 0) {
        return fail("draw " + std::to_string(drawNumber) + " has nothing that can be seen; take another one");
    }
    if (vertex < g.firstVertex || vertex - g.firstVertex >= g.verticesPerInstance) {
        return fail("draw " + std::to_string(drawNumber) + " has the vertices " + std::to_string(g.firstVertex) +
                    " to " + std::to_string(g.firstVertex + g.verticesPerInstance - 1) + ", and not " +
                    std::to_string(vertex));
    }
    const DefaultFloatingPoint environment;
    storage.prepare();
    storage.shadeVertices();

    VertexTrace trace;
    trace.draw = drawNumber;
    trace.vertex = vertex;
    trace.mesh = draw.mesh;
    const std::uint32_t number = vertex - g.firstVertex, first = number & ~(static_cast<std::uint32_t>(kLanes) - 1);
    const auto lane = static_cast<int>(number - first);
    trace.lane = lane & 3;
    {
        Recorder recorder(lane);
        shadeVertices(draw, first, std::min(static_cast<std::uint32_t>(kLanes), g.vertexCount - first));
        if (!recorder.agrees)
            return fail("the trace of vertex " + std::to_string(vertex) +
                        " has a texture's sample that its texels do not make; this is a defect of "
                        "Relief, please report it");
        trace.events = std::move(recorder.events);
        trace.textures = std::move(recorder.textures);
    }
    for (int c = 0; c < 4; ++c) trace.clip[static_cast<std::size_t>(c)] = g.clip[number][c];
    const ScreenVertex& screen = g.screen[number];
    trace.position = {screen.x, screen.y};
    trace.depth = screen.z;
    trace.invW = screen.invW;
    static constexpr std::pair<unsigned, const char*> kSides[] = {
        {vertex_code::outsideLeft, "left"},     {vertex_code::outsideRight, "right"},
        {vertex_code::outsideBottom, "bottom"}, {vertex_code::outsideTop, "top"},
        {vertex_code::outsideNear, "near"},     {vertex_code::outsideFar, "far"},
        {vertex_code::nan, "not a number"},     {vertex_code::infinite, "infinite"}};
    for (const auto& [code, name] : kSides) {
        if ((g.codes[number] & code) != 0) trace.outside.emplace_back(name);
    }
    return trace;
}

}  // namespace relief::inline RELIEF_WIDTH::trace
