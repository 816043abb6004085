// What the front end of the pipeline passes on: from shaded vertices (clip space and screen) to triangles that are
// ready to be binned.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec4.hpp>

#include "relief/hlsl/semantics.h"
#include "relief/pipeline/limits.h"
#include "relief/pipeline/render_state.h"

namespace relief::inline RELIEF_WIDTH {

// An array that is grown but never filled: what a frame writes before it reads, and the next frame reuses.
template <class T>
class Scratch
{
public:
    T* reserve(std::size_t count)
    {
        if (count > capacity) {
            data.reset(new T[count]);  // not set to 0
            capacity = count;
        }
        return data.get();
    }

private:
    std::unique_ptr<T[]> data;
    std::size_t capacity = 0;
};

// Pixels [x0, x1) x [y0, y1).
struct Rectangle
{
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

inline Rectangle intersect(const Rectangle& a, const Rectangle& b)
{
    return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1, a.y1 < b.y1 ? a.y1 : b.y1};
}

// Where normalised device coordinates land: pixels; depth 0 ... 1 is not remapped.
struct Viewport
{
    int x = 0, y = 0, width = 0, height = 0;
};

// A vertex after clip space, division and viewport. Meaningless where its codes say that the triangle must be clipped.
struct ScreenVertex
{
    std::int32_t x, y;  // 24.8 fixed point
    float z;            // 0 ... 1, and beyond where depth is not clipped
    float invW;         // 1 / clip-space w
};

// On which side of what a clip-space position lies. A triangle with one `outside` bit in all three codes is invisible;
// one with a `mustClip` bit in any code has to be clipped.
namespace vertex_code {
enum : std::uint16_t
{
    outsideLeft = 1,
    outsideRight = 2,
    outsideBottom = 4,
    outsideTop = 8,
    outsideNear = 16,
    outsideFar = 32,
    anyOutside = 63,
    beyondGuardBand = 64,
    smallW = 128,
    beyondOwnPlane = 1024,  // a negative SV_ClipDistance
    mustClip = outsideNear | outsideFar | beyondGuardBand | smallW | beyondOwnPlane,
    nan = 256,
    infinite = 512,
};
}

// One draw's vertices and the state that the front end needs. The vertices of all instances stand one instance after
// the other, and so do the primitives.
struct DrawGeometry
{
    const std::uint32_t* indices = nullptr;  // three a triangle, two a line; of one instance
    std::uint32_t primitiveCount = 0;        // of all instances
    std::uint32_t vertexCount = 0;           // of all instances
    std::uint32_t primitivesPerInstance = 0;
    std::uint32_t verticesPerInstance = 0;
    std::uint32_t firstVertex = 0;  // the mesh's vertex that an instance begins with

    std::uint32_t componentCount = 0;                             // words to interpolate per vertex
    std::uint32_t componentStride = 0;                            // and from one vertex to the next: a multiple of four
    const Interpolation* interpolations = nullptr;                // componentCount of them
    bool hasFlat = false, hasCentroid = false;                    // any of them
    std::array<std::uint8_t, kMaxClipDistances> clipDistances{};  // which components are SV_ClipDistance
    int clipDistanceCount = 0;

    glm::vec4* clip = nullptr;       // per vertex
    ScreenVertex* screen = nullptr;  // per vertex
    std::uint16_t* codes = nullptr;  // per vertex
    float* components = nullptr;     // componentStride per vertex

    Viewport viewport;
    Rectangle bounds;  // viewport, scissor and target: no pixel outside is touched
    Primitive primitive = Primitive::triangles;
    int lineWidth = 1;  // pixels
    Cull cull = Cull::back;
    bool frontCounterClockwise = false;
    bool depthClip = true;
    int sampleReach = 0;  // of the target's samples from a pixel's centre
    std::uint32_t drawIndex = 0;
};

// A triangle ready for rasterisation: clockwise on screen, area > 0. One cache line.
struct alignas(64) Triangle
{
    std::int32_t x[3], y[3];  // 24.8 fixed point
    float z[3];
    float invW[3];
    std::uint32_t vertex[3];  // see componentsOf()
    std::uint32_t drawWord;   // the draw's index, and kWasCounterClockwise

    std::uint32_t drawIndex() const { return drawWord & 0x7fffffffu; }
};

// Of a triangle whose corners were swapped to be clockwise.
inline constexpr std::uint32_t kWasCounterClockwise = 0x80000000u;

inline constexpr std::uint32_t kClippedVertex = 0x80000000u;

// The front end's output for one run of consecutive triangles: the triangles that survived, and which tiles they touch.
struct TriangleChunk
{
    struct BinEntry
    {
        std::uint32_t tile;
        std::uint32_t triangle;
    };

    std::vector<Triangle> triangles;
    std::vector<float> clippedComponents;  // of vertices that clipping made
    std::vector<BinEntry> entries;         // in submission order
    std::vector<std::uint32_t> binStart;   // tile t's triangles are sorted[binStart[t]] ... sorted[binStart[t + 1] - 1]
    std::vector<std::uint32_t> sorted;     // indices into `triangles`, by tile, then in submission order

    void clear()
    {
        triangles.clear();
        clippedComponents.clear();
        entries.clear();
    }
};

// The interpolated components of a triangle's corner: of an original vertex, or of one that clipping made.
inline const float* componentsOf(const DrawGeometry& draw, const TriangleChunk& chunk, std::uint32_t vertex)
{
    if ((vertex & kClippedVertex) != 0) return chunk.clippedComponents.data() + (vertex & ~kClippedVertex);
    return draw.components + static_cast<std::size_t>(vertex) * draw.componentStride;
}

// Whether a triangle is seen from its front, as a line always is.
inline bool isFront(const DrawGeometry& draw, const Triangle& triangle)
{
    const bool counterClockwise = (triangle.drawWord & kWasCounterClockwise) != 0;
    return draw.primitive == Primitive::lines || counterClockwise == draw.frontCounterClockwise;
}

// The vertices that primitives first ... first + count - 1 are made of, `corners` each: the mesh's own indices, or, for
// instances and parts of a mesh, `room` filled with numbers in the draw's arrays (kNoVertex where there is none).
inline constexpr std::uint32_t kNoVertex = 0xffffffffu;

inline const std::uint32_t* cornersOf(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count,
                                      std::uint32_t corners, std::uint32_t* room)
{
    if (draw.verticesPerInstance == draw.vertexCount && draw.firstVertex == 0)
        return draw.indices + static_cast<std::size_t>(first) * corners;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t instance = (first + i) / draw.primitivesPerInstance;
        const std::size_t primitive = (first + i) % draw.primitivesPerInstance;
        for (std::uint32_t k = 0; k < corners; ++k) {
            const std::uint32_t vertex = draw.indices[primitive * corners + k] - draw.firstVertex;
            room[i * corners + k] =
                vertex < draw.verticesPerInstance ? instance * draw.verticesPerInstance + vertex : kNoVertex;
        }
    }
    return room;
}

}  // namespace relief::inline RELIEF_WIDTH
