// The life of one pixel: every triangle of a frame that covers it or just misses it, what became of each, and how the
// pixel's words came about. The frame runs as it always does, its triangles one by one in the pixel's tile, and every
// step is worked out a second time and compared with what the frame did: a trace that disagrees is an error.
//
// Nothing here depends on the lanes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relief/pipeline/frame.h"
#include "relief/trace/recorder.h"

namespace relief::inline RELIEF_WIDTH::trace {

struct InterpolatorTrace
{
    std::string semantic;  // "TEXCOORD0"
    Interpolation how;
    bool isInteger;
    std::array<std::array<std::uint32_t, 4>, 3> corners;  // words
    QuadValue here;
};

// One of the pixel's samples, and what the tests made of it.
struct SampleOutcome
{
    enum class Verdict
    {
        missed,  // not covered
        failsStencil,
        failsDepth,
        discarded,  // by the program, its coverage or alpha
        drawn
    };
    Verdict verdict = Verdict::missed;
    std::array<std::int64_t, 3> edges{};  // at the sample
    float depth = 0.0f, depthBefore = 0.0f, depthAfter = 0.0f;
    std::uint8_t stencilBefore = 0, stencilAfter = 0;
};

// A colour target of the pixel, and what the triangle made of it: linear before and after, and as words.
struct TargetOutcome
{
    int target = 0;
    Format format = Format::rgba8Srgb;
    std::array<float, 4> returned{};  // what the program gave, NaN and infinities replaced
    bool wasInvalid = false;          // and whether there were any
    struct Sample
    {
        std::array<float, 4> before{}, after{};
        std::array<std::uint32_t, 4> wordsBefore{}, wordsAfter{};
    };
    std::vector<Sample> samples;
};

// A triangle that covers the pixel, on its way through tests and programs.
struct FragmentTrace
{
    std::array<float, 3> linear{}, perspective{};  // weights of the corners
    float clipW = 0.0f;
    std::vector<SampleOutcome> samples;
    bool ran = false;  // the fragment program
    std::vector<InterpolatorTrace> interpolators;
    QuadValue color;  // target 0's, of the quad
    bool discarded = false;
    std::optional<float> depthOut;
    std::optional<std::uint32_t> coverageOut;
    std::vector<Event> events;
    std::vector<SampleTrace> textures;
    std::vector<TargetOutcome> targets;
};

struct EdgeTrace
{
    std::int64_t value;  // at the pixel's centre, in 1/65536 px^2: twice the area with the pixel
    bool isTopLeft;
    bool isInside;
};

// What goes into the tiles: a triangle, or a piece of one that was clipped, or of a line.
struct PieceTrace
{
    std::array<std::int32_t, 3> x{}, y{};  // 24.8 fixed point
    std::array<float, 3> z{}, invW{};
    std::int64_t doubledArea = 0;
    bool wasTurned = false;  // its corners were swapped to be clockwise
    std::array<EdgeTrace, 3> edges{};
    double distance = 0.0;  // of the pixel's centre, in pixels; 0 within
    std::optional<FragmentTrace> fragment;
};

struct PrimitiveTrace
{
    enum class Verdict
    {
        covers,
        misses,
        facesAway,  // or of no area
        hasNoSample,
        clippedAway
    };
    std::uint32_t number = 0, instance = 0;  // in the draw
    Verdict verdict = Verdict::misses;
    std::array<std::uint32_t, 3> vertices{};  // of the mesh
    std::vector<std::string> clippedBy;       // planes
    std::vector<PieceTrace> pieces;
};

struct DrawTrace
{
    int number = 0;
    std::string mesh;
    RenderState state;
    std::uint32_t primitiveCount = 0;
    bool isOutside = false;                  // its viewport or scissor does not have the pixel
    std::vector<PrimitiveTrace> primitives;  // that cover it, or miss it by less than a pixel
};

struct PixelTrace
{
    int x = 0, y = 0, width = 0, height = 0, sampleCount = 1;
    int tileX = 0, tileY = 0, tileSize = 0;
    std::array<std::optional<glm::vec4>, kMaxColors> cleared;
    std::vector<DrawTrace> draws;
    Format format = Format::rgba8Srgb;       // of target 0
    std::vector<std::uint32_t> storedWords;  // that the frame left in target 0
    std::array<std::uint8_t, 4> stored{};    // the same as bytes, of an 8-bit format
};

// Draws the frame's tile at pixel (x, y) once more, and listens; the target's other tiles stay as they are. Of a frame
// that does not clear all of its target the tile is drawn onto what is there: trace such a one before it has run. An
// error where there is no such pixel, or where the trace is not what the frame did.
Expected<PixelTrace> tracePixel(Frame& frame, int x, int y);

}  // namespace relief::inline RELIEF_WIDTH::trace
