// One draw, and the whole pipeline on one screen: start here.
//
//     vertices     shadeVertices   the vertex program, kLanes vertices at a time      -> clip space, pixel grid
//     triangles    setUpTriangles  clip, cull (setUpLines: lines become thin triangles)
//                  findTiles       that each one touches; sortByTile
//     tile by tile rasterise       which pixels of which blocks are covered, a TriangleBatch at a time
//                  shadeBlocks     early depth test, the fragment program, merge
//
// Programs are functors on lanes. What is compiled with them is in program.h: three functions and the tables of their
// structs. A Draw is plain data, and all of the steps above are compiled once, in the engine. frame.h runs it all.
#pragma once

#include <span>

#include "relief/error.h"
#include "relief/mesh/mesh.h"
#include "relief/pipeline/geometry.h"
#include "relief/pipeline/program.h"
#include "relief/pipeline/raster.h"
#include "relief/pipeline/render_state.h"
#include "relief/pipeline/statistics.h"
#include "relief/pipeline/tile.h"

namespace relief::inline RELIEF_WIDTH {

struct Draw
{
    std::string mesh;  // its name
    const Programs* programs;
    ErasedProgram vertexProgram, fragmentProgram;  // copies
    RenderState state;
    std::vector<StreamView> streams;  // one for each field of VertexData; without words for SV_VertexID and the like
    std::vector<Interpolation> interpolations;  // of each component
    DrawGeometry geometry;
    std::uint32_t instances = 0;
    Rectangle window = {};  // the viewport within the scissor

    // Sets what of `geometry` depends on the target: no vertex is shaded where nothing of the window lies in it.
    void fitTo(const Framebuffer& target);
};

// Whether the program, or alpha, decides which pixels or samples are drawn: it runs then, whatever becomes of its
// colours.
inline bool decidesCoverage(const Draw& draw)
{
    const Outputs& outputs = draw.programs->outputs;
    return draw.programs->discards || draw.state.alphaToCoverage || outputs.depth || outputs.coverage;
}

// The draw of a mesh, or a part of it, with copies of its programs: everything but where it goes. An error, one
// sentence, where the mesh does not have what VertexData asks for.
Expected<Draw> makeDraw(const Programs& programs, const void* vertexProgram, const void* fragmentProgram,
                        const Mesh& mesh, const RenderState& state, const MeshPart& part);

// Vertices first ... first + count - 1 of all instances, into the geometry's arrays.
void shadeVertices(const Draw& draw, std::uint32_t first, std::uint32_t count);

// Covered blocks of one tile, in order; all triangles belong to this draw and this batch. `samples` of each block,
// where the tile has several a pixel; `chunkOf` each triangle of the batch.
void shadeBlocks(const Draw& draw, std::span<const CoveredBlock> blocks, const SampleCoverage* samples,
                 const TriangleBatch& batch, const TriangleChunk* const* chunkOf, Tile& tile, Statistics& statistics);

}  // namespace relief::inline RELIEF_WIDTH
