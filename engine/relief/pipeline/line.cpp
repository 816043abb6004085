#include "relief/pipeline/line.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "relief/pipeline/clip.h"
#include "relief/pipeline/edge_function.h"
#include "relief/pipeline/viewport_transform.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// An end of a line on screen, and the vertex whose components it has.
struct End
{
    ScreenVertex screen;
    std::uint32_t vertex;
};

// What clipping made of one end. Its components, if it is a new vertex, are a mix of the two original ones.
End clippedEnd(const DrawGeometry& draw, const std::uint32_t vertex[2], const ClipVertex& clipped, TriangleChunk& chunk)
{
    const float(&w)[3] = clipped.weight;
    const int corner = w[0] == 1.0f ? 0 : w[1] == 1.0f ? 1 : -1;
    End end{};
    end.vertex = corner >= 0 ? vertex[corner] : clippedVertex(draw, {vertex[0], vertex[1], vertex[1]}, clipped, chunk);
    float4 position;
    for (int c = 0; c < 4; ++c) position[c] = clipped.position[c];
    const ScreenLanes screen = ViewportTransform(draw.viewport).project(position);
    end.screen = {screen.x[0], screen.y[0], screen.z[0], screen.invW[0]};
    return end;
}

// One half of the parallelogram: corners are ends of the line, moved along the minor axis by `side` half widths.
struct Corner
{
    const End* end;
    int side;
};

bool append(const DrawGeometry& draw, std::array<Corner, 3> corners, const End& first, bool xMajor,
            TriangleChunk& chunk)
{
    // What is not interpolated is that of the line's first end.
    while (draw.hasFlat && corners[0].end != &first) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    const std::int32_t half = draw.lineWidth * kSubpixels / 2;
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
        const ScreenVertex& s = corners[k].end->screen;
        t.x[k] = s.x + (xMajor ? 0 : corners[k].side * half);
        t.y[k] = s.y + (xMajor ? corners[k].side * half : 0);
        t.z[k] = s.z;
        t.invW[k] = s.invW;
        t.vertex[k] = corners[k].end->vertex;
    }
    t.drawWord = draw.drawIndex;
    const Rectangle pixels = sampleBounds(t, draw.bounds, draw.sampleReach);
    if (pixels.x0 >= pixels.x1 || pixels.y0 >= pixels.y1) return false;
    chunk.triangles.push_back(t);
    return true;
}

// Returns whether anything could be covered.
bool appendLine(const DrawGeometry& draw, const End& first, const End& second, TriangleChunk& chunk)
{
    const std::int32_t dx = second.screen.x - first.screen.x, dy = second.screen.y - first.screen.y;
    const bool xMajor = std::abs(dx) >= std::abs(dy);
    const std::int32_t major = xMajor ? dx : dy;
    if (major == 0) return false;

    // From left to right, or from bottom to top, the corners a-, b-, b+ and a- , b+, a+ go clockwise (y is down).
    const bool forward = xMajor ? major > 0 : major < 0;
    const End& a = forward ? first : second;
    const End& b = forward ? second : first;
    const bool one = append(draw, {{{&a, -1}, {&b, -1}, {&b, +1}}}, first, xMajor, chunk);
    const bool two = append(draw, {{{&a, -1}, {&b, +1}, {&a, +1}}}, first, xMajor, chunk);
    return one || two;
}

}  // namespace

void setUpLines(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, TriangleChunk& chunk,
                Statistics& statistics)
{
    statistics.trianglesSubmitted += count;
    for (std::uint32_t i = first; i < first + count; ++i) {
        std::uint32_t room[2];
        const std::uint32_t* vertex = cornersOf(draw, i, 1, 2, room);
        if (vertex[0] >= draw.vertexCount || vertex[1] >= draw.vertexCount) {
            ++statistics.droppedIndex;
            continue;
        }
        const unsigned c0 = draw.codes[vertex[0]], c1 = draw.codes[vertex[1]];
        if (((c0 | c1) & (vertex_code::nan | vertex_code::infinite)) != 0) {
            ++(((c0 | c1) & vertex_code::nan) != 0 ? statistics.droppedNan : statistics.droppedInfinite);
            continue;
        }
        if ((c0 & c1 & vertex_code::anyOutside) != 0) {
            ++statistics.outside;
            continue;
        }
        End ends[2] = {{draw.screen[vertex[0]], vertex[0]}, {draw.screen[vertex[1]], vertex[1]}};
        if (((c0 | c1) & vertex_code::mustClip) != 0) {
            ++statistics.trianglesClipped;
            const glm::vec4 positions[2] = {draw.clip[vertex[0]], draw.clip[vertex[1]]};
            ClipVertex clipped[2];
            if (!clipLine(positions, clipLimits(draw, {vertex[0], vertex[1], vertex[1]}), clipped)) {
                ++statistics.outside;
                continue;
            }
            for (int k = 0; k < 2; ++k) ends[k] = clippedEnd(draw, vertex, clipped[k], chunk);
        }
        ++(appendLine(draw, ends[0], ends[1], chunk) ? statistics.rasterised : statistics.culledNoSample);
    }
}

}  // namespace relief::inline RELIEF_WIDTH
