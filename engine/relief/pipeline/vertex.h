// The vertex stage. Enters: a mesh's streams. Leaves: clip-space positions, their screen positions and codes, and the
// components to interpolate, vertex after vertex.
#pragma once

#include "relief/hlsl/types.h"
#include "relief/mesh/vertex_stream.h"
#include "relief/pipeline/geometry.h"
#include "relief/pipeline/viewport_transform.h"

namespace relief::inline RELIEF_WIDTH {

// Elements of up to kLanes vertices, component by component: lane i takes element[i]. What the stream does not hold is
// (0, 0, 0, 1).
void readStream(const StreamView& stream, const std::uint32_t* element, std::uint32_t count, Float (&lanes)[4]);

// The screen side of `count` <= kLanes vertices that start at `first`: draw.screen, draw.clip and draw.codes from clip
// positions. `transform` is that of the draw's viewport.
void projectVertices(const DrawGeometry& draw, const ViewportTransform& transform, std::uint32_t first,
                     std::uint32_t count, const float4& clip);

// The components of `count` vertices that start at `first`, from one value per lane to one vertex after the other,
// which is how triangles will ask for them.
void storeComponents(const DrawGeometry& draw, std::uint32_t first, std::uint32_t count, const Float* components);

}  // namespace relief::inline RELIEF_WIDTH
