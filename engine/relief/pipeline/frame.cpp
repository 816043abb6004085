// Running a frame: vertices, triangles and tiles, in rounds of tasks for the workers. A round ends before the next one
// begins.
#include "relief/pipeline/frame.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "relief/lanes/environment.h"
#include "relief/leave_out.h"
#include "relief/pipeline/frame_storage.h"
#include "relief/pipeline/line.h"
#include "relief/pipeline/setup.h"
#include "relief/pipeline/vertex.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Cuts all draws' items into chunks of at most `size` items. A chunk may span several small draws. Every piece begins
// at a multiple of kLanes of its draw, whatever other draws there are: vertices have the same neighbours in every
// frame.
template <class CountOf>
std::vector<std::vector<Piece>> cut(const std::vector<Draw>& draws, std::uint32_t size, CountOf countOf)
{
    std::vector<std::vector<Piece>> chunks;
    std::uint32_t room = 0;
    for (std::uint32_t d = 0; d < draws.size(); ++d) {
        const std::uint32_t total = countOf(draws[d].geometry);
        for (std::uint32_t first = 0; first < total;) {
            if (room == 0) {
                chunks.emplace_back();
                room = size;
            }
            const std::uint32_t n = std::min(room, total - first);
            chunks.back().push_back({d, first, n});
            room -= std::min(room, (n + 15) & ~15u);
            first += n;
        }
    }
    return chunks;
}

// As with what a program returns: NaN becomes 0, infinities the largest finite number.
float finite(float value)
{
    constexpr float largest = std::numeric_limits<float>::max();
    return value != value ? 0.0f : std::clamp(value, -largest, largest);
}

Rectangle pixelsOf(const Viewport& v)
{
    return {v.x, v.y, v.x + v.width, v.y + v.height};
}

}  // namespace

// --- recording ---

Frame::Storage::Storage(Framebuffer& framebuffer, const FrameOptions& options)
    : target(framebuffer),
      tileSize(std::clamp(static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(options.tileSize, 1)))), 16,
                          kMaxTileSize)),
      maxBinned(options.maxBinned),
      workers(options.threads),
      perWorker(static_cast<std::size_t>(workers.count()))
{
    resetState();
}

void Frame::Storage::resetState()
{
    draws.clear();
    problem.clear();
    usedChunks = 0;
    clear = {};
    viewport = {0, 0, target.width(), target.height()};
    scissor = {0, 0, target.width(), target.height()};
    frontCounterClockwise = false;
}

Frame::Frame(Framebuffer& target, const FrameOptions& options) : storage(std::make_unique<Storage>(target, options)) {}
Frame::~Frame() = default;

void Frame::reset()
{
    storage->resetState();
}

void Frame::clear(const glm::vec4& color, float depth)
{
    clearColor(color);
    clearDepth(depth);
    clearStencil(0);
}

void Frame::clearColor(const glm::vec4& color)
{
    for (int target = 0; target < kMaxColors; ++target) clearColor(target, color);
}

void Frame::clearColor(int target, const glm::vec4& color)
{
    if (target < 0 || target >= kMaxColors) return;
    storage->clear.color[static_cast<std::size_t>(target)] = {finite(color.x), finite(color.y), finite(color.z),
                                                              finite(color.w)};
}

void Frame::clearStencil(std::uint8_t stencil)
{
    storage->clear.stencil = stencil;
}

void Frame::clearDepth(float depth)
{
    storage->clear.depth = depth > 0.0f ? std::min(depth, 1.0f) : 0.0f;  // NaN is not above 0
}

void Frame::setViewport(const Viewport& viewport)
{
    const auto side = [](int size) { return std::clamp(size, 0, kMaxTargetSize); };
    const auto origin = [](int position) { return std::clamp(position, -kMaxTargetSize, kMaxTargetSize); };
    storage->viewport = {origin(viewport.x), origin(viewport.y), side(viewport.width), side(viewport.height)};
}

void Frame::setScissor(const Rectangle& scissor)
{
    storage->scissor = scissor;
}

void Frame::setFrontCounterClockwise(bool counterClockwise)
{
    storage->frontCounterClockwise = counterClockwise;
}

