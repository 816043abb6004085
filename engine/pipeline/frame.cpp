#include "pipeline/frame.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "leave_out.h"
#include "pipeline/line.h"
#include "pipeline/setup.h"

namespace relief {

namespace {

// A piece of front-end work: some vertices or primitives of one draw.
struct Piece
{
    std::uint32_t draw, first, count;
};

// Cuts all draws' items into chunks of at most `size` items. A chunk may span several small draws.
template <class CountOf>
std::vector<std::vector<Piece>> cut(const std::vector<std::unique_ptr<Draw>>& draws, std::uint32_t size,
                                    CountOf countOf)
{
    std::vector<std::vector<Piece>> chunks;
    std::uint32_t room = 0;
    for (std::uint32_t d = 0; d < draws.size(); ++d) {
        const std::uint32_t total = countOf(draws[d]->geometry);
        for (std::uint32_t first = 0; first < total;) {
            if (room == 0) {
                chunks.emplace_back();
                room = size;
            }
            const std::uint32_t n = std::min(room, total - first);
            chunks.back().push_back({d, first, n});
            room -= n;
            first += n;
        }
    }
    return chunks;
}

}  // namespace

struct Frame::Storage
{
    // What a worker has for itself.
    struct Worker
    {
        std::unique_ptr<Tile> tile;
        std::vector<CoveredBlock> blocks;
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

    Storage(Framebuffer& framebuffer, const FrameOptions& options)
        : target(framebuffer), workers(options.threads), perWorker(static_cast<std::size_t>(workers.count()))
    {
        grid.tileSize = std::clamp(
            static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(options.tileSize, 1)))), 16, kMaxTileSize);
        grid.width = (target.width() + grid.tileSize - 1) / grid.tileSize;
        grid.height = (target.height() + grid.tileSize - 1) / grid.tileSize;
        resetState();
    }

    void resetState()
    {
        draws.clear();
        clearColor.reset();
        clearDepth = 1.0f;
        viewport = {0, 0, target.width(), target.height()};
        scissor = {0, 0, target.width(), target.height()};
        frontCounterClockwise = false;
    }

    void shadeVertices();
    void applyPoison();
    void setUpAndBin();
    Rectangle tilePixels(int tileIndex) const
    {
        const int x = tileIndex % grid.width * grid.tileSize, y = tileIndex / grid.width * grid.tileSize;
        return {x, y, x + grid.tileSize, y + grid.tileSize};
    }
    // The room that rasterise() asks for: every triangle of a batch may cover all of a tile.
    std::size_t coveredBlocks() const { return static_cast<std::size_t>(grid.tileSize * grid.tileSize) + 1; }
    void drawTile(int tileIndex, Worker& worker);
    void drawBin(const TriangleChunk& chunk, int tileIndex, Worker& worker);

    Framebuffer& target;
    Workers workers;
    std::vector<Worker> perWorker;
    TileGrid grid;

    std::vector<std::unique_ptr<Draw>> draws;
    std::vector<Vertices> vertices;
    std::vector<TriangleChunk> chunks;
    std::size_t usedChunks = 0;
    std::optional<glm::vec4> clearColor;
    float clearDepth = 1.0f;
    Viewport viewport;
    Rectangle scissor;
    bool frontCounterClockwise = false;

    // A component of a draw that is to be NaN at every vertex.
    struct Poison
    {
        int draw, component;
    };
    std::optional<Poison> poison;
};

Frame::Frame(Framebuffer& target, const FrameOptions& options) : storage(std::make_unique<Storage>(target, options)) {}
Frame::~Frame() = default;

void Frame::reset()
{
    storage->resetState();
}

