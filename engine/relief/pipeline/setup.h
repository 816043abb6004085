// Triangle setup: from indices and shaded vertices to triangles on the pixel grid. Culls what faces away, what lies
// outside and what covers no pixel centre; clips what must be clipped. It looks at kLanes triangles at a time.
#pragma once

#include "relief/pipeline/geometry.h"
#include "relief/pipeline/statistics.h"

namespace relief::inline RELIEF_WIDTH {

// Sets up triangles first ... first + count - 1 of a draw and appends the survivors to chunk.triangles.
void setUpTriangles(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, TriangleChunk& chunk,
                    Statistics& statistics);

}  // namespace relief::inline RELIEF_WIDTH
