// What a frame keeps: what was recorded, and the memory that running it takes. For frame.cpp, and for
// whoever looks into a frame: instruments, views, traces.
#pragma once

#include <atomic>
#include <vector>

#include "relief/pipeline/bin.h"
#include "relief/pipeline/frame.h"
#include "relief/pipeline/workers.h"

namespace relief::inline RELIEF_WIDTH {

// A piece of front-end work: some vertices or primitives of one draw.
struct Piece
{
    std::uint32_t draw, first, count;
};

struct Frame::Storage
{
    Storage(Framebuffer& framebuffer, const FrameOptions& options);

    // --- recorded ---

    void resetState();

    Framebuffer& target;
    int tileSize;  // pixels
    std::uint32_t maxBinned;
    std::vector<Draw> draws;
    std::string problem;
    Clear clear;
    Viewport viewport;
    Rectangle scissor;
    bool frontCounterClockwise = false;

    // --- of the run ---

    // What a worker has for itself.
    struct Worker
    {
        std::unique_ptr<Tile> tile;
        std::vector<CoveredBlock> blocks;
        std::vector<SampleCoverage> samples;
        Statistics statistics;
    };

    // One draw's vertices.
    struct Vertices
    {
        Scratch<glm::vec4> clip;
        Scratch<ScreenVertex> screen;
        Scratch<std::uint16_t> codes;
        Scratch<float> components;
    };

    // A chunk of primitives, and which of them are not set up yet.
    struct Chunk : TriangleChunk
    {
        std::vector<Piece> rest;
        bool isReady = false;  // set up as far as it goes
    };

    // Chunks first ... last - 1 of a frame that draws onto what `clear` says. There are several parts where a frame has
    // too many triangles to bin them all at once.
    struct Part
    {
        std::size_t first, last;
        bool isLast;
        Clear clear;
        TargetMemory memory;
        bool movesPixels;  // TargetMemory's
    };

    Statistics run();
    void prepare();
    void shadeVertices();
    void cutPrimitives();
    Clear clearOf(const TargetMemory& memory) const;
    void startNextPart(Part& part);
    void setUpAndBin(std::size_t firstChunk);
    void setUpAndBin(Chunk& chunk, Statistics& statistics);
    void drawTile(const Part& part, int tileIndex, Worker& worker);
    void drawTriangles(const Part& part, int tileIndex, Worker& worker);

    Rectangle tilePixels(int tileIndex) const
    {
        const int x = tileIndex % grid.width * grid.tileSize, y = tileIndex / grid.width * grid.tileSize;
        return {x, y, x + grid.tileSize, y + grid.tileSize};
    }
    // The room that rasterise() asks for: every triangle of a batch may cover all of a tile.
    std::size_t coveredBlocks() const { return static_cast<std::size_t>(grid.tileSize * grid.tileSize) + 1; }

    Workers workers;
    std::vector<Worker> perWorker;
    TileGrid grid;
    std::vector<Vertices> vertices;
    std::vector<Chunk> chunks;
    std::size_t usedChunks = 0;
    std::atomic<std::uint32_t> binned{0};  // pairs in the chunks
    std::vector<std::uint8_t> touched;     // tiles that a triangle was binned into

    // What tiles hold between the parts of a frame; nothing of those that no triangle has touched yet.
    std::vector<std::vector<std::int32_t>> betweenParts;

    // Who follows one pixel (trace/pixel_trace.cpp): only its tile is drawn then, and its triangles go one by one.
    struct Follower
    {
        int tile = 0;

        // Before and after each triangle of the tile's bin.
        virtual void begin(const Draw& draw, const Triangle& triangle, Tile& tile) = 0;
        virtual void end(const Draw& draw, const Triangle& triangle, Tile& tile) = 0;

    protected:
        ~Follower() = default;
    };
    Follower* follower = nullptr;

    // A component of a draw that is NaN at every vertex, for dependsOn(); none where `draw` is -1.
    struct Poison
    {
        int draw = -1, component = 0;
    } poison;
};

}  // namespace relief::inline RELIEF_WIDTH