void Frame::clear(const glm::vec4& color, float depth)
{
    // As with what a program returns: NaN becomes 0 (depth: 1), infinities the largest finite number.
    const auto finite = [](float value, float insteadOfNan) {
        constexpr float largest = std::numeric_limits<float>::max();
        return value != value ? insteadOfNan : std::clamp(value, -largest, largest);
    };
    storage->clearColor = {finite(color.x, 0.0f), finite(color.y, 0.0f), finite(color.z, 0.0f), finite(color.w, 0.0f)};
    storage->clearDepth = finite(depth, 1.0f);
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

void Frame::add(std::unique_ptr<Draw> draw, const Mesh& mesh)
{
    Storage& s = *storage;
    DrawGeometry& g = draw->geometry;
    g.indices = mesh.indices.data();
    g.primitiveCount = static_cast<std::uint32_t>(mesh.indices.size() / (g.primitive == Primitive::lines ? 2 : 3));
    g.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
    g.viewport = s.viewport;
    const Rectangle all = {0, 0, s.target.width(), s.target.height()};
    const Viewport& v = s.viewport;
    g.bounds = intersect(intersect(all, s.scissor), {v.x, v.y, v.x + v.width, v.y + v.height});
    if (s.frontCounterClockwise && g.cull != Cull::none) g.cull = g.cull == Cull::back ? Cull::front : Cull::back;
    g.drawIndex = static_cast<std::uint32_t>(s.draws.size());

    // Nothing can be seen: no vertex is shaded.
    if (g.bounds.x0 >= g.bounds.x1 || g.bounds.y0 >= g.bounds.y1 || g.vertexCount == 0) g.primitiveCount = 0;
    if (g.primitiveCount == 0) g.vertexCount = 0;
    s.draws.push_back(std::move(draw));
}

Statistics Frame::run()
{
    Storage& s = *storage;
    for (Storage::Worker& worker : s.perWorker) worker.statistics = {};
    s.shadeVertices();
    if (s.poison) s.applyPoison();
    s.setUpAndBin();
    s.workers.run(s.grid.count(),
                  [&](int tile, int worker) { s.drawTile(tile, s.perWorker[static_cast<std::size_t>(worker)]); });

    Statistics total;
    for (const Storage::Worker& worker : s.perWorker) total += worker.statistics;
    total.draws = s.draws.size();
    total.tiles = static_cast<std::uint64_t>(s.grid.count());
    return total;
}

void Frame::Storage::shadeVertices()
{
    if (vertices.size() < draws.size()) vertices.resize(draws.size());
    for (std::size_t d = 0; d < draws.size(); ++d) {
        DrawGeometry& g = draws[d]->geometry;
        g.clip = vertices[d].clip.reserve(g.vertexCount);
        g.screen = vertices[d].screen.reserve(g.vertexCount);
        g.codes = vertices[d].codes.reserve(g.vertexCount);
        g.components = vertices[d].components.reserve(static_cast<std::size_t>(g.vertexCount) * g.componentCount);
    }
    const auto pieces = cut(draws, kVerticesPerChunk, [](const DrawGeometry& g) { return g.vertexCount; });
    workers.run(static_cast<int>(pieces.size()), [&](int chunk, int worker) {
        for (const Piece& piece : pieces[static_cast<std::size_t>(chunk)]) {
            draws[piece.draw]->shadeVertices(piece.first, piece.count);
            perWorker[static_cast<std::size_t>(worker)].statistics.verticesShaded += piece.count;
        }
    });
}

void Frame::Storage::applyPoison()
{
    const DrawGeometry& g = draws[static_cast<std::size_t>(poison->draw)]->geometry;
    for (std::size_t v = 0; v < g.vertexCount; ++v) {
        g.components[v * g.componentCount + static_cast<std::size_t>(poison->component)] =
            std::numeric_limits<float>::quiet_NaN();
    }
}

void Frame::Storage::setUpAndBin()
{
    std::vector<const DrawGeometry*> geometry;
    for (const auto& draw : draws) geometry.push_back(&draw->geometry);

    const auto pieces = cut(draws, kTrianglesPerChunk, [](const DrawGeometry& g) { return g.primitiveCount; });
    usedChunks = pieces.size();
    if (chunks.size() < usedChunks) chunks.resize(usedChunks);
    workers.run(static_cast<int>(usedChunks), [&](int index, int worker) {
        TriangleChunk& chunk = chunks[static_cast<std::size_t>(index)];
        Statistics& statistics = perWorker[static_cast<std::size_t>(worker)].statistics;
        chunk.clear();
        for (const Piece& piece : pieces[static_cast<std::size_t>(index)]) {
            const bool lines = geometry[piece.draw]->primitive == Primitive::lines;
            (lines ? setUpLines : setUpTriangles)(*geometry[piece.draw], piece.first, piece.count, chunk, statistics);
        }
        binTriangles(chunk, grid, geometry.data(), statistics);
    });
}

void Frame::Storage::drawTile(int tileIndex, Worker& worker)
{
    bool touched = false;
    for (std::size_t c = 0; c < usedChunks && !touched; ++c) {
        const auto tile = static_cast<std::size_t>(tileIndex);
        touched = chunks[c].binStart[tile] != chunks[c].binStart[tile + 1];
    }
    if (!touched && !clearColor) return;

    const Rectangle pixels = tilePixels(tileIndex);
    if (!worker.tile) worker.tile = std::make_unique<Tile>(grid.tileSize, target.format());
    if (clearColor) {
        if (leavesOut::tiles && !touched) {
            clearRectangle(target, pixels, *clearColor, clearDepth);
            return;
        }
        worker.tile->clear(pixels.x0, pixels.y0, *clearColor, clearDepth);
    } else {
        worker.tile->load(pixels.x0, pixels.y0, target, clearDepth);
    }

    ++worker.statistics.tilesTouched;
    fetchCounters = {};
    for (std::size_t c = 0; c < usedChunks; ++c) {
        drawBin(chunks[c], tileIndex, worker);
    }
    worker.statistics.fetches += fetchCounters;
    worker.tile->store(target);
}

void Frame::Storage::drawBin(const TriangleChunk& chunk, int tileIndex, Worker& worker)
{
    worker.blocks.resize(coveredBlocks());
    const auto tile = static_cast<std::size_t>(tileIndex);
    const std::uint32_t last = chunk.binStart[tile + 1];
    for (std::uint32_t next = chunk.binStart[tile]; next < last;) {
        // The next triangles, as far as they are of one draw.
        const std::uint32_t drawIndex = chunk.triangles[chunk.sorted[next]].drawIndex;
        const Triangle* triangles[kLanes];
        std::size_t count = 0;
        for (; count < kLanes && next < last; ++count, ++next) {
            triangles[count] = &chunk.triangles[chunk.sorted[next]];
            if (triangles[count]->drawIndex != drawIndex) break;
        }
        const Draw& draw = *draws[drawIndex];
        // Triangles of a bin lie anywhere in the chunk: the ones after these are asked for in time.
        for (std::uint32_t i = next; i < std::min<std::uint32_t>(last, next + kLanes); ++i)
            __builtin_prefetch(&chunk.triangles[chunk.sorted[i]]);
        const Rectangle clip = intersect(tilePixels(tileIndex), draw.geometry.bounds);
        TriangleBatch batch;
        batch.set({triangles, count}, clip);
        CoveredBlock* const blocks = worker.blocks.data();
        const CoveredBlock* const end = rasterise(batch, clip, blocks);
        if (end != blocks) draw.shadeBlocks({blocks, end}, batch, chunk, *worker.tile, worker.statistics);
    }
}

int Frame::drawCount() const
{
    return static_cast<int>(storage->draws.size());
}

int Frame::componentCount(int draw) const
{
    return static_cast<int>(storage->draws[static_cast<std::size_t>(draw)]->geometry.componentCount);
}

std::string Frame::outputSignature(int draw) const
{
    return storage->draws[static_cast<std::size_t>(draw)]->outputSignature();
}

bool Frame::dependsOn(int draw, int component)
{
    const Framebuffer before = storage->target;
    storage->poison = {draw, component};
    run();
    storage->poison.reset();
    const bool same = storage->target.samePixels(before);
    storage->target = before;
    return !same;
}

float Frame::shadeAlone(std::uint64_t blocks) const
{
    // One block of every bin stands for the bin: the middle one of its first triangle.
    struct Sample
    {
        CoveredBlock block;
        const Triangle* triangle;
        const TriangleChunk* chunk;
    };
    const Storage& s = *storage;
    std::vector<Sample> samples;
    std::vector<CoveredBlock> covered(s.coveredBlocks());
    for (std::size_t c = 0; c < s.usedChunks; ++c) {
        for (int tile = 0; tile < s.grid.count(); ++tile) {
            const TriangleChunk& chunk = s.chunks[c];
            const std::uint32_t first = chunk.binStart[static_cast<std::size_t>(tile)];
            if (first == chunk.binStart[static_cast<std::size_t>(tile) + 1]) continue;
            const Triangle& triangle = chunk.triangles[chunk.sorted[first]];
            const Rectangle pixels = intersect(s.tilePixels(tile), s.draws[triangle.drawIndex]->geometry.bounds);
            const Triangle* const one[] = {&triangle};
            TriangleBatch batch;
            batch.set(one, pixels);
            const CoveredBlock* end = rasterise(batch, pixels, covered.data());
            if (end == covered.data()) continue;
            samples.push_back({covered[static_cast<std::size_t>(end - covered.data()) / 2], &triangle, &chunk});
        }
    }
    float sum = 0.0f;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        // Shares that add up to `blocks`.
        const std::uint64_t times = blocks * (i + 1) / samples.size() - blocks * i / samples.size();
        const Sample& sample = samples[i];
        const Draw& draw = *s.draws[sample.triangle->drawIndex];
        TriangleBatch batch;
        batch.set({&sample.triangle, 1}, draw.geometry.bounds);
        sum += draw.shadeAlone(sample.block, batch, *sample.chunk, times);
    }
    return sum;
}

}  // namespace relief
