// What a traced vertex program makes of one vertex.
#pragma once

#include "relief/pipeline/frame.h"
#include "relief/trace/recorder.h"

namespace relief::inline RELIEF_WIDTH::trace {

struct VertexTrace
{
    int draw = 0;
    std::uint32_t vertex = 0;  // of the mesh
    int lane = 0;              // of the four that the events have
    std::string mesh;
    std::vector<Event> events;
    std::vector<SampleTrace> textures;
    std::array<float, 4> clip{};             // SV_POSITION
    std::array<std::int32_t, 2> position{};  // on the screen, 24.8 fixed point; where it has one
    float depth = 0.0f, invW = 0.0f;
    std::vector<std::string> outside;  // planes that it lies beyond
};

// Of the draw's first instance. An error where there is no such draw, or no such vertex in it.
Expected<VertexTrace> traceVertex(Frame& frame, int draw, std::uint32_t vertex);

}  // namespace relief::inline RELIEF_WIDTH::trace
