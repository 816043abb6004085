// Lines: from shaded vertices to two thin triangles per line, which all later steps then treat as any other.
//
// The rule (Vulkan's parallelogram, OpenGL's non-antialiased wide line): a line is x-major where |dx| >= |dy| between
// its snapped ends. It covers what it sweeps when it is moved by half its width to both sides along the other axis.
// With the top-left rule, a line of width n has exactly n pixels in every column (every row, if it is y-major) whose
// pixel centres lie between its ends, the first end included and the last one not, or the other way round, as the
// rule says. All of it is integers: the same pixels everywhere, however a line is clipped to a tile.
#pragma once

#include "relief/pipeline/geometry.h"
#include "relief/pipeline/statistics.h"

namespace relief::inline RELIEF_WIDTH {

// Sets up lines first ... first + count - 1 of a draw and appends their triangles to chunk.triangles. A line counts as
// one primitive in the statistics. A line whose ends snap to the same point has no pixels.
void setUpLines(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, TriangleChunk& chunk,
                Statistics& statistics);

}  // namespace relief::inline RELIEF_WIDTH