Expected<void> Frame::record(const Programs& programs, const void* vertexProgram, const void* fragmentProgram,
                             const Mesh& mesh, const RenderState& state, const MeshPart& part, bool contractsProducts)
{
    // Once: what the workers' environment does not put right.
    static const char* const floatingPoint = [] {
        const DefaultFloatingPoint environment;
        return floatingPointProblem();
    }();
    Storage& s = *storage;
    Expected<Draw> draw =
        floatingPoint != nullptr ? fail("draw of mesh '" + mesh.name + "': on this machine " + floatingPoint +
                                        ", and the picture would have other bits than elsewhere; compile the engine "
                                        "with CMake's flags for it "
                                        "(-ffp-contract=off, no -ffast-math)")
        : contractsProducts
            ? fail("draw of mesh '" + mesh.name +
                   "': its programs are compiled without -ffp-contract=off, and would give other bits than elsewhere; "
                   "add that flag (in CMake, link relief::engine, which passes it on)")
            : makeDraw(programs, vertexProgram, fragmentProgram, mesh, state, part);
    if (!draw) {
        if (s.problem.empty()) s.problem = draw.error().message;
        return tl::unexpected(draw.error());
    }
    DrawGeometry& g = draw->geometry;
    g.viewport = s.viewport;
    draw->window = intersect(s.scissor, pixelsOf(s.viewport));
    draw->fitTo(s.target);
    g.frontCounterClockwise = s.frontCounterClockwise;
    if (s.frontCounterClockwise && g.cull != Cull::none) g.cull = g.cull == Cull::back ? Cull::front : Cull::back;
    g.drawIndex = static_cast<std::uint32_t>(s.draws.size());
    s.draws.push_back(std::move(*draw));
    return {};
}

const std::string& Frame::problem() const
{
    return storage->problem;
}

int Frame::drawCount() const
{
    return static_cast<int>(storage->draws.size());
}

FrameOptions Frame::options() const
{
    return {storage->workers.count(), storage->tileSize, storage->maxBinned};
}

// --- running ---

Statistics Frame::run()
{
    return storage->run();
}

Statistics Frame::Storage::run()
{
    prepare();
    shadeVertices();
    cutPrimitives();
    const TargetMemory memory(target);
    betweenParts.assign(static_cast<std::size_t>(grid.count()), {});
    const Clear all = clearOf(memory);
    for (Part part = {0, 0, false, all, memory, memory.movesPixels(all)}; !part.isLast; startNextPart(part)) {
        setUpAndBin(part.first);
        while (part.last < usedChunks && chunks[part.last].isReady && chunks[part.last].rest.empty()) ++part.last;
        part.isLast = part.last == usedChunks;
        // A chunk that was too much for the room is drawn as far as it goes.
        if (!part.isLast && chunks[part.last].isReady) ++part.last;
        const auto draw = [&](int tile, int worker) {
            drawTile(part, tile, perWorker[static_cast<std::size_t>(worker)]);
        };
        if (follower != nullptr) {
            draw(follower->tile, 0);
        } else {
            workers.run(grid.count(), draw);
        }
    }
    betweenParts.clear();
    if (follower == nullptr) target.show();

    Statistics total;
    for (const Worker& worker : perWorker) total += worker.statistics;
    total.draws = draws.size();
    total.tiles = static_cast<std::uint64_t>(grid.count());
    return total;
}

// What a target does not keep is cleared in any case.
Clear Frame::Storage::clearOf(const TargetMemory& memory) const
{
    Clear all = clear;
    std::size_t colors = 0;
    for (std::size_t i = 0; i < memory.attachments.size(); ++i) {
        const Format format = memory.attachments[i].format;
        const std::size_t color = isColor(format) ? colors++ : 0;
        if (memory.drawn[i].top != nullptr) continue;
        if (isColor(format) && !all.color[color]) all.color[color] = glm::vec4(0.0f);
        if (format == Format::depth32f && !all.depth) all.depth = 1.0f;
        if (format == Format::stencil8 && !all.stencil) all.stencil = std::uint8_t{0};
    }
    return all;
}

// From the first chunk on that has something left; the others are done with, and give their memory back.
void Frame::Storage::startNextPart(Part& part)
{
    if (part.isLast) return;
    for (; part.first < part.last; ++part.first) {
        Chunk& chunk = chunks[part.first];
        binned -= static_cast<std::uint32_t>(chunk.entries.size());
        chunk = {{}, std::move(chunk.rest)};
        if (!chunk.rest.empty()) break;
    }
    part.last = part.first;
}

// The target may be another one than when the draws were recorded.
void Frame::Storage::prepare()
{
    grid.tileSize = tileSize;
    grid.width = (target.width() + grid.tileSize - 1) / grid.tileSize;
    grid.height = (target.height() + grid.tileSize - 1) / grid.tileSize;
    touched.assign(static_cast<std::size_t>(grid.count()), 0);
    for (Draw& draw : draws) draw.fitTo(target);
    const TargetMemory memory(target);
    for (Worker& worker : perWorker) {
        worker.statistics = {};
        if (worker.tile && !worker.tile->isFor(memory)) worker.tile.reset();
    }
}

void Frame::Storage::shadeVertices()
{
    if (vertices.size() < draws.size()) vertices.resize(draws.size());
    for (std::size_t d = 0; d < draws.size(); ++d) {
        DrawGeometry& g = draws[d].geometry;
        g.clip = vertices[d].clip.reserve(g.vertexCount);
        g.screen = vertices[d].screen.reserve(g.vertexCount);
        g.codes = vertices[d].codes.reserve(g.vertexCount);
        g.components = vertices[d].components.reserve(static_cast<std::size_t>(g.vertexCount) * g.componentStride);
    }
    const auto pieces = cut(draws, kVerticesPerChunk, [](const DrawGeometry& g) { return g.vertexCount; });
    workers.run(static_cast<int>(pieces.size()), [&](int chunk, int worker) {
        for (const Piece& piece : pieces[static_cast<std::size_t>(chunk)]) {
            relief::shadeVertices(draws[piece.draw], piece.first, piece.count);
            perWorker[static_cast<std::size_t>(worker)].statistics.verticesShaded += piece.count;
        }
    });
    if (poison.draw < 0) return;
    const DrawGeometry& g = draws[static_cast<std::size_t>(poison.draw)].geometry;
    for (std::size_t v = 0; v < g.vertexCount; ++v) {
        g.components[v * g.componentStride + static_cast<std::size_t>(poison.component)] =
            std::numeric_limits<float>::quiet_NaN();
    }
}

void Frame::Storage::cutPrimitives()
{
    auto pieces = cut(draws, kTrianglesPerChunk, [](const DrawGeometry& g) { return g.primitiveCount; });
    usedChunks = pieces.size();
    if (chunks.size() < usedChunks) chunks.resize(usedChunks);
    for (std::size_t c = 0; c < usedChunks; ++c) {
        chunks[c].clear();
        chunks[c].isReady = false;
        chunks[c].rest = std::move(pieces[c]);
    }
    binned = 0;
}

// All chunks from the first on that are not ready, as far as there is room. The first one has some in any case.
void Frame::Storage::setUpAndBin(std::size_t firstChunk)
{
    workers.run(static_cast<int>(usedChunks - firstChunk), [&](int index, int worker) {
        Chunk& chunk = chunks[firstChunk + static_cast<std::size_t>(index)];
        if (chunk.isReady || (index != 0 && binned >= maxBinned)) return;
        setUpAndBin(chunk, perWorker[static_cast<std::size_t>(worker)].statistics);
    });
}

void Frame::Storage::setUpAndBin(Chunk& chunk, Statistics& statistics)
{
    std::size_t expected = chunk.triangles.size();
    for (const Piece& piece : chunk.rest) expected += piece.count;
    chunk.triangles.reserve(expected);
    chunk.entries.reserve(expected);
    bool isFull = false;
    std::size_t done = 0;
    while (!isFull && done < chunk.rest.size()) {
        Piece& piece = chunk.rest[done];
        const std::uint32_t count = std::min(piece.count, kPrimitivesPerCount);
        const DrawGeometry& g = draws[piece.draw].geometry;
        const std::size_t triangles = chunk.triangles.size(), pairs = chunk.entries.size();
        (g.primitive == Primitive::lines ? setUpLines : setUpTriangles)(g, piece.first, count, chunk, statistics);
        findTiles(chunk, static_cast<std::uint32_t>(triangles), grid, g);
        const auto more = static_cast<std::uint32_t>(chunk.entries.size() - pairs);
        statistics.trianglesBinned += more;
        isFull = (binned += more) >= maxBinned;
        piece.first += count;
        piece.count -= count;
        if (piece.count == 0) ++done;
    }
    chunk.rest.erase(chunk.rest.begin(), chunk.rest.begin() + static_cast<std::ptrdiff_t>(done));
    chunk.isReady = true;
    sortByTile(chunk, grid);
}

void Frame::Storage::drawTile(const Part& part, int tileIndex, Worker& worker)
{
    const auto tile = static_cast<std::size_t>(tileIndex);
    bool isTouched = false;
    for (std::size_t c = part.first; c < part.last && !isTouched; ++c) {
        isTouched = chunks[c].binStart[tile] != chunks[c].binStart[tile + 1];
    }
    std::vector<std::int32_t>& before = betweenParts[tile];
    const bool isNew = before.empty();
    if (!isTouched && !part.isLast) return;
    const bool isLeft = !isTouched && isNew && !part.movesPixels;
    if (isLeft && !part.clear.isAny()) return;

    const Rectangle pixels = tilePixels(tileIndex);
    if (leavesOut::tiles && isLeft) return clearRectangle(part.memory, pixels, part.clear);
    if (!worker.tile) worker.tile = std::make_unique<Tile>(grid.tileSize, part.memory);
    if (isNew) {
        worker.tile->begin(pixels.x0, pixels.y0, part.memory, part.clear);
    } else {
        worker.tile->restore(pixels.x0, pixels.y0, before);
    }
    if (isTouched && !touched[tile]) {
        ++worker.statistics.tilesTouched;
        touched[tile] = 1;
    }
    shading.fetches = {};
    drawTriangles(part, tileIndex, worker);
    worker.statistics.fetches += shading.fetches;
    if (part.isLast) {
        worker.tile->store(part.memory);
    } else {
        before = worker.tile->save();
    }
}

void Frame::Storage::drawTriangles(const Part& part, int tileIndex, Worker& worker)
{
    worker.blocks.resize(coveredBlocks());
    if (worker.tile->samples().isMultiple()) worker.samples.resize(coveredBlocks());
    const auto tile = static_cast<std::size_t>(tileIndex);
    const std::size_t most = follower == nullptr ? kLanes : 1;
    // The tile's triangles, one chunk after the other; of this one sorted[next] ... sorted[last - 1] are left.
    const Chunk* chunk = nullptr;
    std::size_t nextChunk = part.first;
    std::uint32_t next = 0, last = 0;
    const auto hasMore = [&] {
        for (; next == last && nextChunk != part.last; ++nextChunk) {
            chunk = &chunks[nextChunk];
            next = chunk->binStart[tile];
            last = chunk->binStart[tile + 1];
        }
        return next != last;
    };
    while (hasMore()) {
        // The next ones, as far as they are of one draw.
        const std::uint32_t drawIndex = chunk->triangles[chunk->sorted[next]].drawIndex();
        const Triangle* triangles[kLanes];
        const TriangleChunk* chunkOf[kLanes];
        std::size_t count = 0;
        for (; count < most && hasMore(); ++count, ++next) {
            triangles[count] = &chunk->triangles[chunk->sorted[next]];
            chunkOf[count] = chunk;
            if (triangles[count]->drawIndex() != drawIndex) break;
        }
        const Draw& draw = draws[drawIndex];
        // Triangles of a bin lie anywhere in the chunk: the ones after these are asked for in time.
        for (std::uint32_t i = next; i < std::min<std::uint32_t>(last, next + kLanes); ++i)
            __builtin_prefetch(&chunk->triangles[chunk->sorted[i]]);
        const Rectangle clip = intersect(tilePixels(tileIndex), draw.geometry.bounds);
        TriangleBatch batch;
        batch.set({triangles, count}, clip, worker.tile->samples(), draw.state.depthBias);
        if (follower != nullptr) follower->begin(draw, *triangles[0], *worker.tile);
        CoveredBlock* const blocks = worker.blocks.data();
        const CoveredBlock* const end = rasterise(batch, clip, blocks, worker.samples.data());
        if (end != blocks)
            shadeBlocks(draw, {blocks, end}, worker.samples.data(), batch, chunkOf, *worker.tile, worker.statistics);
        if (follower != nullptr) follower->end(draw, *triangles[0], *worker.tile);
    }
}

}  // namespace relief::inline RELIEF_WIDTH
